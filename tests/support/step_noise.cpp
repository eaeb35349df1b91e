// SPDX-License-Identifier: MIT
#include "support/step_noise.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "oracle/mesh_oracle.h"
#include "oracle/region_columns.h"
#include "support/field_shapes.h"
#include "support/resolve_trial.h"
#include "support/tangle_shapes.h"

namespace support {

namespace {

// Old vertices that the last commit left at their old places go back.
void RollBack(const tpa_context* context, const Mesh& before, Mesh& moved) {
  const uint32_t* kept = nullptr;
  uint32_t count = 0;
  EXPECT_EQ(tpa_rolled_back(context, &kept, &count), TPA_OK);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
  for (uint32_t i = 0; i < count; ++i) {
    const tpa_vertex_origin& origin = origins[kept[i]];
    if (origin.parents[1] != TPA_NONE) continue;
    for (size_t c = 0; c < 3; ++c) {
      const size_t at = 3 * size_t{origin.parents[0]} + c;
      moved.positions[at] = before.positions[at];
    }
  }
}

std::string Text(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f %%", 100 * share);
  return text;
}

}  // namespace

Step TakeStep(tpa_context* context, const std::vector<double>& targets) {
  tpa_issue issue;
  if (MoveAll(context, targets, &issue) == TPA_OK) return TakeStepTo(context, targets);
  Step s;
  s.before = s.result = MeshOf(context);
  s.moved = {targets, s.before.triangles};
  s.status = issue.status, s.issue = issue;
  return s;
}

Step TakeStepTo(tpa_context* context, const std::vector<double>& targets) {
  Step s;
  s.before = MeshOf(context);
  s.moved = {targets, s.before.triangles};
  s.targets = targets;
  s.report = Sized<tpa_report>();
  const auto start = std::chrono::steady_clock::now();
  s.status = tpa_step(context, nullptr, &s.report, &s.issue);
  s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  s.result = MeshOf(context);
  if (s.status == TPA_OK && s.report.rolled_back_vertices > 0) RollBack(context, s.before, s.moved);
  return s;
}

StepTrial& Fail(StepTrial& trial, std::string reason) {
  trial.outcome = Outcome::wrong;
  trial.reason = std::move(reason);
  return trial;
}

bool Note(const Step& s, StepTrial& trial) {
  trial.before = s.before, trial.moved = s.moved, trial.result = s.result;
  trial.status = s.status;
  trial.seconds = std::max(trial.seconds, s.seconds);
  if (s.status != TPA_OK) {
    const bool same = s.before.positions == s.result.positions && s.before.triangles == s.result.triangles;
    trial.outcome = same ? Outcome::refused : Outcome::wrong;
    trial.reason = support::Text(s.issue) + (same ? "" : ", but the mesh has changed");
    return false;
  }
  trial.rolled_back = std::max(
      trial.rolled_back, static_cast<double>(s.report.rolled_back_vertices) / std::max(1u, VertexCount(s.result)));
  const std::string fault = FaultOf(s.result);
  if (!fault.empty()) Fail(trial, fault);
  return fault.empty();
}

bool NoteRegion(const Step& s, double most, uint64_t seed, StepTrial& trial) {
  const RegionDifference d = CompareRegions(s.moved, s.result, 3000, seed);
  if (d.Lost() + d.Gained() <= most) return true;
  Fail(trial, Text(d.Lost()) + " lost, " + Text(d.Gained()) + " gained, " + Text(trial.rolled_back) + " rolled back");
  return false;
}

// ---------------------------------------------------------------- noise

namespace {

Mesh SphereOf(int parts) { return Sphere({}, 1, parts); }
Mesh NoisyTorus(int around) { return Torus({}, 1, 0.4, around, around / 2); }
Mesh NoisySlab(int cells) { return Slab(2, 2, 0.5, 2.0 / cells); }

struct NoiseBody {
  const char* name;
  Mesh (*make)(int fineness);
  int fineness;
  uint32_t count;
};

constexpr double most_difference = 0.05, most_rolled_back = 0.5;

StepTrial Refuse(StepTrial trial, std::string reason) {
  trial.outcome = Outcome::refused;
  trial.reason = std::move(reason);
  return trial;
}

StepTrial PlayNoise(const Mesh& clean, double edges, int steps, uint64_t seed) {
  Random random(seed);
  StepTrial trial;
  const Arena arena(GenerousConfig(clean), clean);
  for (int i = 0; i < steps; ++i) {
    const Mesh now = MeshOf(*arena);
    if (now.triangles.empty()) break;
    const double far = edges * MeanEdgeOf(now);
    std::vector<double> targets = now.positions;
    for (double& x : targets) x += Uniform(random, -far, far);
    const Step step = TakeStep(*arena, targets);
    if (!Note(step, trial) || !NoteRegion(step, most_difference, seed, trial)) {
      trial.reason = "step " + std::to_string(i + 1) + ": " + trial.reason;
      break;
    }
  }
  if (trial.outcome == Outcome::right && trial.rolled_back > most_rolled_back)
    trial = Refuse(trial, Text(trial.rolled_back) + " rolled back");
  return trial;
}

}  // namespace

std::vector<StepFamily> NoiseStepFamilies() {
  static constexpr NoiseBody bodies[] = {{"sphere-66", SphereOf, 4, 20},    {"sphere-258", SphereOf, 8, 20},
                                         {"sphere-402", SphereOf, 10, 20},  {"sphere-1602", SphereOf, 20, 4},
                                         {"torus-288", NoisyTorus, 24, 20}, {"slab-434", NoisySlab, 12, 20}};
  static constexpr int hundredths[] = {50, 75, 90, 100, 125};
  std::vector<StepFamily> families;
  for (const NoiseBody& body : bodies)
    for (int q : hundredths)
      for (int steps : {1, 8}) {
        const std::string name = std::string("noise-") + body.name + "-by-" + std::to_string(q) +
                                 (steps > 1 ? "-times-" + std::to_string(steps) : "");
        families.push_back({name,
                            [=](uint64_t seed) { return PlayNoise(body.make(body.fineness), 0.01 * q, steps, seed); },
                            body.count});
      }
  return families;
}

const std::vector<StepFamily>& StepFamilies() {
  static const std::vector<StepFamily> families = [] {
    std::vector<StepFamily> all;
    for (const auto& part : {NoiseStepFamilies(), UnevenStepFamilies(), SpringStepFamilies()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return families;
}

}  // namespace support
