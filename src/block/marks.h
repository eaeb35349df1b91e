// SPDX-License-Identifier: MIT
// marks: what a step knows of each vertex, two states side by side in a byte.
#pragma once

#include "block/context.h"

namespace tpa {

// First the target: already reached; taken by this step; or refused, since the vertex is held back. Vertices without a
// target have 0. set_target() writes target_reached, and each step overwrites it.
inline constexpr u8 target_reached = 1, target_taken = 2, target_refused = 3, target_state = 3;
// Second: a vertex held back keeps its old position for the rest of the step. Of a vertex newly held back, neighbours
// are still to be held back (islands/hold_back.h).
inline constexpr u8 free_vertex = 0, frozen_vertex = 4, newly_frozen = 8, frozen_state = 12;

inline u8 state_of(const Workspace& w, u32 v, u8 state) { return w.marks[v] & state; }
inline void set_state(Workspace& w, u32 v, u8 state, u8 value) {
  w.marks[v] = static_cast<u8>((w.marks[v] & ~state) | value);
}

// Where an old vertex was after the move, before the first change: at its target, unless it stayed behind.
inline const Vec3& moved_position(const Workspace& w, u32 v) {
  return state_of(w, v, target_state) == target_taken ? w.target[v] : old_position(w.edit, v);
}

inline void set_target(Workspace& w, u32 v, const Vec3& p) {
  w.target[v] = p;
  w.context.target_count += w.targets.add(v) ? 1u : 0u;
  w.marks[v] = target_reached;
}

}  // namespace tpa
