// SPDX-License-Identifier: MIT
// turned: components that a step turns inside out in a heap of folds, as a body that shrinks to nothing within the
// step. The region keeps crumbs of the folds alone; cut exactly, they would be a sponge, and fold further on their
// ways.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Before the contacts are cut: removes components that the move has turned inside out, that meet no other component,
// and that have as many contacts as vertices. Their crumbs, measured by winding numbers at the points of a grid, must
// be thinner than their triangles. All contacts are known. O(contacts + components).
void drop_turned(Attempt& a);

}  // namespace tpa
