// SPDX-License-Identifier: MIT
// face_pair: do two given faces meet beyond a common vertex or edge? The exact triangle test of section 3, with cheap
// proofs in front.
#pragma once

#include "geometry/predicates.h"
#include "mesh/half_edges.h"

namespace tpa {

inline const u32* face_corners(const Mesh& m, u32 f) { return m.corner + 3 * static_cast<size_t>(f); }

// Bit i: corner i of f is a vertex of g.
inline u32 shared_corners(const u32* f, const u32* g) {
#if defined(TPA_VECTORS)
  const auto all = [](u32 v) { return I4{} + static_cast<i32>(v); };
  const I4 of_f = {static_cast<i32>(f[0]), static_cast<i32>(f[1]), static_cast<i32>(f[2]), 0};
  return bits_of((of_f == all(g[0])) | (of_f == all(g[1])) | (of_f == all(g[2]))) & 7;
#else
  u32 shared = 0;
  for (u32 i = 0; i < 3; ++i) shared |= u32{f[i] == g[0] || f[i] == g[1] || f[i] == g[2]} << i;
  return shared;
#endif
}

// Do two triangles, given by three different vertices each, meet beyond shared vertices and edges? Faces of the mesh or
// not. Exact; touching counts.
bool corners_meet(const Mesh& m, const u32* f, const u32* g);
inline bool faces_meet(const Mesh& m, u32 f, u32 g) { return corners_meet(m, face_corners(m, f), face_corners(m, g)); }

inline constexpr u64 of_exact_test = 6;  // units of work

// A triangle with its plane, to be tested against several others.
struct Probe {
  const u32* v;
  Plane plane;
};
inline Probe probe_of(const Mesh& m, const u32* v) {
  return {v, plane_of(m.position[v[0]], m.position[v[1]], m.position[v[2]])};
}
// Do all corners of g, but for those shared with f, certainly lie strictly on one side of the plane of f? Then the
// faces do not meet. False if all corners are shared.
inline bool lies_beside(const Mesh& m, const Probe& f, const u32* g) {
  const CertainSides s = certain_sides(f.plane, m.position[g[0]], m.position[g[1]], m.position[g[2]]);
  const u32 shared = shared_corners(g, f.v);
  return (((s.above | shared) == 7) | ((s.below | shared) == 7)) & (shared != 7);
}
// The answer of corners_meet(); mostly one of the two planes decides.
bool meets(const Mesh& m, const Probe& f, const u32* g);

// Is it proven that no two faces round v meet beyond their common vertices and edges? `star` keeps the answer: one
// entry per vertex, zeroed by the caller, open to several threads at once. False proves nothing.
bool star_proven(const Mesh& m, u8* star, u32 v);

}  // namespace tpa
