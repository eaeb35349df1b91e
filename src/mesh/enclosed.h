// enclosed: what components enclose while the mesh is edited. What leaves it free of contacts may still turn a
// component inside out: a body that is thinner than its vertices move passes through itself as a whole. So whoever
// edits without judging afterwards asks here first.
#pragma once

#include "mesh/components.h"

namespace tpa {

// Six times the signed volumes over some faces, seen from one point, and what bounds their rounding errors.
struct SixVolumes {
  f64 sum = 0, doubt = 0;
};
// Adds (sign 1) or takes away (-1) a face.
void add(SixVolumes& s, f64 sign, const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c);

// In the sum of coordinates: not less than the length, and exact but for two roundings.
inline f64 size_of(const Vec3& p) { return abs_of(p.x) + abs_of(p.y) + abs_of(p.z); }

// What six volumes change by where v has come from old[v], of several vertices that move one after another, as they are
// numbered; moves(u) is true of all that do, and of others that old has where they are. Seen from where v was: its way
// times the sum of the link's cross products. Each term has eight roundings, and one for each product that is added;
// twice that, since roundings multiply. No branch on where a vertex is, which is as good as random.
template <class Moves>
SixVolumes change_by_move(const Mesh& m, u32 v, const Vec3* old, Moves moves) {
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

// Measures all components, by sums whose errors do not add up (Neumaier 1974). What is known from steps before is not
// used: it depends on how the mesh has come about, and so would what is refused. O(V).
void measure_enclosed(const Mesh& m, Components& c);

// Would the component of v, with what it encloses changed so, certainly not be turned inside out? Pre: measured.
bool stays_outside_out(const Components& c, u32 v, const SixVolumes& change);
void note_change(Components& c, u32 v, const SixVolumes& change);
void note(Component& part, const SixVolumes& change);

// Vertices that were moved together: those with a mark, each from before[v] to where it is.
struct Moves {
  Span<const u32> vertices;
  const u8* mark;
  const Vec3* before;
};
// Collects the vertices of `moves` in components that may be turned inside out by them in `turned`, which is empty.
// Where there are none, notes how the volumes have changed. O(faces round what moved + components).
void find_turned(const Mesh& m, const Moves& moves, Components& c, Stack<u32>& turned);

}  // namespace tpa
