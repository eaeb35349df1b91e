// SPDX-License-Identifier: MIT
#include "support/report_trial.h"

#include "support/coarse_trial.h"
#include "support/field_shapes.h"
#include "support/mixed_seed.h"
#include "support/resolve_trial.h"
#include "support/tangle_shapes.h"

namespace support {

namespace {

Step StepTo(const Mesh& clean, const Mesh& moved) {
  const Arena arena(GenerousConfig(clean), clean);
  return TakeStep(*arena, moved.positions);
}

// Each coordinate by up to so many mean edges.
Step StepOfNoise(int parts, double edges, uint64_t seed) {
  Random random(seed);
  const Mesh clean = Sphere({}, 1, parts);
  const double far = edges * MeanEdgeOf(clean);
  Mesh moved = clean;
  for (double& x : moved.positions) x += Uniform(random, -far, far);
  return StepTo(clean, moved);
}

// An overlap of a twentieth to a half of a radius.
Step StepOfBalls(int parts, uint64_t seed) {
  Random random(seed);
  const Mesh a = RandomlyTurned(Sphere({}, 1, parts), random), b = RandomlyTurned(Sphere({}, 1, parts), random);
  const Point way = RandomDirection(random);
  const auto apart = [&](double distance) { return Together({a, Translated(b, Scaled(distance, way))}); };
  return StepTo(apart(2.1), apart(Uniform(random, 1.5, 1.95)));
}

std::vector<ReportFamily> MakeFamilies() {
  std::vector<ReportFamily> families;
  for (const CoarseFamily& coarse : CoarseFamilies())
    families.push_back({coarse.name, [&coarse](uint64_t seed) { return PlayCoarse(coarse, seed).step; }});
  for (const int parts : {4, 8})
    for (const int hundredths : {30, 50, 75})
      families.push_back({"noise-" + std::to_string(parts) + "-by-" + std::to_string(hundredths),
                          [=](uint64_t seed) { return StepOfNoise(parts, 0.01 * hundredths, seed); }});
  for (const int parts : {5, 9})
    families.push_back({"balls-" + std::to_string(parts), [=](uint64_t seed) { return StepOfBalls(parts, seed); }});
  return families;
}

}  // namespace

const std::vector<ReportFamily>& ReportFamilies() {
  static const std::vector<ReportFamily> families = MakeFamilies();
  return families;
}

std::string ReportTrial::Text() const {
  std::string text;
  if (verdict.volume_less) text += "volume told too small; ";
  if (verdict.volume_twice) text += "volume told more than twice; ";
  if (verdict.reach_less) text += "reach told too small; ";
  if (verdict.reach_twice) text += "reach told more than twice; ";
  return text + verdict.text;
}

ReportTrial PlayReport(const ReportFamily& family, uint64_t seed) {
  ReportTrial t;
  t.step = family.play(seed);
  if (t.step.status != TPA_OK || t.step.report.contacts == 0) return t;
  std::vector<TriangleCorners> contacts = TrianglesInContact({t.step.targets, t.step.before.triangles});
  t.meets = !contacts.empty();
  if (t.step.report.rolled_back_vertices > 0)
    for (const TriangleCorners& c : TrianglesInContact(t.step.moved)) contacts.push_back(c);
  t.verdict = JudgeReport(t.step.moved, t.step.result, contacts, t.step.report, seed);
  return t;
}

}  // namespace support
