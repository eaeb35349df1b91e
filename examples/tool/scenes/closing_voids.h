// SPDX-License-Identifier: MIT
// closing_voids: voids that a surface closes within a step: each of their vertices reaches the middle, or is overdue,
// that is beyond the surface wanted. Ways beyond the middle would carry a void across itself, out again as another
// void, turned by half a turn, and it might stay for good.
#pragma once

#include "tool/scenes/scene.h"

namespace tool {

// Sends each vertex of such a void through the middle by a third of its distance: the void is inside out, and so gone.
// `overdue`: of each vertex; none without any.
void turn_closing_voids(const Moment& m, const std::vector<bool>& overdue, std::vector<double>& targets);

}  // namespace tool
