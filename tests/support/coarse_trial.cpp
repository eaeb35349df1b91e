// SPDX-License-Identifier: MIT
#include "support/coarse_trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "oracle/commit_oracle.h"
#include "oracle/region_columns.h"
#include "support/mesh_building.h"
#include "support/mixed_seed.h"
#include "support/resolve_trial.h"
#include "support/tangle_shapes.h"
#include "tool/scenes/elementary.h"

namespace support {

namespace {

// ---------------------------------------------------------------- bodies of 8 to 130 vertices

Mesh CoarseBox(Random& random) {
  const std::array<int, 3> counts = {WholeIn(random, 1, 4), WholeIn(random, 1, 4), WholeIn(random, 1, 4)};
  const Point half = RandomPoint(random, 0.4, 1.2);
  const Mesh box = Block(Scaled(-1, half), half, counts);
  return Coin(random) ? RandomlyTurned(box, random) : box;
}

Mesh CoarseSphere(Random& random) { return RandomlyTurned(Sphere({}, 1, WholeIn(random, 2, 5)), random); }

Mesh Bipyramid(Random& random) {
  const auto n = static_cast<uint32_t>(WholeIn(random, 6, 24));
  const double height = Uniform(random, 0.3, 2);
  Mesh m;
  for (uint32_t v = 0; v < n; ++v) AddVertex(m, {tool::cosine(2 * pi * v / n), tool::sine(2 * pi * v / n), 0});
  AddVertex(m, {0, 0, height});
  AddVertex(m, {0, 0, -height});
  for (uint32_t v = 0; v < n; ++v) {
    AddTriangle(m, v, (v + 1) % n, n);
    AddTriangle(m, (v + 1) % n, v, n + 1);
  }
  return RandomlyTurned(m, random);
}

Mesh CoarseTorus(Random& random) {
  const int around = WholeIn(random, 4, 13), across = WholeIn(random, 3, 10);
  return RandomlyTurned(Torus({}, 1, Uniform(random, 0.25, 0.6), around, across), random);
}

Mesh AnyBody(Random& random) {
  constexpr Mesh (*bodies[])(Random&) = {CoarseBox, CoarseSphere, Bipyramid, CoarseTorus};
  return bodies[WholeIn(random, 0, 3)](random);
}

double End(const Mesh& m, size_t axis, bool high) {
  double end = m.positions[axis];
  for (size_t v = 0; v < VertexCount(m); ++v)
    end = high ? std::max(end, m.positions[3 * v + axis]) : std::min(end, m.positions[3 * v + axis]);
  return end;
}

// Two bodies side by side, and a larger one apart from both.
Mesh SideBySide(Random& random) {
  const Mesh first = AnyBody(random), second = AnyBody(random);
  const double gap = Uniform(random, 0.01, 0.2), side = Uniform(random, -0.4, 0.4);
  const Mesh pair = Together({first, Translated(second, {End(first, 0, true) - End(second, 0, false) + gap, side, 0})});
  return Together({pair, Sphere({0, 0, 60}, 20, 2)});
}

// ---------------------------------------------------------------- moves

// Vertices that may move: all but those of the body apart.
uint32_t MovableOf(const Mesh& m) {
  uint32_t count = 0;
  while (count < VertexCount(m) && m.positions[3 * size_t{count} + 2] < 30) ++count;
  return count;
}

std::vector<uint32_t> SomeOf(uint32_t count, uint32_t wanted, Random& random) {
  std::vector<uint32_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0u);
  if (wanted == 0 || wanted >= count) return ids;
  for (uint32_t i = 0; i < wanted; ++i) std::swap(ids[i], ids[i + random() % (count - i)]);
  ids.resize(wanted);
  return ids;
}

double MeanEdgeAt(const Mesh& m, const std::vector<uint32_t>& vertices) {
  const std::set<uint32_t> at(vertices.begin(), vertices.end());
  double sum = 0, count = 0;
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const uint32_t a = m.triangles[h], b = m.triangles[h % 3 == 2 ? h - 2 : h + 1];
    if (at.count(a) == 0 && at.count(b) == 0) continue;
    sum += Distance(PositionOf(m, a), PositionOf(m, b));
    ++count;
  }
  return sum / count;
}

Mesh Moved(const Mesh& before, const std::vector<uint32_t>& moving, Random& random) {
  Mesh moved = before;
  const double way = Uniform(random, 0.3, 3) * MeanEdgeAt(before, moving);
  for (const uint32_t v : moving) {
    const Point d = RandomDirection(random);
    for (size_t i = 0; i < 3; ++i) moved.positions[3 * size_t{v} + i] += way * d[i];
  }
  return moved;
}

Step StepOf(const Mesh& before, const Mesh& moved, const std::vector<uint32_t>& moving, const tpa_config& config) {
  const Arena arena(config, before);
  std::vector<double> targets;
  for (const uint32_t v : moving)
    targets.insert(targets.end(), &moved.positions[3 * size_t{v}], &moved.positions[3 * size_t{v}] + 3);
  EXPECT_EQ(MoveSome(*arena, moving, targets), TPA_OK);
  return TakeStepTo(*arena, moved.positions);
}

uint32_t* LimitOf(tpa_config& config, int32_t limit) {
  switch (limit) {
    case TPA_LIMIT_VERTICES: return &config.max_vertices;
    case TPA_LIMIT_TRIANGLES: return &config.max_triangles;
    case TPA_LIMIT_CONTACTS: return &config.max_contacts;
    case TPA_LIMIT_CUT: return &config.max_cut_edges;
    case TPA_LIMIT_EVENTS: return &config.max_events;
    case TPA_LIMIT_COMPONENTS: return &config.max_components;
    case TPA_LIMIT_PIECES: return &config.max_pieces;
    default: return nullptr;
  }
}

