// SPDX-License-Identifier: MIT
// swallowed_components: whole components that bound nothing, being inside others or turned inside out, and are in
// contact with nothing (section 2: winding numbers tell inside from outside).
#pragma once

#include "detect/contact.h"
#include "detect/winding_number.h"
#include "mesh/component_changes.h"
#include "mesh/component_volumes.h"
#include "mesh/journal.h"

namespace tpa {

enum class JudgeWhat : u8 {
  all,
  changed,  // components that this transaction made or turned inside out; others may lie inside each other, or be
            // inside out, as the caller likes
  moved     // components turned inside out, by a transaction that made none
};

// Removes components of two triangles back to back, as they enclose nothing; returns their number. After
// cutting they would have edges twice. To be called before faces are entered in NearFaces. O(F).
u32 remove_back_to_back(Edit& e);

// Proves that this transaction has left no swallowed component among the changed ones, and no void without a body. The
// parts are known then, until forget_parts(). False proves nothing, and leaves no parts. The mesh is free of contacts.
// O(edits of the transaction + components + faces along a ray for each part and each void).
bool none_swallowed(const Edit& e, const NearFaces& g, i32 winding_at_infinity, Components& before, Parts& p);

// Chooses the components to be judged (verdicts are overwritten); returns whether there are any. O(V).
bool choose_judged(const Edit& e, JudgeWhat what, Components& components);

// Chooses the voids, to be judged. Pre: choose_judged(), of the same components. O(components).
bool choose_voids(const Mesh& m, Components& components);

// Marks the chosen components with a winding number other than 0 on their outer side, and returns their number.
// O(V + components * faces along a ray).
u32 find_swallowed(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Components& components);

// A void whose body is gone goes with it, but a void that had no body is as the caller wants it. So of the marked voids
// stay all that this transaction has neither made nor edited, and that were not inside bodies that it has edited or
// removed; returns how many are still marked. Pre: choose_voids() and find_swallowed(). `before`: the components at the
// start of the transaction, maybe the same. O(edits + components), and O(F) for each marked void.
u32 keep_wanted_voids(const Edit& e, Meter* meter, Components& before, Components& components);

// Removes the components marked by find_swallowed(); returns the number of their vertices. O(V).
u32 remove_swallowed(Edit& e, NearFaces& g, const Components& components);

}  // namespace tpa
