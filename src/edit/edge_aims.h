// SPDX-License-Identifier: MIT
// edge_aims: the lengths that edges are to have, and the edges that remeshing may change (section 7).
#pragma once

#include "mesh/half_edges.h"

namespace tpa {

struct EdgeAims {
  f64 split, collapse;         // lengths beyond which edges are split and collapsed; with `length` parts of the aim
  f32* length = nullptr;       // per vertex: the length aimed at there; nullptr: the same everywhere
  const u8* chosen = nullptr;  // per vertex: 1 in the part of the mesh to be changed; nullptr: all of it
  bool hubs_wait = false;      // edges at hubs may be too long for now: short edges round a hub are collapsed first
};

// A vertex of so many faces that none of its edges can be collapsed, and its faces are not all tried for each change.
inline constexpr u32 faces_of_no_hub = 96;
inline bool is_hub(const Mesh& m, u32 v) { return has_more_faces(m, v, faces_of_no_hub); }

inline f64 squared_edge(const Mesh& m, u32 h) {
  return squared_length(m.position[head(m, h)] - m.position[tail(m, h)]);
}

inline f64 mean_of(f32 a, f32 b) { return 0.5 * (f64{a} + f64{b}); }
inline f64 aim_between(const EdgeAims& aims, u32 a, u32 b) {
  return aims.length == nullptr ? 1.0 : mean_of(aims.length[a], aims.length[b]);
}
// The middle of an edge aims at the mean of the ends.
inline void aim_at_mean(const EdgeAims& aims, u32 v, u32 a, u32 b) {
  if (aims.length != nullptr) aims.length[v] = static_cast<f32>(mean_of(aims.length[a], aims.length[b]));
}

constexpr f64 square(f64 x) { return x * x; }
inline bool is_too_long(const EdgeAims& aims, f64 squared, u32 a, u32 b) {
  return squared > square(aims.split * aim_between(aims, a, b));
}
inline bool is_too_short(const EdgeAims& aims, f64 squared, u32 a, u32 b) {
  return squared < square(aims.collapse * aim_between(aims, a, b));
}

inline bool is_chosen(const EdgeAims& aims, u32 v) { return aims.chosen == nullptr || aims.chosen[v] != 0; }
inline bool is_chosen(const EdgeAims& aims, u32 a, u32 b) { return is_chosen(aims, a) && is_chosen(aims, b); }

}  // namespace tpa
