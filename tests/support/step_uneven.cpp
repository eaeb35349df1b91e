// SPDX-License-Identifier: MIT
// Steps of bodies with uneven sampling that grow together, and of a spring that is compressed.
#include <cmath>

#include "oracle/mesh_oracle.h"
#include "support/field_shapes.h"
#include "support/resolve_trial.h"
#include "support/step_noise.h"
#include "support/tangle_shapes.h"
#include "support/uneven_approach.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

constexpr double most_event_error = 0.01;

bool IsOneBody(const Topology& t, int64_t genus) { return t.components.size() == 1 && t.components[0].genus == genus; }

std::string Text(const Topology& t) {
  std::string text = std::to_string(t.components.size()) + " bodies, genera";
  for (int64_t g : t.Genera()) text += " " + std::to_string(g);
  return text;
}

StepTrial PlayPair(const UnevenPair& pair, double speed, uint64_t seed) {
  Approached a = PlayApproach(pair, speed, 5000, Soundness::of_all_steps, seed);
  if (a.trial.outcome != Outcome::right) return a.trial;
  if (!a.met) return Fail(a.trial, "the bodies never met");
  if (std::fabs(a.volume_error) > most_event_error)
    return Fail(a.trial, "first event: volume off by " + std::to_string(a.volume_error));
  return a.IsOneBody() ? a.trial : Fail(a.trial, Text(a.end));
}

// ---------------------------------------------------------------- a spring

// Turn numbers of the vertices tell how far each sinks when the pitch shrinks.
struct Spring {
  Mesh mesh;
  std::vector<double> turn;
  double tube, pitch;
};

Spring MakeSpring(Random& random, bool fine) {
  Spring s;
  s.tube = Uniform(random, 0.15, 0.3);
  s.pitch = 2.15 * s.tube;
  const double turns = Uniform(random, 1.6, 3);
  const int sides = fine ? WholeIn(random, 10, 16) : WholeIn(random, 6, 9);
  const int per_turn = fine ? WholeIn(random, 36, 56) : WholeIn(random, 16, 30);
  const int steps = static_cast<int>(turns * per_turn);
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) {
    const double turn = turns * i / steps, a = 2 * pi * turn;
    points.push_back({tool::cosine(a), tool::sine(a), s.pitch * turn});
    for (int k = 0; k < sides; ++k) s.turn.push_back(turn);
  }
  s.turn.push_back(0);
  s.turn.push_back(turns);
  s.mesh = Tube(points, std::vector<double>(points.size(), s.tube), sides, {0, 0, 1});
  return s;
}

std::vector<double> FollowedTurns(const tpa_context* context, const std::vector<double>& turn) {
  std::vector<double> next;
  for (const tpa_vertex_origin& origin : VertexOriginsOf(context)) {
    const double w = origin.parents[1] == TPA_NONE ? 1 : static_cast<double>(origin.weight);
    next.push_back(w * turn[origin.parents[0]] + (w < 1 ? (1 - w) * turn[origin.parents[1]] : 0));
  }
  return next;
}

constexpr int settling_steps = 4;  // after the first contact: facets meet one by one
constexpr double most_spring_difference = 0.1;

// Before the turns meet, a body of genus 0; once they have met, one of genus 1, the hole along the axis.
StepTrial PlaySpring(bool fine, uint64_t seed) {
  Random random(seed);
  Spring spring = MakeSpring(random, fine);
  StepTrial trial;
  const Arena arena(GenerousConfig(spring.mesh), spring.mesh);
  const double sink = 0.06 * spring.tube;
  int after = 0;
  for (double pitch = spring.pitch; pitch > 1.4 * spring.tube; pitch -= sink) {
    const Mesh now = MeshOf(*arena);
    std::vector<double> targets = now.positions;
    for (size_t v = 0; v < VertexCount(now); ++v) targets[3 * v + 2] -= sink * spring.turn[v];
    const Step step = TakeStep(*arena, targets);
    if (!Note(step, trial) || !NoteRegion(step, most_spring_difference, seed, trial)) return trial;
    if (after > 0 || step.report.contacts > 0) ++after;
    const Topology t = TopologyOf(step.result);
    if ((after == 0 && !IsOneBody(t, 0)) || (after > settling_steps && !IsOneBody(t, 1)))
      return Fail(trial, std::to_string(after) + " steps after the first contact: " + Text(t));
    spring.turn = FollowedTurns(*arena, spring.turn);
  }
  return after > settling_steps ? trial : Fail(trial, "the turns never met");
}

}  // namespace

std::vector<StepFamily> UnevenStepFamilies() {
  std::vector<StepFamily> families;
  for (const UnevenPair& pair : UnevenPairs())
    for (int thousandths : uneven_thousandths)
      families.push_back({std::string("uneven-") + pair.name + "-by-" + std::to_string(thousandths),
                          [=](uint64_t seed) { return PlayPair(pair, 0.001 * thousandths, seed); }, 40});
  return families;
}

std::vector<StepFamily> SpringStepFamilies() {
  return {{"spring-coarse", [](uint64_t seed) { return PlaySpring(false, seed); }, 40},
          {"spring-fine", [](uint64_t seed) { return PlaySpring(true, seed); }, 20}};
}

}  // namespace support
