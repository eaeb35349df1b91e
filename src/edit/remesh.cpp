#include "edit/remesh.h"

#include <float.h>

#include "edit/bisect.h"
#include "edit/collapse.h"

namespace tpa {

namespace {

// A flip may change the surface only where it is nearly flat: within 25 degrees across the edge.
constexpr f64 flat_cosine = 0.9063;

struct Remesher {
  Edit& e;
  NearFaces& g;
  FaceTree& clusters;
  Components& enclosed;
  const RemeshOptions& o;
  const Exec& exec;
  Relocation& r;
  Stack<u32>& touched;
  f64 shortest, longest;  // squares of what is not collapsed and not split
  RemeshResult result;

  Mesh& mesh() { return e.mesh; }
  // Notes vertices for the relaxation, each once.
  void touch(u32 v) {
    if (r.vertex_mark[v] != 0) return;
    r.vertex_mark[v] = 1;
    touched.push(v);
  }
  template <class... More>
  void touch(u32 v, More... more) {
    touch(v);
    touch(more...);
  }
};

// ---------------------------------------------------------------- split

bool split_freely(Remesher& s, u32 h) {
  Mesh& m = s.mesh();
  const u32 k = m.opposite[h];
  const u32 a = tail(m, h), b = head(m, h), c = apex(m, h), d = apex(m, k);
  const u32 f = face_of(h), q = face_of(k);
  const Vec3 p = into_exact_range(midpoint(m.position[a], m.position[b]));
  const u32 v = new_vertex(s.e, p, blend_origins(m, a, b, 0.5));
  if (v == none) {
    s.result.out_of_vertices = true;
    return false;
  }
  const Trial trials[4] = {{{v, b, c}}, {{v, c, a}}, {{v, a, d}}, {{v, d, b}}};
  SixVolumes change;
  add(change, -1, p, m.position[a], m.position[b], m.position[c]);
  add(change, -1, p, m.position[b], m.position[a], m.position[d]);
  s.r.face_mark[f] = s.r.face_mark[q] = 1;
  const bool free =
      stays_outside_out(s.enclosed, a, change) && trials_are_free(m, s.g, s.r.face_mark, trials, 4, Expected::flat);
  s.r.face_mark[f] = s.r.face_mark[q] = 0;
  if (!free || !split_edge(s.e, s.g, h, v)) {
    s.result.out_of_faces = s.result.out_of_faces || free;
    delete_vertex(s.e, v);
    return false;
  }
  s.enclosed.label[v] = s.enclosed.label[a];
  note_change(s.enclosed, a, change);
  s.touch(a, b, c, d, v);
  ++s.result.splits;
  return true;
}

// Splits what is longer round about until it is h's turn. Ends: every split makes the longest edge of the path shorter.
void split_long_edge(Remesher& s, u32 h) {
  while (squared_edge(s.e.mesh, h) > s.longest && split_freely(s, locally_longest(s.e.mesh, h))) {
  }
}

// ---------------------------------------------------------------- collapse

void collapse_short_edge(Remesher& s, u32 h) {
  const Mesh& m = s.e.mesh;
  if (!(squared_edge(m, h) < s.shortest)) return;
  const u32 a = tail(m, h), b = head(m, h);
  const Vec3 middle = into_exact_range(midpoint(m.position[a], m.position[b]));
  if (!collapse(s.e, s.g, a, b, middle, blend_origins(m, a, b, 0.5), s.longest, Expected::flat, s.r.face_mark,
                &s.enclosed))
    return;
  for_each_neighbour(m, b, [&](u32 u) { s.touch(u); });
  s.touch(b);
  ++s.result.collapses;
}

// ---------------------------------------------------------------- flip

// Is the edge not locally Delaunay, by a margin against flips to and fro between equal diagonals? It is where the
// angles at its apexes add up to more than pi: where the sum of their cotangents is negative.
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

void flip_edge(Remesher& s, u32 h) {
  Mesh& m = s.mesh();
  const u32 k = m.opposite[h];
  if (!wants_flip(m, h)) return;
  const u32 a = tail(m, h), b = head(m, h), c = apex(m, h), d = apex(m, k);
  const u32 f = face_of(h), q = face_of(k);
  const Vec3 nf = face_normal(m, f), nq = face_normal(m, q);
  const f64 between = dot(nf, nq);
  if (!(between > flat_cosine * square_root(squared_length(nf) * squared_length(nq)))) return;
  if (valence(m, a) <= 3 || valence(m, b) <= 3 || find_edge(m, c, d) != none) return;
  const Trial trials[2] = {{{a, d, c}}, {{d, b, c}}};
  const Vec3 n = nf + nq;
  if (!turns_little(n, normal_of(m, trials[0])) || !turns_little(n, normal_of(m, trials[1]))) return;
  SixVolumes change;
  add(change, 1, m.position[a], m.position[d], m.position[b], m.position[c]);
  s.r.face_mark[f] = s.r.face_mark[q] = 1;
  const bool free =
      stays_outside_out(s.enclosed, a, change) && trials_are_free(m, s.g, s.r.face_mark, trials, 2, Expected::flat);
  s.r.face_mark[f] = s.r.face_mark[q] = 0;
  if (!free) return;
  note_change(s.enclosed, a, change);
  // f = (a, b, c) from h becomes (d, b, c); q = (b, a, d) from k becomes (c, a, d).
  const u32 ca = m.opposite[previous_edge(h)], db = m.opposite[previous_edge(k)];
  set_corner(s.e, h, d);
  set_corner(s.e, k, c);
  link(s.e, h, db);
  link(s.e, k, ca);
  link(s.e, previous_edge(h), previous_edge(k));
  set_vertex_edge(s.e, a, next_edge(k));
  set_vertex_edge(s.e, b, next_edge(h));
  set_vertex_edge(s.e, c, k);
  set_vertex_edge(s.e, d, h);
  insert(s.g, s.e.mesh, f);
  insert(s.g, s.e.mesh, q);
  s.touch(a, b, c, d);
  ++s.result.flips;
}

// ---------------------------------------------------------------- sweeps

bool limit_met(const Remesher& s) { return s.result.out_of_vertices || s.result.out_of_faces; }

// Between operations, when all faces are entered.
void arrange_anew(Remesher& s) {
  arrange(s.clusters, s.e.mesh, s.exec);
  watch(s.g, s.e.mesh, s.clusters);
}

// Squares of lengths of edges.
struct Squares {
  f64 least, most;
};
Squares squares_of(const Mesh& m, u32 f) {
  const Vec3 &p = corner_position(m, 3 * f), &q = corner_position(m, 3 * f + 1), &r = corner_position(m, 3 * f + 2);
  const f64 pq = squared_length(q - p), qr = squared_length(r - q), rp = squared_length(p - r);
  return {min_of(pq, min_of(qr, rp)), max_of(pq, max_of(qr, rp))};
}

// Calls visit(h) once for each living edge, in the order of the faces; faces made on the way are visited too. With
// `as_wanted`, faces all of whose edges lie within that are left out: most are, and their edges are measured together.
void for_each_edge(Remesher& s, const Squares* as_wanted, void (*visit)(Remesher& s, u32 h)) {
  const Mesh& m = s.mesh();
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    if (as_wanted != nullptr) {
      const Squares edges = squares_of(m, f);
      if (edges.least >= as_wanted->least && edges.most <= as_wanted->most) continue;
    }
    for (u32 h = 3 * f; h < 3 * f + 3 && face_lives(m, f) && !limit_met(s); ++h) {
      if (h > m.opposite[h]) continue;
      visit(s, h);
      if (is_crowded(s.g)) arrange_anew(s);
    }
  }
}

// Moves the touched vertices towards the mean of their neighbours within the tangent plane.
void relax(Remesher& s) {
  Mesh& m = s.mesh();
  Relocation& r = s.r;
  u32 n = 0;
  for (u32 v : s.touched) {
    r.vertex_mark[v] = 0;
    if (vertex_lives(m, v)) s.touched[n++] = v;
  }
  s.touched.size = n;
  if (s.o.relaxation == 0) return;
  for (u32 v : s.touched) {
    Vec3 sum, normal;
    u32 count = 0;
    for_each_outgoing(m, v, [&](u32 h) {
      sum = sum + m.position[head(m, h)];
      normal = normal + face_normal(m, face_of(h));
      ++count;
    });
    const Vec3 p = m.position[v], move = 1.0 / count * sum - p;
    const f64 nn = squared_length(normal);
    const Vec3 tangential = nn > 0 ? move - (dot(move, normal) / nn) * normal : Vec3{};
    r.saved[v] = into_exact_range(p + s.o.relaxation * tangential);
  }
  for (u32 v : s.touched) {
    const Vec3 to = r.saved[v];
    r.saved[v] = m.position[v];
    set_position(s.e, v, to);
  }
  s.result.relaxed += settle_many(s.e, s.g, s.clusters, s.touched.span(), s.exec, r, &s.enclosed);
}

}  // namespace

RemeshResult remesh(Edit& e, NearFaces& g, FaceTree& clusters, Components& enclosed, const RemeshOptions& options,
                    const Exec& exec, Relocation& r, Stack<u32>& touched) {
  Remesher s{e,
             g,
             clusters,
             enclosed,
             options,
             exec,
             r,
             touched,
             options.collapse_length * options.collapse_length,
             options.split_length * options.split_length,
             {}};
  for (u32 i = 0; i < options.iterations && !limit_met(s); ++i) {
    touched.clear();
    const u32 before = s.result.splits + s.result.collapses + s.result.flips;
    const Squares not_long{0, s.longest}, not_short{s.shortest, DBL_MAX};
    for_each_edge(s, &not_long, split_long_edge);
    for_each_edge(s, &not_short, collapse_short_edge);
    for_each_edge(s, nullptr, flip_edge);
    relax(s);
    if (s.result.splits + s.result.collapses + s.result.flips == before) break;
  }
  return s.result;
}

}  // namespace tpa
