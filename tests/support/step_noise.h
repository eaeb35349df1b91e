// SPDX-License-Identifier: MIT
// step_noise: tpa_step where much goes wrong at once, or sampling is uneven. Noise: each vertex of a clean mesh gets a
// target within so many mean edges, once or eight times in a row. Uneven bodies: two of them approach, and grow
// together. A spring: its turns approach until they overlap. Each step is judged by the region of winding number >= 1
// of the mesh of targets, with the vertices rolled back at their old places.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/region_trial.h"
#include "support/support.h"

namespace support {

struct StepTrial {
  Outcome outcome = Outcome::right;
  std::string reason;          // empty if right
  tpa_status status = TPA_OK;  // of the last step noted
  Mesh before, moved, result;  // of the step at fault, or of the last one
  double seconds = 0;          // of the longest step
  double rolled_back = 0;      // vertices kept at their places, as a share, in the worst step
};

struct StepFamily {
  std::string name;
  std::function<StepTrial(uint64_t seed)> play;
  uint32_t count;  // in the long run, seeds 1 .. count
};

inline void PrintTo(const StepFamily& family, std::ostream* out) { *out << family.name; }

const std::vector<StepFamily>& StepFamilies();
// The parts of the list.
std::vector<StepFamily> NoiseStepFamilies();
std::vector<StepFamily> UnevenStepFamilies();
std::vector<StepFamily> SpringStepFamilies();

// One step, and what it should have led to.
struct Step {
  tpa_status status = TPA_OK;
  tpa_issue issue{};
  tpa_report report{};
  Mesh before, moved, result;  // moved: at the targets, or at its old places where rolled back
  std::vector<double> targets;
  double seconds = 0;
};

Step TakeStep(tpa_context* context, const std::vector<double>& targets);
// With targets set before: those that lead to `targets`.
Step TakeStepTo(tpa_context* context, const std::vector<double>& targets);
// Notes the step in the trial: false if the trial is over, since the step failed, or left no sound mesh.
bool Note(const Step& step, StepTrial& trial);
// Likewise, if the region of the result is off by more than this share of the true volume.
bool NoteRegion(const Step& step, double most, uint64_t seed, StepTrial& trial);
StepTrial& Fail(StepTrial& trial, std::string reason);

}  // namespace support
