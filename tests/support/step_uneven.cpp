// SPDX-License-Identifier: MIT
// Steps of bodies with uneven sampling that grow together, and of a spring that is compressed.
#include <algorithm>
#include <cmath>

#include "oracle/mesh_oracle.h"
#include "oracle/region_columns.h"
#include "support/field_shapes.h"
#include "support/resolve_trial.h"
#include "support/step_noise.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

// A unit sphere with rings of `meridians` vertices at these angles from the pole, and a vertex at each pole.
Mesh SphereOfRings(const std::vector<double>& angles, int meridians) {
  std::vector<Point> points;
  std::vector<double> radii;
  for (double a : angles) {
    points.push_back({0, 0, -tool::cosine(a)});
    radii.push_back(tool::sine(a));
  }
  Mesh m = Tube(points, radii, meridians, {1, 0, 0});
  const size_t poles = m.positions.size() - 6;
  m.positions[poles + 2] = -1;
  m.positions[poles + 5] = 1;
  return m;
}

Mesh Globe(int meridians, int bands) {
  std::vector<double> angles;
  for (int i = 1; i < bands; ++i) angles.push_back(pi * i / bands);
  return SphereOfRings(angles, meridians);
}

// Bands by turns wide and fifty times as narrow.
Mesh Slivers() {
  std::vector<double> angles;
  for (int i = 1; i < 16; ++i)
    for (const double by : {0.0, 0.02}) angles.push_back(pi * (i + by) / 16);
  return SphereOfRings(angles, 24);
}

// Edges grow from one pole to the equator, 1 to 300, each ring as far from the next as its vertices are.
Mesh GradedSphere() {
  constexpr int meridians = 16;
  constexpr double growth = 1 + 2 * pi / meridians;
  std::vector<double> angles;
  for (double t = 0.5 / 300; t < 3; t *= growth) angles.push_back(2 * tool::arc_tangent(t, 1));
  return SphereOfRings(angles, meridians);
}

Mesh Fine() { return Sphere({}, 1, 20); }
Mesh Octahedron() { return Sphere({}, 1, 1); }
Mesh ThinGlobe() { return Globe(6, 120); }
Mesh FlatGlobe() { return Globe(120, 6); }

struct Pair {
  const char* name;
  Mesh (*first)();
  Mesh (*second)();
};

constexpr int steps_after = 8, most_steps = 400;
constexpr double most_event_error = 0.01;

// Two bodies, each with its vertices; the second moves towards the first.
class Approach {
 public:
  Approach(const Pair& pair, double speed, Random& random) : speed_(speed) {
    const Mesh first = RandomlyTurned(pair.first(), random), second = RandomlyTurned(pair.second(), random);
    const double y = Uniform(random, -0.3, 0.3), z = Uniform(random, -0.3, 0.3);
    mesh_ = Together({first, Translated(second, {2.05, y, z})});
    moves_.assign(VertexCount(mesh_), 0);
    std::fill(moves_.begin() + VertexCount(first), moves_.end(), 1);
  }
  const Mesh& mesh() const { return mesh_; }
  std::vector<double> Targets(const Mesh& now) const {
    std::vector<double> targets = now.positions;
    for (size_t v = 0; v < VertexCount(now); ++v) targets[3 * v] -= speed_ * moves_[v];
    return targets;
  }
  void Follow(const tpa_context* context) {
    std::vector<double> next;
    for (const tpa_vertex_origin& origin : VertexOriginsOf(context)) next.push_back(moves_[origin.parents[0]]);
    moves_ = next;
  }

 private:
  double speed_;
  Mesh mesh_;
  std::vector<double> moves_;
};

bool IsOneBody(const Topology& t, int64_t genus) { return t.components.size() == 1 && t.components[0].genus == genus; }

std::string Text(const Topology& t) {
  std::string text = std::to_string(t.components.size()) + " bodies, genera";
  for (int64_t g : t.Genera()) text += " " + std::to_string(g);
  return text;
}

StepTrial PlayPair(const Pair& pair, double speed, uint64_t seed) {
  Random random(seed);
  Approach approach(pair, speed, random);
  StepTrial trial;
  const Arena arena(GenerousConfig(approach.mesh()), approach.mesh());
  int after = 0;
  for (int i = 0; i < most_steps && after <= steps_after; ++i) {
    const Step step = TakeStep(*arena, approach.Targets(MeshOf(*arena)));
    const bool in_contact = after > 0 || step.report.contacts > 0;
    if (step.status != TPA_OK || in_contact) {
      if (!Note(step, trial)) return trial;
    }
    if (in_contact && ++after == 1) {
      const RegionDifference d = CompareRegions(step.moved, step.result, 20000, seed);
      if (std::fabs(d.VolumeError()) > most_event_error)
        return Fail(trial, "first event: volume off by " + std::to_string(d.VolumeError()));
    }
    approach.Follow(*arena);
  }
  const Topology t = TopologyOf(MeshOf(*arena));
  return IsOneBody(t, 0) ? trial : Fail(trial, after > 0 ? Text(t) : "the bodies never met");
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
  static constexpr Pair pairs[] = {{"globes-6x120", ThinGlobe, ThinGlobe}, {"globes-120x6", FlatGlobe, FlatGlobe},
                                   {"slivers", Slivers, Slivers},          {"slivers-fine", Slivers, Fine},
                                   {"octahedron-fine", Octahedron, Fine},  {"graded-300", GradedSphere, GradedSphere}};
  std::vector<StepFamily> families;
  for (const Pair& pair : pairs)
    for (int thousandths : {30, 6})
      families.push_back({std::string("uneven-") + pair.name + "-by-" + std::to_string(thousandths),
                          [=](uint64_t seed) { return PlayPair(pair, 0.001 * thousandths, seed); }, 40});
  return families;
}

std::vector<StepFamily> SpringStepFamilies() {
  return {{"spring-coarse", [](uint64_t seed) { return PlaySpring(false, seed); }, 40},
          {"spring-fine", [](uint64_t seed) { return PlaySpring(true, seed); }, 20}};
}

}  // namespace support
