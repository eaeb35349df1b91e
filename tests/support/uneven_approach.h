// SPDX-License-Identifier: MIT
// uneven_approach: two bodies of uneven sampling, turned at random, grow together step by step: the second moves
// rigidly towards the first, each vertex with its body, until some steps after the first contact.
#pragma once

#include <vector>

#include "support/step_noise.h"

namespace support {

struct UnevenPair {
  const char* name;
  Mesh (*first)();
  Mesh (*second)();
  bool is_aligned = false;  // turned by a few degrees only, so that facets nearly lie upon each other
  double roughness = 0;     // of radii
};
const std::vector<UnevenPair>& UnevenPairs();
// Not among the families of steps (support/step_noise.h): bodies aligned, rough, or squeezed in all directions.
const std::vector<UnevenPair>& HarderPairs();

constexpr int uneven_thousandths[] = {30, 6};  // speeds: of a radius, for each step

struct Approached {
  StepTrial trial;  // wrong or refused: a step failed, or left no sound mesh
  bool met = false;
  // Of the first step with contacts, volumes as shares of both bodies: off from the union of the two moved bodies, and
  // between the result and the union.
  double volume_error = 0, difference = 0;
  uint32_t held_back = 0;  // vertices, in that step
  Topology end;
  bool IsOneBody() const { return end.components.size() == 1 && end.components[0].genus == 0; }
};

enum class Soundness { of_all_steps, of_first_and_last };

// `columns` of CompareChanges.
Approached PlayApproach(const UnevenPair& pair, double speed, int columns, Soundness judged, uint64_t seed);

}  // namespace support
