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

// What is known after each step, and at the end.
struct Evolution {
  uint32_t steps = 0;
  // Steps that the surface took. Parts that move towards each other by less than an edge cannot pass through each other
  // unnoticed where they are at least an edge thick. So a step in which two vertices may come nearer to each other by
  // more than that is cut into such that do not. The bound on what they may is twice the longest way of a vertex
  // beside the mean of all.
  uint32_t substeps = 0;
  uint32_t long_steps = 0;  // steps beyond that bound that were not cut, since substeps was false
  uint32_t steps_with_rollback = 0;
  uint32_t longest_stall = 0;  // most steps in a row with vertices that stayed behind
  double time = 0;
  EventCounts events;
  // detect: steps of the surface that met no contact (they move and detect); adapt: those that did; evolve: the scene.
  struct Seconds {
    double total = 0, detect = 0, adapt = 0, remesh = 0, evolve = 0;
  } seconds;
};

// Is the scene's end what should come of it, played like this? Steps longer than its own end otherwise, unless it says
// that they do not, and steps that were not cut may have passed through the surface.
bool end_is_known(const Scene& scene, const EvolutionOptions& options, const Evolution& evolution);

// Called after each step (with its remeshing); false ends the evolution.
using EvolutionObserver = std::function<bool(const Surface& surface, const Evolution& evolution)>;

// Fails where the library fails.
Status evolve(const Scene& scene, const EvolutionOptions& options, const EvolutionObserver& observer, Surface& surface,
              Evolution& evolution);

}  // namespace tool
