// SPDX-License-Identifier: MIT
// balloon_remesh: edges of the length aimed at, where the balloon has moved.
#pragma once

#include "tool/segment/balloon_state.h"

namespace tool {

// Near the border, new vertices start with this part of the speed.
inline constexpr float settling_gain = 0.25f;

// Sweeps over the whole mesh.
Status remesh_all(Balloon& b, uint32_t sweeps);

// Sweeps where vertices are due so or more, and round them. These vertices are less due afterwards.
Status remesh_due(Balloon& b, Due due, uint32_t sweeps);

}  // namespace tool
