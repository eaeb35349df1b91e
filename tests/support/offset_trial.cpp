// SPDX-License-Identifier: MIT
#include "support/offset_trial.h"

#include <cmath>

#include "support/field_shapes.h"
#include "support/mixed_seed.h"
#include "support/resolve_trial.h"
#include "support/tangle_shapes.h"
#include "support/uneven_bodies.h"

namespace support {

namespace {

// ---------------------------------------------------------------- scenes of about the size 1

Mesh RandomBody(Random& random) {
  switch (WholeIn(random, 0, 3)) {
    case 0: return Sphere({}, 1, WholeIn(random, 1, 6));
    case 1: return RandomlyTurned(Globe(WholeIn(random, 4, 6), WholeIn(random, 8, 30)), random);
    case 2: return RandomlyTurned(Slivers(WholeIn(random, 5, 10), WholeIn(random, 4, 8)), random);
    default: return RandomlyTurned(Sphere({}, 1, WholeIn(random, 2, 5)), random);
  }
}

// The second body begins behind x = 0.
Mesh Pair(Random& random) {
  return Together({Translated(RandomBody(random), {-1.02, 0, 0}),
                   Translated(RandomBody(random), {1.02, Uniform(random, -0.5, 0.5), Uniform(random, -0.5, 0.5)})});
}

Mesh PairMoved(const Mesh& m, Random& random) {
  const double by = 0.03 + std::pow(10, Uniform(random, -3, -0.2));
  return Mapped(m, [&](const Point& p) { return Point{p[0] + (p[0] < 0 ? by : -by), p[1], p[2]}; });
}

Mesh Ball(Random& random) { return RandomBody(random); }

Mesh Shaken(const Mesh& m, double edges, Random& random) {
  const double by = edges * MeanEdgeOf(m);
  return Mapped(m, [&](const Point& p) { return Sum(p, Scaled(by, RandomPoint(random, -1, 1))); });
}

Mesh Crumpled(const Mesh& m, Random& random) { return Shaken(m, Uniform(random, 0.2, 1.2), random); }

Mesh ShakenALittle(const Mesh& m, Random& random) { return Shaken(m, Uniform(random, 0.1, 0.6), random); }

Mesh CoarseTorus(Random& random) {
  return RandomlyTurned(Torus({}, 1, Uniform(random, 0.25, 0.6), WholeIn(random, 4, 12), WholeIn(random, 3, 9)),
                        random);
}

Mesh OneMoved(const Mesh& m, Random& random) {
  Mesh moved = m;
  const double way = Uniform(random, 0.3, 3) * MeanEdgeOf(m);
  const Point d = RandomDirection(random);
  const size_t v = random() % VertexCount(m);
  for (size_t i = 0; i < 3; ++i) moved.positions[3 * v + i] += way * d[i];
  return moved;
}

// Boxes on a lattice of quarters whose faces come to lie upon each other.
Mesh LatticeBoxes(Random& random) {
  const int n = WholeIn(random, 1, 4);
  const Point shift{1.25, 0.25 * WholeIn(random, -3, 3), 0.25 * WholeIn(random, -3, 3)};
  return Together({Box({0, 0, 0}, {1, 1, 1}, n), Translated(Box({0, 0, 0}, {1, 1, 1}, WholeIn(random, 1, 4)), shift)});
}

Mesh BoxesMoved(const Mesh& m, Random& random) {
  const double by = 0.25 * WholeIn(random, 1, 4);
  return Mapped(m, [&](const Point& p) { return Point{p[0] > 1.1 ? p[0] - by : p[0], p[1], p[2]}; });
}

Mesh TangledBodies(Random& random) {
  if (Coin(random)) return PairMoved(Pair(random), random);
  return Crumpled(Ball(random), random);
}

// ---------------------------------------------------------------- judgement

constexpr int any_power = -1;  // 7 .. 12: rounding of a 2^-30th of an edge to a thousandth

Point RandomOffset(double offset, Random& random) {
  if (offset < 0) offset = std::pow(10, Uniform(random, 7, 12));
  Point p{};
  for (double& x : p) x = offset * Uniform(random, 0.3, 1) * (Coin(random) ? 1 : -1);
  return p;
}

OffsetTrial JudgeAdapt(const Mesh& tangled) {
  OffsetTrial t;
  const Arena arena(GenerousConfig(tangled), tangled);
  Step& s = t.step;
  s.before = s.moved = tangled;
  s.report = Sized<tpa_report>();
  const Observed before = Observe(*arena);
  s.status = tpa_adapt(*arena, nullptr, &s.report, &s.issue);
  s.result = MeshOf(*arena);
  t.meets = s.report.contacts > 0;
  if (s.status != TPA_OK) {
    if (Observe(*arena) != before) t.fault = "refused, but something has changed";
    return t;
  }
  const Topology topology = TopologyOf(s.result);
  const size_t left = topology.defect.empty() ? AllMeetingPairs(s.result).size() : 0;
  if (!topology.defect.empty())
    t.fault = topology.defect;
  else if (left != s.report.unresolved)
    t.fault = std::to_string(left) + " pairs meet, " + std::to_string(s.report.unresolved) + " are counted";
  return t;
}

bool MeetsNothing(const Mesh& m) { return AllMeetingPairs(m).empty(); }

OffsetTrial JudgeStep(tpa_context* context, const Mesh& moved) {
  OffsetTrial t;
  EXPECT_EQ(MoveAll(context, moved.positions), TPA_OK);
  const Observed seen = Observe(context);
  t.step = TakeStepTo(context, moved.positions);
  t.meets = t.step.report.contacts > 0;
  if (t.step.status == TPA_OK) {
    t.fault = FaultOf(t.step.result);
    if (!t.fault.empty()) t.starts_clean = MeetsNothing(t.step.before);
    return t;
  }
  if (Observe(context) != seen) t.fault = "refused, but something has changed";
  if (t.step.status == TPA_E_TANGLED) {
    t.starts_clean = MeetsNothing(t.step.before);
    if (t.starts_clean) t.fault = "refused as tangled, but nothing meets";
  }
  return t;
}

}  // namespace

OffsetTrial JudgeOffset(const Mesh& before, const Mesh& moved, const tpa_config& config) {
  const Arena arena(config, before);
  return JudgeStep(*arena, moved);
}

namespace {

constexpr int steps_in_a_row = 5;

}  // namespace

const std::vector<OffsetFamily>& OffsetFamilies() {
  static const std::vector<OffsetFamily> families = [] {
    std::vector<OffsetFamily> all;
    for (const int power : {0, 3, 6, 9, 12, any_power}) {
      const double offset = power > 0 ? std::pow(10.0, power) : power;
      const std::string end = power == any_power ? "-at-any" : power > 0 ? "-at-1e" + std::to_string(power) : "-at-0";
      all.push_back({"pair" + end, offset, false, Pair, PairMoved});
      all.push_back({"crumple" + end, offset, false, Ball, Crumpled, 1, 120});
      all.push_back({"torus" + end, offset, false, CoarseTorus, OneMoved});
      all.push_back({"boxes" + end, offset, false, LatticeBoxes, BoxesMoved});
      all.push_back({"adapt" + end, offset, true, TangledBodies, nullptr});
      all.push_back({"pair-on" + end, offset, false, Pair, PairMoved, steps_in_a_row});
      all.push_back({"shaken-on" + end, offset, false, Ball, ShakenALittle, steps_in_a_row, 60});
    }
    return all;
  }();
  return families;
}

OffsetTrial PlayOffset(const OffsetFamily& family, uint64_t seed) {
  Random random(MixedSeed(family.name, seed));
  const Mesh body = family.body(random);
  if (family.adapts) return JudgeAdapt(Translated(body, RandomOffset(family.offset, random)));
  Mesh moved = family.moved(body, random);
  const Point by = RandomOffset(family.offset, random);
  const Arena arena(GenerousConfig(body), Translated(body, by));
  OffsetTrial t = JudgeStep(*arena, Translated(moved, by));
  for (int i = 1; i < family.steps && t.fault.empty() && t.step.status == TPA_OK; ++i) {
    if (t.step.result.triangles.empty()) break;
    moved = family.moved(Translated(t.step.result, Scaled(-1, by)), random);
    t = JudgeStep(*arena, Translated(moved, by));
  }
  return t;
}

}  // namespace support
