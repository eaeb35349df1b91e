// SPDX-License-Identifier: MIT
#include "edit/flip.h"

namespace tpa {

namespace {

// Flips change the surface, so only nearly flat pairs of faces are flipped: at most 25 degrees across the edge.
constexpr f64 flat_cosine = 0.9063;

}  // namespace

Diamond diamond_at(const Mesh& m, u32 h) {
  const u32 k = m.opposite[h];
  return {h, k, face_of(h), face_of(k), tail(m, h), head(m, h), apex(m, h), apex(m, k)};
}

bool wants_flip(const Mesh& m, u32 h) {
  struct Wedge {
    Vec3 u, v;
  };
  const auto wedge = [&](u32 e) {
    const Vec3 p = m.position[apex(m, e)];
    return Wedge{m.position[tail(m, e)] - p, m.position[head(m, e)] - p};
  };
  const Wedge w1 = wedge(h), w2 = wedge(m.opposite[h]);
  const f64 c1 = dot(w1.u, w1.v), c2 = dot(w2.u, w2.v);
  if (c1 >= 0 && c2 >= 0) return false;
  const f64 a1 = length(cross(w1.u, w1.v)), a2 = length(cross(w2.u, w2.v));
  return c1 * a2 + c2 * a1 < -1e-6 * a1 * a2;
}

bool may_flip(const Mesh& m, const Diamond& x, const FaceCorners (&trials)[2]) {
  const Vec3 nf = face_normal(m, x.f), nq = face_normal(m, x.q);
  const f64 between = dot(nf, nq);
  if (!(between > flat_cosine * square_root(squared_length(nf) * squared_length(nq)))) return false;
  if (!has_more_faces(m, x.a, 3) || !has_more_faces(m, x.b, 3)) return false;
  const Vec3 n = nf + nq;
  return turns_little(n, normal_of(m, trials[0])) && turns_little(n, normal_of(m, trials[1]));
}

void turn_edge(Edit& e, NearFaces& near, const Diamond& x) {
  const Mesh& m = e.mesh;
  const u32 ca = m.opposite[previous_edge(x.h)], db = m.opposite[previous_edge(x.k)];
  set_corner(e, x.h, x.d);
  set_corner(e, x.k, x.c);
  link(e, x.h, db);
  link(e, x.k, ca);
  link(e, previous_edge(x.h), previous_edge(x.k));
  set_vertex_edge(e, x.a, next_edge(x.k));
  set_vertex_edge(e, x.b, next_edge(x.h));
  set_vertex_edge(e, x.c, x.k);
  set_vertex_edge(e, x.d, x.h);
  insert(near, m, x.f);
  insert(near, m, x.q);
}

}  // namespace tpa
