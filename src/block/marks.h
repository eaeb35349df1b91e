// SPDX-License-Identifier: MIT
// marks: what a step knows of each vertex, two states side by side in a byte.
#pragma once

#include "block/context.h"
#include "mesh/faces_in_contact.h"

namespace tpa {

// First the target (mesh/faces_in_contact.h). set_target() writes target_reached, and each step overwrites it.
// Second: a vertex held back keeps its old position for the rest of the step. Of a vertex newly held back, neighbours
// are still to be held back (islands/hold_back.h).
inline constexpr u8 free_vertex = 0, frozen_vertex = 4, newly_frozen = 8, frozen_state = 12;

inline u8 state_of(const Workspace& w, u32 v, u8 state) { return w.marks[v] & state; }
inline void set_state(Workspace& w, u32 v, u8 state, u8 value) {
  w.marks[v] = static_cast<u8>((w.marks[v] & ~state) | value);
}

inline MovedMesh moved_mesh(const Workspace& w) { return {w.edit, w.target, w.marks}; }
inline const Vec3& moved_position(const Workspace& w, u32 v) { return moved_mesh(w).position(v); }

inline void set_target(Workspace& w, u32 v, const Vec3& p) {
  w.target[v] = p;
  w.context.target_count += w.targets.add(v) ? 1u : 0u;
  w.marks[v] = target_reached;
}

}  // namespace tpa
