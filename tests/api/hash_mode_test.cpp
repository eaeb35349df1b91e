// SPDX-License-Identifier: MIT
// tpa_step and tpa_adapt in mode TPA_DETECT_VERTEX_HASH. The hash finds the contacts of the passes, and misses some;
// the results are free of contacts all the same (P1), and of the topology and volume that complete detection leads to.
#include <algorithm>
#include <cmath>

#include "support/field_meshes.h"
#include "support/field_shapes.h"
#include "support/resolve_trial.h"
#include "support/share.h"
#include "support/step_scenes.h"
#include "support/support.h"

namespace hash_mode_test {
namespace {

using namespace support;

tpa_config Hashed(tpa_config config, double cell) {
  config.detect_mode = TPA_DETECT_VERTEX_HASH;
  config.cell_size = cell;
  return config;
}

// Pairs in contact that the hash finds.
size_t HashedPairs(const Mesh& m, double cell) {
  Arena arena(Hashed(GenerousConfig(m), cell), m);
  auto contacts = Sized<tpa_contacts>();
  tpa_issue issue;
  EXPECT_EQ(tpa_detect(*arena, nullptr, &contacts, &issue), TPA_OK) << Text(issue);
  return contacts.count;
}

struct Ended {
  Mesh mesh;
  Topology topology;
  tpa_report report;
};

// tpa_step to the targets, or tpa_adapt without targets.
Ended Resolve(const tpa_config& config, const Mesh& mesh, const std::vector<double>& targets, const std::string& name) {
  Arena arena(config, mesh);
  Ended out;
  out.report = Sized<tpa_report>();
  if (!targets.empty()) {
    EXPECT_EQ(MoveAll(*arena, targets), TPA_OK);
  }
  tpa_issue issue;
  const tpa_status status = targets.empty() ? tpa_adapt(*arena, nullptr, &out.report, &issue)
                                            : tpa_step(*arena, nullptr, &out.report, &issue);
  EXPECT_EQ(status, TPA_OK) << name << ": " << Text(issue);
  out.mesh = MeshOf(*arena);
  out.topology = TopologyOf(out.mesh);
  EXPECT_TRUE(IsSound(out.mesh, name)) << name;
  return out;
}

// ---------------------------------------------------------------- steps

TEST(HashMode, ScenesEndAsTheyShould) {
  for (const Scene& s : AllScenes()) {
    const tpa_config config = Hashed(ConfigFor(s.mesh), MeanEdgeOf(s.mesh));
    const Played played = PlayToTheEnd(s, s.name, &config);
    EXPECT_EQ(played.topology.Genera(), s.genera) << Written(played.mesh, s.name);
  }
}

TEST(HashMode, StepsOfFineMeshesEndAsInCompleteMode) {
  for (int fineness : {8, 12, 16})
    for (double overlap : {.05, .2}) {
      const Scene s = TwoSpheres(overlap, fineness);
      const std::string name = "spheres-" + std::to_string(fineness);
      const std::vector<double> targets = TargetsOf(s.mesh, s.target);
      const Ended complete = Resolve(GenerousConfig(s.mesh), s.mesh, targets, name);
      const double edge = MeanEdgeOf(s.mesh);
      EXPECT_GT(HashedPairs({targets, s.mesh.triangles}, 2 * edge), 0u);
      for (double cells : {.5, 1., 2., 8.}) {
        const Ended hashed = Resolve(Hashed(GenerousConfig(s.mesh), cells * edge), s.mesh, targets, name);
        EXPECT_EQ(hashed.topology.Genera(), complete.topology.Genera()) << name << ", cells of " << cells << " edges";
        EXPECT_NEAR(hashed.topology.Volume(), complete.topology.Volume(), .02 * complete.topology.Volume());
      }
    }
}

// A needle through the middle of a face of a box: no vertex lies near another, so the hash finds nothing.
TEST(HashMode, ContactsThatTheHashMissesAreFoundBeforeTheCommit) {
  const Mesh box = Box({0, 0, 0}, {16, 16, 16}, 1), needle = Box({9.5, 5.5, 20}, {9.75, 5.75, 30}, 1);
  const Mesh apart = Together({box, needle});
  Mesh pierced = Together({box, Translated(needle, {0, 0, -9})});
  EXPECT_EQ(HashedPairs(pierced, 1), 0u);
  ASSERT_FALSE(AllMeetingPairs(pierced).empty());
  const tpa_config complete = GenerousConfig(apart), hashed = Hashed(complete, 1);
  const Ended stepped = Resolve(hashed, apart, pierced.positions, "needle-step");
  EXPECT_EQ(stepped.topology.Genera(), (std::vector<int64_t>{0}));
  EXPECT_EQ(stepped.report.contacts, AllMeetingPairs(pierced).size());
  EXPECT_EQ(stepped.mesh.positions, Resolve(complete, apart, pierced.positions, "needle-step").mesh.positions);
  const Ended adapted = Resolve(hashed, pierced, {}, "needle-adapt");
  EXPECT_EQ(adapted.topology.Genera(), (std::vector<int64_t>{0}));
  EXPECT_NEAR(adapted.topology.Volume(), 16. * 16 * 16 + .25 * .25 * 5, 1e-6);
  EXPECT_EQ(adapted.mesh.positions, Resolve(complete, pierced, {}, "needle-adapt").mesh.positions);
}

TEST(HashMode, WhateverIsAskedForTheMeshStaysSound) {
  uint32_t contacts = 0;
  for (uint64_t seed = 1; seed <= Share(30u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({2.5, 0, 0}, 0.9, 0.35, 12, 6)});
    const tpa_config config = Hashed(GenerousConfig(m), MeanEdgeOf(m) * std::pow(2, Uniform(random, -2, 2)));
    Arena arena(config, m);
    const std::string name = "jumps-seed-" + std::to_string(seed);
    for (int step = 0; step < 3; ++step) {
      const Mesh before = MeshOf(*arena);
      const double most = Uniform(random, 0.02, 0.25);
      std::vector<double> targets = ShakenTargets(before, most, random);
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      tpa_issue issue;
      auto report = Sized<tpa_report>();
      ASSERT_EQ(tpa_step(*arena, nullptr, &report, &issue), TPA_OK) << Text(issue);
      contacts += report.contacts;
      EXPECT_TRUE(IsSound(MeshOf(*arena), name)) << "step " << step;
    }
  }
  EXPECT_GT(contacts, Least(1000u));
}

// A long bar comes through a box in one step: fine where it enters, coarse where it leaves. The hash finds the first
// seam only. The vertices that go must not be the bar within the box, and all beyond.
TEST(HashMode, AStepTakesNothingBeyondAMissedSeam) {
  std::vector<Point> points;
  for (double z : {-60., -40., -20., -8., -4., -2., -1., -.5, .01, .5, 1., 9.}) points.push_back({3.45, 3.55, z});
  const Mesh bar = Tube(points, std::vector<double>(points.size(), .3), 8, {1, 0, 0}),
             box = Box({0, 0, 0}, {8, 8, 8}, 8);
  const Mesh apart = Together({box, Translated(bar, {0, 0, -12})}), through = Together({box, bar});
  const size_t found = HashedPairs(through, 1);
  ASSERT_GT(found, 0u);
  ASSERT_LT(found, AllMeetingPairs(through).size());
  const tpa_config config = GenerousConfig(apart);
  const Ended complete = Resolve(config, apart, through.positions, "bar"),
              hashed = Resolve(Hashed(config, 1), apart, through.positions, "bar");
  EXPECT_EQ(hashed.topology.Genera(), complete.topology.Genera());
  EXPECT_NEAR(hashed.topology.Volume(), complete.topology.Volume(), 1e-9);
}

// A few vertices move at a time: the near faces of one step serve the next.
TEST(HashMode, FewMovesKeepTheNearFaces) {
  const Mesh ball = Sphere({0, 0, 0}, 1, 12), m = Together({ball, Translated(ball, {2.2, 0, 0})});
  Arena arena(Hashed(GenerousConfig(m), MeanEdgeOf(m)), m);
  auto report = Sized<tpa_report>();
  uint32_t handles = 0, steps = 0;
  for (; handles == 0 && steps < 20; ++steps) {
    const Mesh now = MeshOf(*arena);
    std::vector<uint32_t> vertices;
    std::vector<double> targets;
    for (uint32_t v = 0; v < VertexCount(ball); ++v) {
      const Point p = PositionOf(now, v);
      if (p[0] < .95) continue;  // not at the pole of the first ball
      vertices.push_back(v);
      targets.insert(targets.end(), {p[0] + .02, p[1], p[2]});
    }
    ASSERT_LT(16 * vertices.size(), VertexCount(now));
    ASSERT_EQ(MoveSome(*arena, vertices, targets), TPA_OK);
    tpa_issue issue;
    ASSERT_EQ(tpa_step(*arena, nullptr, &report, &issue), TPA_OK) << Text(issue);
    EXPECT_TRUE(IsSound(MeshOf(*arena), "pole"));
    auto contacts = Sized<tpa_contacts>();
    ASSERT_EQ(tpa_detect(*arena, nullptr, &contacts, &issue), TPA_OK);
    EXPECT_EQ(contacts.count, 0u);
    handles += report.handles[0];
  }
  EXPECT_EQ(handles, 1u) << "after " << steps << " steps";
  EXPECT_EQ(TopologyOf(MeshOf(*arena)).Genera(), (std::vector<int64_t>{0}));
}

// ---------------------------------------------------------------- tpa_adapt

TEST(HashMode, TanglesAreCutAsInCompleteMode) {
  size_t missed = 0, partly = 0;
  for (const char* family : {"boxes-grid", "boxes-near", "plates-stacked", "star-coarse", "outline-coarse",
                             "frame-coarse", "spring-coarse", "thread-coarse", "copies-turned", "noise-sphere-66"})
    for (uint64_t seed = 1; seed <= Share(3u); ++seed) {
      const Mesh m = MakeFieldMesh(FieldFamilyOf(family), seed);
      const double edge = MeanEdgeOf(m);
      const Ended complete = Resolve(GenerousConfig(m), m, {}, family);
      const double cells = seed == 1 ? .25 : seed == 2 ? 1 : 4;
      const std::string name = family + std::string("-") + std::to_string(seed);
      const size_t found = HashedPairs(m, cells * edge);
      (found == 0 ? missed : partly) += found < complete.report.contacts ? 1u : 0u;
      const Ended hashed = Resolve(Hashed(GenerousConfig(m), cells * edge), m, {}, name);
      EXPECT_EQ(hashed.report.unresolved, complete.report.unresolved) << name;
      EXPECT_EQ(hashed.topology.Genera(), complete.topology.Genera()) << Written(hashed.mesh, name);
      EXPECT_NEAR(hashed.topology.Volume(), complete.topology.Volume(), 1e-6 * std::fabs(complete.topology.Volume()))
          << name;
    }
  EXPECT_GT(partly, Least(8u));
  EXPECT_GT(missed, 0u);
}

}  // namespace
}  // namespace hash_mode_test
