// SPDX-License-Identifier: MIT
#include "support/uneven_approach.h"

#include <algorithm>

#include "oracle/mesh_oracle.h"
#include "oracle/region_columns.h"
#include "support/resolve_trial.h"
#include "support/tangle_shapes.h"
#include "support/uneven_bodies.h"

namespace support {

namespace {

Mesh Fine() { return Sphere({}, 1, 20); }
Mesh Octahedron() { return Sphere({}, 1, 1); }
Mesh SliverSphere() { return Slivers(24, 16); }
Mesh Graded300() { return GradedSphere(16, 300); }
Mesh ThinGlobe() { return Globe(6, 120); }
Mesh FlatGlobe() { return Globe(120, 6); }
Mesh LongSlivers() { return Slivers(6, 60); }
Mesh NeedleSphere() { return Needles(12, 16); }
Mesh SqueezedSphere() { return Squeezed(10); }

constexpr int steps_after = 8, most_steps = 400;

// By any angles, or by a few degrees.
Mesh TurnedAs(const UnevenPair& pair, const Mesh& m, Random& random) {
  if (pair.roughness > 0) {
    const auto rough = [&](const Point& p) { return Scaled(1 + pair.roughness * Uniform(random, -1, 1), p); };
    return RandomlyTurned(Mapped(m, rough), random);
  }
  if (!pair.is_aligned) return RandomlyTurned(m, random);
  const Point tilt = RandomPoint(random, -0.1, 0.1);
  const Point x = Unit({1, tilt[0], tilt[1]}), z = Unit(Cross(x, {0, 1, tilt[2]})), y = Cross(z, x);
  return Mapped(m, [&](const Point& p) { return Sum(Scaled(p[0], x), Sum(Scaled(p[1], y), Scaled(p[2], z))); });
}

// Two bodies, each with its vertices; the second moves towards the first.
class Approach {
 public:
  Approach(const UnevenPair& pair, double speed, Random& random) : speed_(speed) {
    const Mesh first = TurnedAs(pair, pair.first(), random), second = TurnedAs(pair, pair.second(), random);
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

}  // namespace

const std::vector<UnevenPair>& UnevenPairs() {
  static const std::vector<UnevenPair> pairs = {
      {"globes-6x120", ThinGlobe, ThinGlobe},     {"globes-120x6", FlatGlobe, FlatGlobe},
      {"slivers", SliverSphere, SliverSphere},    {"slivers-fine", SliverSphere, Fine},
      {"slivers-long", LongSlivers, LongSlivers}, {"octahedron-fine", Octahedron, Fine},
      {"graded-300", Graded300, Graded300}};
  return pairs;
}

const std::vector<UnevenPair>& HarderPairs() {
  static const std::vector<UnevenPair> pairs = {{"globe-fine", ThinGlobe, Fine},
                                                {"needles", NeedleSphere, NeedleSphere},
                                                {"squeezed", SqueezedSphere, SqueezedSphere},
                                                {"slivers-aligned", SliverSphere, SliverSphere, true},
                                                {"needles-aligned", NeedleSphere, NeedleSphere, true},
                                                {"globes-rough", ThinGlobe, ThinGlobe, false, 0.01}};
  return pairs;
}

Approached PlayApproach(const UnevenPair& pair, double speed, int columns, Soundness judged, uint64_t seed) {
  Random random(seed);
  Approach approach(pair, speed, random);
  Approached a;
  const Arena arena(GenerousConfig(approach.mesh()), approach.mesh());
  int after = 0;
  for (int i = 0; i < most_steps && after <= steps_after; ++i) {
    const Mesh now = MeshOf(*arena);
    const Mesh moved{approach.Targets(now), now.triangles};
    const Step step = TakeStep(*arena, moved.positions);
    a.met = a.met || step.report.contacts > 0;
    after += a.met ? 1 : 0;
    const bool is_judged = after == 1 || after > steps_after || (a.met && judged == Soundness::of_all_steps);
    if ((step.status != TPA_OK || is_judged) && !Note(step, a.trial)) return a;
    if (after == 1) {
      const RegionDifference d = CompareChanges(moved, step.result, columns, seed);
      const double volume = TopologyOf(moved).Volume();
      a.volume_error = (d.gained - d.lost) / volume;
      a.difference = (d.gained + d.lost) / volume;
      a.held_back = step.report.rolled_back_vertices;
    }
    approach.Follow(*arena);
  }
  a.end = TopologyOf(MeshOf(*arena));
  return a;
}

}  // namespace support
