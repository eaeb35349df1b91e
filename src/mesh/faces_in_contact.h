// SPDX-License-Identifier: MIT
// faces_in_contact: the faces that met when an attempt began, as the move had left them, and how far changes lie from
// these faces. Each bound is the distance from one such face, so it is never less than that from the nearest.
#pragma once

#include "base/meter.h"
#include "mesh/journal.h"

namespace tpa {

// What a step knows of a vertex with a target: already reached; taken by this step; or refused, since the vertex is
// held back. Vertices without a target have 0.
inline constexpr u8 target_reached = 1, target_taken = 2, target_refused = 3, target_state = 3;

// The mesh of a transaction after the move, before the first change.
struct MovedMesh {
  const Edit& edit;
  const Vec3* target;
  const u8* marks;  // per vertex, with others

  // Of an old vertex: its target, unless it stayed behind.
  const Vec3& position(u32 v) const {
    return (marks[v] & target_state) == target_taken ? target[v] : old_position(edit, v);
  }
};

struct FacesInContact {
  MovedMesh moved;
  BitSet faces;
  Meter* meter = nullptr;
  u32 last = none;  // the face from which the last hull was measured

  void clear() {
    faces.cut_off(0);
    last = none;
  }
  bool contains(u32 f) const { return f != none && faces.contains(f); }
  // One of them, and at best the origin of f, among the origins of the faces round v; else none.
  u32 near(u32 v, u32 f) const;

  // The reach so far, or more where the hull of some points lies farther from each face: the distance of its farthest
  // point from the best of them. `near` (or none) and the last face are asked first; O(faces) where both are far.
  f64 reach_of(const Vec3* points, u32 count, u32 near, f64 so_far);

 private:
  f64 squared_reach(const Vec3* points, u32 count, u32 f, f64 at_most) const;
};

}  // namespace tpa
