// SPDX-License-Identifier: MIT
// Events of components against an oracle that labels the meshes before and after, and relates labels by the maps. Many
// steps in a row, since a step inherits knowledge of components from the step before.
#include <cmath>
#include <map>

#include "oracle/commit_oracle.h"
#include "support/share.h"
#include "support/support.h"

namespace component_changes_test {
namespace {

using namespace support;

std::vector<ComponentEvent> ReportedBy(const tpa_context* context) {
  const std::vector<tpa_event> events = EventsOf(context);
  return ComponentEventsAmong(events.data(), static_cast<uint32_t>(events.size()));
}

// Pushes the vertices near a place, far enough to pass through other bodies.
Mesh Pushed(const Mesh& m, Random& random) {
  const Point place = PositionOf(m, random() % VertexCount(m)), way = RandomPoint(random, -1.2, 1.2);
  const double reach = Uniform(random, .2, .6);
  return Mapped(m, [&](Point p) {
    const double square = std::pow(p[0] - place[0], 2) + std::pow(p[1] - place[1], 2) + std::pow(p[2] - place[2], 2);
    const double far = square / (reach * reach);
    for (size_t k = 0; far < 1 && k < 3; ++k) p[k] += (1 - far) * way[k];
    return p;
  });
}

// Presses a waist flat, and through the axis.
Mesh Pinched(const Mesh& m, Random& random) {
  const Point place = PositionOf(m, random() % VertexCount(m));
  const size_t axis = random() % 3;
  const double width = Uniform(random, .1, .3);
  return Mapped(m, [&](Point p) {
    const double far = std::fabs(p[axis] - place[axis]) / width;
    for (size_t k = 0; far < 1 && k < 3; ++k)
      if (k != axis && std::fabs(p[k] - place[k]) < 1) p[k] = place[k] + (far - .3 * (1 - far)) * (p[k] - place[k]);
    return p;
  });
}

Mesh Shaken(const Mesh& m, Random& random) {
  const double size = Uniform(random, .01, .1);
  return Mapped(m, [&](Point p) {
    for (double& x : p) x += Uniform(random, -size, size);
    return p;
  });
}

void ExpectEventsOfLabels(uint64_t first, uint64_t last, int least) {
  std::map<int32_t, int> seen;
  for (uint64_t seed = first; seed <= last; ++seed) {
    Random random(seed);
    const Mesh scene =
        Renumbered(Together({Torus({0, 0, 0}, 1, .3, 40, 14), Sphere({2.2, 0, 0}, .7, 7), Sphere({-2, .5, 0}, .5, 5),
                             Tube({{0, -2, -1}, {0, -2, -.5}, {0, -2, 0}, {0, -2, .5}, {0, -2, 1}},
                                  {.4, .35, .25, .35, .4}, 9, {0, 1, 0}),
                             Sphere({0, 2.5, 0}, .4, 4), Sphere({0, 2.5, 0}, .8, 8)}),
                   random);
    tpa_config config = DefaultConfig(12 * VertexCount(scene));
    config.max_contacts = 1 << 13;
    config.max_cut_edges = 1 << 14;
    Arena arena(config, scene);
    for (int step = 0; step < 12; ++step) {
      const Mesh before = MeshOf(*arena);
      if (before.positions.empty()) break;
      const uint64_t kind = random() % 5;
      const Mesh target = kind < 2   ? Pushed(before, random)
                          : kind < 4 ? Pinched(before, random)
                                     : Shaken(before, random);
      ASSERT_EQ(MoveAll(*arena, target.positions), TPA_OK);
      tpa_issue issue;
      const tpa_status status = tpa_step(*arena, nullptr, nullptr, &issue);
      if (status == TPA_E_LIMIT) break;  // crumpled beyond the room given here
      ASSERT_EQ(status, TPA_OK) << Text(issue);
      const std::vector<ComponentEvent> expected =
          ExpectedComponentEvents(before, MeshOf(*arena), VertexOriginsOf(*arena).data());
      ASSERT_EQ(ReportedBy(*arena), expected) << "seed " << seed << " step " << step;
      for (const ComponentEvent& c : expected) ++seen[c.type];
    }
  }
  for (int32_t type : {TPA_EVENT_MERGE, TPA_EVENT_SPLIT, TPA_EVENT_GENUS_UP, TPA_EVENT_GENUS_DOWN, TPA_EVENT_DEATH}) {
    EXPECT_GE(seen[type], least) << "type " << type;
    testing::Test::RecordProperty("events-" + std::to_string(type), seen[type]);
  }
}

TEST(Parts, EventsAreWhatLabelsFromNothingTell) { ExpectEventsOfLabels(1, Share(9u), Least(1)); }
TEST(PartsLong, EventsAreWhatLabelsFromNothingTell) { ExpectEventsOfLabels(1, 30, 1); }

TEST(Parts, EventsOfTangledMeshesToo) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    std::vector<Mesh> balls;
    for (int i = 0; i < 8; ++i) {
      const Point center = RandomPoint(random, -1, 1);
      const double radius = Uniform(random, .3, .7);
      balls.push_back(Sphere(center, radius, 3 + static_cast<int>(random() % 5)));
    }
    Mesh before = Renumbered(Together(balls), random);
    Arena arena(DefaultConfig(4 * VertexCount(before)), before);
    for (int round = 0; round < 2; ++round) {
      ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK);
      EXPECT_EQ(ReportedBy(*arena), ExpectedComponentEvents(before, MeshOf(*arena), VertexOriginsOf(*arena).data()))
          << "seed " << seed;
      before = MeshOf(*arena);
    }
  }
}

