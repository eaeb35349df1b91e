// swallowed_components: whole components that bound nothing, since they lie inside others or are turned inside out, and
// are in contact with nothing.
#pragma once

#include "detect/detect_moved.h"
#include "detect/winding_number.h"
#include "mesh/component_changes.h"
#include "mesh/component_volumes.h"
#include "mesh/journal.h"

namespace tpa {

enum class JudgeWhat : u8 {
  all,
  changed,  // what this transaction made or turned inside out, and voids, whose bodies may be gone; others may lie
            // inside each other as the caller likes
  moved     // what it turned inside out, where it made nothing
};

// Removes components of two triangles, which lie back to back and enclose nothing; returns how many. Halved or cut they
// would have edges twice. Before faces are entered in the near_faces. O(V).
u32 remove_back_to_back(Edit& e);

// A proof that there is nothing of the kind among what this transaction changed, and no void left over by it, at the
// cost of what it touched, and of a ray for each void. The parts are known then, until forget_parts(). False proves
// nothing, and leaves no parts. The mesh is free of contacts.
bool none_swallowed(const Edit& e, const NearFaces& g, i32 winding_at_infinity, Components& before, Parts& p);

// Of the components of the mesh, chooses those to be judged (verdicts are overwritten); says whether there are any.
// None of them is in contact. O(V).
bool choose_judged(const Edit& e, JudgeWhat what, Span<const Contact> contacts, Components& components);

// Of the chosen ones, marks those whose outer side has another winding number than 0, and returns how many they are.
// O(V + components * faces along a ray).
u32 find_swallowed(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Components& components);

// Removes the components that find_swallowed() marked; returns how many vertices they had. O(V).
u32 remove_swallowed(Edit& e, NearFaces& g, const Components& components);

}  // namespace tpa
