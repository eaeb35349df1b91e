// SPDX-License-Identifier: MIT
// evolution: plays a scene on a surface, step by step.
#pragma once

#include "tool/events.h"
#include "tool/scenes/scene.h"
#include "tool/surface.h"

namespace tool {

struct EvolutionOptions {
  double stride = 0;     // longest way of a vertex in one step, in mean edge lengths; 0: the scene's own step of time
  bool substeps = true;  // cut long steps; see Evolution::substeps
  SurfaceBounds bounds;
};

// State after each step, and at the end.
struct Evolution {
  uint32_t steps = 0;
  // Steps taken by the surface. Parts at least an edge thick cannot pass through each other unnoticed while they
  // approach each other by less than an edge. So a step is cut into shorter steps if two vertices may approach each
  // other by more. The bound on an approach is twice the longest way of a vertex relative to the mean way of all.
  uint32_t substeps = 0;
  uint32_t long_steps = 0;  // steps beyond that bound left uncut, since substeps was false
  uint32_t steps_with_rollback = 0;
  uint32_t longest_stall = 0;  // most steps in a row with vertices left behind
  double time = 0;
  EventCounts events;
  // detect: steps of the surface without a contact (they move and detect); adapt: steps with contacts; evolve: the
  // scene.
  struct Seconds {
    double total = 0, detect = 0, adapt = 0, remesh = 0, evolve = 0;
  } seconds;
};

// Is the known end of the scene binding for these options? Steps longer than the scene's own may end otherwise, unless
// the scene allows them, and uncut steps may have passed through the surface.
bool end_is_known(const Scene& scene, const EvolutionOptions& options, const Evolution& evolution);

// Called after each step (with its remeshing); false ends the evolution.
using EvolutionObserver = std::function<bool(const Surface& surface, const Evolution& evolution)>;

// Fails if the library fails.
Status evolve(const Scene& scene, const EvolutionOptions& options, const EvolutionObserver& observer, Surface& surface,
              Evolution& evolution);

}  // namespace tool
