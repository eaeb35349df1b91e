// SPDX-License-Identifier: MIT
// volume: signed volumes over faces of the mesh, with bounds on their rounding errors. A component with a change of
// sign has turned inside out, and bounds nothing (section 2).
#pragma once

#include <float.h>

#include "mesh/half_edges.h"

namespace tpa {

// `sum` is six times a signed volume: the sum of a determinant for each face. `doubt` bounds the error of the sum.
struct SignedVolume {
  f64 sum = 0, doubt = 0;
};
// The doubt of a volume not measured.
inline constexpr f64 unknown_volume = DBL_MAX;

void add(SignedVolume& s, const SignedVolume& change);
// Adds (sign 1) or takes away (sign -1) a face, seen from a point.
void add(SignedVolume& s, f64 sign, const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c);
// Adds the faces with v as their smallest vertex. Over all vertices of a component, each face counts once.
void add_faces_above(SignedVolume& s, const Mesh& m, const Vec3& from, u32 v);

// Without the doubt, for sums over all faces of the mesh with one bound for the whole sum.
inline f64 six_volumes_of(const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c) {
  return dot(a - from, cross(b - from, c - from));
}

// The sum of coordinates: not less than the length, and exact but for two roundings.
inline f64 size_of(const Vec3& p) { return abs_of(p.x) + abs_of(p.y) + abs_of(p.z); }

// The change of a volume as v moves from old[v] to the position in the mesh. If several vertices move, they do so one
// after another, in order of number: moves(u) tells whether u is among them, with old[u]. Seen from old[v], the change
// is the way of v times the sum of cross products around the link. Each term has eight roundings, and another for each
// product added. The doubt is twice the sum, since roundings multiply.
template <class Moves>
SignedVolume change_by_move(const Mesh& m, u32 v, const Vec3* old, Moves moves) {
  const Vec3 from = old[v], way = m.position[v] - from;
  const Vec3* const at[] = {m.position, old};
  const auto seen = [&](u32 u) { return at[(u > v) & moves(u)][u] - from; };
  Vec3 a = seen(head(m, m.vertex_edge[v])), normals;
  f64 size = size_of(a), sizes = 0, count = 0;
  for_each_outgoing(m, v, [&](u32 h) {
    const Vec3 b = seen(apex(m, h));
    normals = normals + cross(a, b);
    const f64 last = size;
    size = size_of(b);
    sizes += last * size;
    count += 1;
    a = b;
  });
  return {dot(way, normals), 0x1p-52 * (8 + count) * (size_of(way) * sizes)};
}

}  // namespace tpa