constexpr int most_raises = 16;  // limits named at most twice each

// With limits raised to those that the call names.
Step StepWithRoom(const Mesh& before, const Mesh& moved, const std::vector<uint32_t>& moving) {
  tpa_config config = GenerousConfig(before);
  Step s = StepOf(before, moved, moving, config);
  for (int i = 0; i < most_raises && s.status == TPA_E_LIMIT; ++i) {
    *LimitOf(config, s.issue.limit) = static_cast<uint32_t>(s.issue.needed);
    s = StepOf(before, moved, moving, config);
  }
  return s;
}

// ---------------------------------------------------------------- the bound

// Contacts of the moved mesh, and what they allow.
struct Contacts {
  bool any = false;
  double volume = 0;  // of the components that meet, before the step
  double layer = 0;   // c h times the area of the faces in contact
};

double AreaOf(const Mesh& m, uint32_t f) {
  const Point a = PositionOf(m, m.triangles[3 * f]), b = PositionOf(m, m.triangles[3 * f + 1]),
              c = PositionOf(m, m.triangles[3 * f + 2]);
  return 0.5 * Length(Cross(Difference(b, a), Difference(c, a)));
}

double PerimeterOf(const Mesh& m, uint32_t f) {
  double sum = 0;
  for (uint32_t i = 0; i < 3; ++i)
    sum += Distance(PositionOf(m, m.triangles[3 * f + i]), PositionOf(m, m.triangles[3 * f + (i + 1) % 3]));
  return sum;
}

Contacts ContactsOf(const Mesh& before, const Mesh& moved) {
  Contacts c;
  std::set<uint32_t> faces;
  for (const auto& [f, g] : AllMeetingPairs(moved)) faces.insert({f, g});
  const Labels labels = LabelsOf(before);
  std::set<uint32_t> meeting;
  for (const uint32_t f : faces) meeting.insert(labels.of[moved.triangles[3 * size_t{f}]]);
  for (const Component& part : TopologyOf(before).components)
    if (faces.empty() || meeting.count(part.smallest_vertex) > 0) c.volume += part.volume;
  if (faces.empty()) return c;
  c.any = true;
  double area = 0, edges = 0;
  for (const uint32_t f : faces) area += AreaOf(moved, f), edges += PerimeterOf(moved, f);
  c.layer = coarse_closing * edges / (3 * static_cast<double>(faces.size())) * area;
  return c;
}

// Of columns: stretches where a seam was rounded.
constexpr double rounding = 1e-9;

void Judge(uint64_t seed, CoarseTrial& trial) {
  const auto measure = [&](int columns) {
    const RegionDifference d = CompareChanges(trial.step.moved, trial.step.result, columns, seed);
    trial.changed = d.lost + d.gained;
    trial.error = 3 * d.error + rounding * trial.volume;
    if (!d.is_plain) trial.fault = "winding numbers beyond 0 and 1";
  };
  measure(1000);
  const bool is_same = trial.changed <= rounding * trial.volume;
  if (!is_same && trial.changed + trial.error >= std::min(trial.allowed, trial.told)) measure(10000);
}

}  // namespace

const std::vector<CoarseFamily>& CoarseFamilies() {
  static const std::vector<CoarseFamily> families = {
      {"box-1", CoarseBox, 1},       {"box-3", CoarseBox, 3},       {"box-all", CoarseBox, 0},
      {"sphere-1", CoarseSphere, 1}, {"sphere-3", CoarseSphere, 3}, {"sphere-all", CoarseSphere, 0},
      {"bipyramid-1", Bipyramid, 1}, {"bipyramid-3", Bipyramid, 3}, {"bipyramid-all", Bipyramid, 0},
      {"torus-1", CoarseTorus, 1},   {"torus-3", CoarseTorus, 3},   {"torus-all", CoarseTorus, 0},
      {"two-1", SideBySide, 1},      {"two-3", SideBySide, 3},      {"two-all", SideBySide, 0}};
  return families;
}

CoarseTrial PlayCoarse(const CoarseFamily& family, uint64_t seed) {
  Random random(MixedSeed(family.name, seed));
  const Mesh before = family.body(random);
  const std::vector<uint32_t> moving = SomeOf(MovableOf(before), family.moving, random);
  const Mesh moved = Moved(before, moving, random);
  const Contacts contacts = ContactsOf(before, moved);
  CoarseTrial trial;
  trial.step = StepWithRoom(before, moved, moving);
  const Step& s = trial.step;
  trial.meets = contacts.any;
  trial.volume = contacts.volume;
  if (contacts.any) trial.allowed = std::max(coarse_share * contacts.volume, contacts.layer);
  trial.told = s.report.region_lost + s.report.region_gained;
  trial.held_back = s.report.rolled_back_vertices / static_cast<double>(VertexCount(before));
  if (s.status != TPA_OK && (s.result.positions != before.positions || s.result.triangles != before.triangles))
    trial.fault = "refused, but the mesh has changed";
  else if (s.status == TPA_OK)
    trial.fault = FaultOf(s.result);
  if (s.status == TPA_OK && trial.fault.empty()) Judge(seed, trial);
  return trial;
}

}  // namespace support