// The part of a ball within `reach` of a place on it moves along x, the place itself by `by`.
Mesh Bulged(const Mesh& m, const Point& place, double by) {
  constexpr double reach = .5;
  return Mapped(m, [&](Point p) {
    p[0] += by * std::max(0., 1 - Distance(p, place) / reach);
    return p;
  });
}

void MoveOthers(const Arena& arena, const Mesh& before, const Mesh& after) {
  std::vector<uint32_t> vertices;
  std::vector<double> targets;
  for (uint32_t v = 0; v < VertexCount(before); ++v) {
    const Point to = PositionOf(after, v);
    if (to == PositionOf(before, v)) continue;
    vertices.push_back(v);
    targets.insert(targets.end(), to.begin(), to.end());
  }
  EXPECT_EQ(MoveSome(*arena, vertices, targets), TPA_OK);
}

// Balls in a row unite from the far end on, so names of the last ones change time and again without a look at them. The
// last body of all gives its vertices to the holes.
TEST(Parts, LabelsFollowMergesFarAway) {
  constexpr int balls = 5;
  std::vector<Mesh> row;
  for (int i = 0; i < balls; ++i) row.push_back(Sphere({3. * i, 0, 0}, 1, 8));
  row.push_back(Sphere({0, 9, 0}, 1, 8));
  const Arena arena(DefaultConfig(10000), Together(row));
  for (int i = balls - 1; i > 0; --i) {
    const Mesh before = MeshOf(*arena);
    MoveOthers(arena, before, Bulged(Bulged(before, {3. * i - 1, 0, 0}, -.8), {3. * i - 2, 0, 0}, .8));
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    std::vector<uint32_t> labels(VertexCount(after));
    uint32_t count = 0;
    ASSERT_EQ(tpa_components(*arena, nullptr, 0, labels.data(), &count, nullptr), TPA_OK);
    ASSERT_EQ(count, static_cast<uint32_t>(i + 1));
    std::map<uint32_t, uint32_t> place;  // of each component by its smallest vertex
    const Labels expected = LabelsOf(after);
    for (const uint32_t id : expected.of) place.emplace(id, 0);
    uint32_t next = 0;
    for (auto& entry : place) entry.second = next++;
    for (uint32_t v = 0; v < VertexCount(after); ++v) ASSERT_EQ(labels[v], place[expected.of[v]]) << "ball " << i;
  }
}

}  // namespace
}  // namespace component_changes_test
