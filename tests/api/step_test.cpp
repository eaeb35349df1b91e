// SPDX-License-Identifier: MIT
// Steps: each scene moves until its surface runs into itself, and ends in the expected topology (P1, P3).
#include <algorithm>

#include "support/share.h"
#include "support/step_scenes.h"
#include "support/tangle_shapes.h"

namespace step_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- the scenes, each by itself

TEST(Step, WithoutTargetsNothingChanges) {
  const Mesh m = Torus({0, 0, 0}, 3, 1, 20, 10);
  Arena arena(ConfigFor(m), m);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).positions, m.positions);
  EXPECT_EQ(MeshOf(*arena).triangles, m.triangles);
  EXPECT_TRUE(EventsOf(*arena).empty());
  EXPECT_EQ(report.contacts, 0u);
}

TEST(Step, FreeMovesArriveToTheBit) {
  const Mesh m = Torus({0, 0, 0}, 3, 1, 20, 10);
  Arena arena(ConfigFor(m), m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); ++i) targets[i] = targets[i] * 1.25 + 0.1;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  EXPECT_EQ(MeshOf(*arena).positions, targets);
}

TEST(Step, TwoSpheresBecomeOneByAHandle) {
  const Scene s = TwoSpheres(0.03, 12);
  const Played p = PlayToTheEnd(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_HANDLE, 2));
  EXPECT_TRUE(Has(p.events, TPA_EVENT_MERGE, 2));
  for (const tpa_event& e : p.events) {
    if (e.type == TPA_EVENT_HANDLE) {
      EXPECT_LT(Distance({e.position[0], e.position[1], e.position[2]}, {0, 0.03, 0.01}), 0.3);
    } else if (e.type == TPA_EVENT_MERGE) {
      EXPECT_EQ(e.before, 0u);
      EXPECT_EQ(e.after, p.topology.components[0].smallest_vertex);
    } else {
      EXPECT_EQ(e.type, TPA_EVENT_REMOVAL);  // vertices inside the other ball before the step
    }
  }
  EXPECT_TRUE(std::is_sorted(p.events.begin(), p.events.end(), [](const tpa_event& x, const tpa_event& y) {
    return x.type < TPA_EVENT_MERGE && y.type < TPA_EVENT_MERGE ? false : x.type < y.type;  // regions first
  }));
  EXPECT_EQ(p.rolled_back, 0u);
}

// Cuts are drawn back to the vertices that stay, so a contact takes more out than it puts in.
TEST(Step, AHandleWantsNoMoreVerticesOrTriangles) {
  {
    const Scene s = TwoSpheres(.03, 12);
    tpa_config config = ConfigFor(s.mesh);
    config.max_contacts = config.max_cut_edges = 4096;
    config.max_vertices = VertexCount(s.mesh);
    config.max_triangles = TriangleCount(s.mesh);
    Arena arena(config, s.mesh);
    ASSERT_EQ(MoveAll(*arena, TargetsOf(s.mesh, s.target)), TPA_OK);
    tpa_issue issue;
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
    const Mesh result = MeshOf(*arena);
    EXPECT_TRUE(IsSound(result, std::string("full-") + s.name));
    EXPECT_EQ(TopologyOf(result).Genera(), s.genera);
    EXPECT_TRUE(Has(EventsOf(*arena), TPA_EVENT_HANDLE, 2));
    EXPECT_LT(VertexCount(result), VertexCount(s.mesh));
    for (const tpa_vertex_origin& origin : VertexOriginsOf(*arena)) EXPECT_EQ(origin.parents[1], TPA_NONE);
  }
}

// Several events at once, each with loops of its own.
TEST(Step, WhatARowOfBallsEnclosesDoesNotDependOnNumbering) {
  std::vector<Mesh> balls;
  for (int i = 0; i < 4; ++i) balls.push_back(Sphere({2.15 * i, .03 * i, .02 * i}, 1, 24));
  const Mesh apart = Together(balls);
  double volume = 0;
  for (uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed);
    const Mesh m = Renumbered(apart, random);
    std::vector<double> targets = m.positions;
    for (size_t i = 0; i < targets.size(); i += 3) targets[i] -= .35 * std::round(targets[i] / 2.15);
    Arena arena(ConfigFor(m), m);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Topology result = TopologyOf(MeshOf(*arena));
    EXPECT_EQ(result.Genera(), std::vector<int64_t>{0});
    if (seed == 0) volume = result.Volume();
    EXPECT_NEAR(result.Volume(), volume, 1e-9 * volume) << "seed " << seed;
  }
}

// A bar is pushed half way into a cube, along each axis, both ways. Sides of bar and cube are parallel to the axes, and
// so to the rays of the inside test.
TEST(Step, ABarThatIsParallelToTheAxesGrowsTogetherWithTheCube) {
  const Mesh cube = Box({0, 0, 0}, {1, 1, 1}, 5), bar = Box({1.06, .31, .27}, {2.5, .64, .71}, 4);
  const double exact = 1 + .33 * .44 * (2.5 - 1.06 - .53 + .06);
  for (size_t i = 0; i < 24; i += Stride()) {
    const int rotation = static_cast<int>(i);
    const Mesh m = QuarterTurned(Together({cube, bar}), rotation);
    const Mesh moved = QuarterTurned(Together({cube, Translated(bar, {-.53, 0, 0})}), rotation);
    tpa_config config = ConfigFor(m);
    Arena stepped(config, m);
    ASSERT_EQ(MoveAll(*stepped, moved.positions), TPA_OK);
    ASSERT_EQ(tpa_step(*stepped, nullptr, nullptr, nullptr), TPA_OK);
    Arena adapted(config, moved);
    ASSERT_EQ(tpa_adapt(*adapted, nullptr, nullptr, nullptr), TPA_OK);
    for (const Arena* arena : {&stepped, &adapted}) {
      const Mesh result = MeshOf(**arena);
      const std::string name = "bar-" + std::to_string(rotation) + (arena == &stepped ? "-step" : "-adapt");
      EXPECT_TRUE(IsSound(result, name));
      EXPECT_EQ(TopologyOf(result).Genera(), std::vector<int64_t>{0}) << Written(result, name);
      // A step rounds the seam off; adapt cuts there exactly.
      const double off = arena == &stepped ? .02 : 1e-9;
      EXPECT_NEAR(TopologyOf(result).Volume(), exact, off * exact) << Written(result, name);
      EXPECT_TRUE(Has(EventsOf(**arena), TPA_EVENT_MERGE, 2)) << name;
    }
  }
}

TEST(Step, DeepOverlapLosesTheSwallowedCaps) {
  const Scene s = TwoSpheres(0.6);
  const Played p = PlayToTheEnd(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_GT(Amount(p.events, TPA_EVENT_REMOVAL), 0u);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_MERGE, 2));
  // The union of two balls of radius 1 with centres 0.8 apart, meshed with chords.
  EXPECT_NEAR(p.topology.Volume(), 6.53, 0.6);
}

// A double cone or a disc, with one vertex on either side shared by all its triangles, or most of them.
Mesh Hubbed(bool disc, int n, double x, double turn) {
  Mesh m;
  const auto add = [&](double px, double py, double pz) { m.positions.insert(m.positions.end(), {px, py, pz}); };
  const double height = .3;
  for (int rim = 0; rim < (disc ? 2 : 1); ++rim)
    for (int i = 0; i < n; ++i) {
      const double angle = turn + 2 * M_PI * i / n;
      add(x + std::cos(angle), std::sin(angle), disc ? (2 * rim - 1) * height : 0);
    }
  const auto hub = static_cast<uint32_t>(m.positions.size() / 3), upper = hub - static_cast<uint32_t>(n);
  add(x, 0, -height);
  add(x, 0, height);
  for (uint32_t i = 0; i < static_cast<uint32_t>(n); ++i) {
    const uint32_t j = (i + 1) % static_cast<uint32_t>(n);
    m.triangles.insert(m.triangles.end(), {j, i, hub, upper + i, upper + j, hub + 1});
    if (disc) m.triangles.insert(m.triangles.end(), {i, j, upper + j, i, upper + j, upper + i});
  }
  return m;
}

// The hubs have a triangle in contact, and everything round them would go. The rest shrinks when few vertices, all
// round the contact, are smoothed; so for double cones with fewer than twelve sides.
TEST(Step, ALightTouchTakesLittle) {
  for (bool disc : {false, true})
    for (int n : {6, 8, 10, 12, 14, 16, 20, 24, 32, 48, 64})
      for (double depth : {.01, .02, .05})
        for (uint32_t rounds : {0u, 4u}) {
          const Mesh fixed = Hubbed(disc, n, 0, 0), before = Hubbed(disc, n, 2.2, .1 / n);
          const Mesh m = Together({fixed, before}), after = Together({fixed, Hubbed(disc, n, 2 - depth, .1 / n)});
          tpa_config config = ConfigFor(m);
          config.max_vertices = 5000;
          config.smooth_iterations = rounds;
          Arena arena(config, m);
          ASSERT_EQ(MoveAll(*arena, after.positions), TPA_OK);
          auto report = Sized<tpa_report>();
          ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
          const Mesh result = MeshOf(*arena);
          const std::string name = std::string(disc ? "disc " : "cone ") + std::to_string(n) + ", " +
                                   std::to_string(depth) + ", " + std::to_string(rounds) + " rounds";
          EXPECT_GT(report.contacts, 0u) << name;
          EXPECT_EQ(TopologyOf(result).Genera(), std::vector<int64_t>{0}) << name;
          const double share = disc ? .6 : rounds == 0 ? .6 : n < 12 ? .3 : .5;
          EXPECT_GT(TopologyOf(result).Volume(), share * TopologyOf(m).Volume()) << Written(result, name);
        }
}

// An upright star, or a round star, whose ends are fans about a vertex in the middle, or on the rim.
Mesh FannedStar(int tips, double inner, double height, bool round) {
  Mesh m;
  const auto n = static_cast<uint32_t>(2 * tips);
  for (int end = -1; end <= 1; end += 2)
    for (uint32_t i = 0; i < n; ++i) {
      const double angle = M_PI * i / tips, r = round || i % 2 == 0 ? 1 : inner;
      m.positions.insert(m.positions.end(), {r * std::cos(angle), r * std::sin(angle), end * height});
    }
  const auto add = [&](uint32_t p, uint32_t q, uint32_t r) { m.triangles.insert(m.triangles.end(), {p, q, r}); };
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    add(i, j, n + j);
    add(i, n + j, n + i);
    if (!round) {
      add(2 * n, j, i);
      add(2 * n + 1, n + i, n + j);
    } else if (i > 0 && j > 0) {
      add(0, j, i);
      add(n, n + i, n + j);
    }
  }
  if (!round) m.positions.insert(m.positions.end(), {0, 0, -height, 0, 0, height});
  return m;
}

// Bodies with hubs, turned at random and sent towards each other until they touch anywhere, by a twentieth at most.
void ExpectHubsApart(uint64_t first, uint64_t last, int least) {
  int touched = 0;
  for (uint64_t seed = first; seed <= last; ++seed) {
    Random random(seed);
    const auto body = [&](double size) {
      const int tips = 3 + static_cast<int>(random() % 20);
      const double inner = Uniform(random, .2, .9), height = Uniform(random, .03, .6);
      const Mesh m = RandomlyTurned(FannedStar(tips, inner, height, random() % 2 == 0), random);
      return Mapped(m, [&](const Point& p) { return Point{size * p[0], size * p[1], size * p[2]}; });
    };
    const Mesh fixed = body(1), moving = body(Uniform(random, .05, 1));
    const Point aside = RandomPoint(random, -.7, .7);
    const auto at = [&](double x) { return Together({fixed, Translated(moving, {x, aside[1], aside[2]})}); };
    double x = 2.5;
    Arena detecting(ConfigFor(at(x)));
    const auto meets = [&] {
      EXPECT_EQ(Load(*detecting, at(x)), TPA_OK);
      auto contacts = Sized<tpa_contacts>();
      return tpa_detect(*detecting, nullptr, &contacts, nullptr) != TPA_OK || contacts.count > 0;
    };
    while (x > 0 && !meets()) x -= .05;
    if (x <= 0) continue;
    ++touched;
    const Mesh before = at(x + .05);
    tpa_config config = ConfigFor(before);
    config.max_vertices = 20000;
    Arena arena(config, before);
    ASSERT_EQ(MoveAll(*arena, at(x).positions), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Mesh result = MeshOf(*arena);
    EXPECT_TRUE(AllMeetingPairs(result).empty()) << Written(result, "hubs-seed-" + std::to_string(seed));
  }
  EXPECT_GT(touched, least);
}

TEST(Step, HubsThatTouchAreApartAfterwards) { ExpectHubsApart(1, Share(75u), Least(37)); }
TEST(StepLong, HubsThatTouchAreApartAfterwards) { ExpectHubsApart(76, 300, 112); }

TEST(Step, APinchedNeckSplits) {
  const Scene s = Dumbbell();
  const Played p = PlayToTheEnd(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_SPLIT, 2));
  EXPECT_GE(Amount(p.events, TPA_EVENT_CAP), 2u);
}

TEST(Step, ABentTubeClosesToARing) {
  const Scene s = ClosingRing();
  const Played p = PlayToTheEnd(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_GENUS_UP, 1));
}

TEST(Step, ThreeMeetAtAPointInOneStep) {
  const Scene s = ThreeSpindles();
  const Played p = PlayToTheEnd(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_HANDLE, 3));
  EXPECT_TRUE(Has(p.events, TPA_EVENT_MERGE, 3));
}

// A handle for the cross would change more of the bodies than the ledger allows, so the cross is cut exactly.
TEST(Step, FourMeetAtAPointInOneStep) {
  const Scene cross = FourInACross(), tetrahedral = FourTetrahedral();
  for (const Scene* scene : {&cross, &tetrahedral}) {
    const Scene& s = *scene;
    const Played p = PlayToTheEnd(s, s.name);
    EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
    EXPECT_EQ(Has(p.events, TPA_EVENT_HANDLE, 4), scene == &tetrahedral) << s.name;
    EXPECT_TRUE(Has(p.events, TPA_EVENT_MERGE, 4)) << s.name;
  }
}

TEST(Step, AComponentCrumpledToNothingDies) {
  const Mesh large = Sphere({0, 0, 0}, 1, 5), small = Sphere({4, 0, 0}, 0.5, 3);
  const Mesh m = Together({large, small});
  int deaths = 0;
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    Random random(seed);
    Arena arena(DefaultConfig(64 * VertexCount(m)), m);
    std::vector<double> targets = m.positions;
    for (size_t i = large.positions.size(); i < targets.size(); i += 3) {
      const Point p = RandomPoint(random, -0.05, 0.05);
      targets[i] = 4;  // flat: the faces bound nothing
      targets[i + 1] = p[1];
      targets[i + 2] = p[2];
    }
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    EXPECT_TRUE(IsSound(after, "death")) << "seed " << seed;
    std::vector<tpa_event> events = EventsOf(*arena);
    std::erase_if(events, [](const tpa_event& e) { return e.type == TPA_EVENT_REMOVAL; });
    for (size_t v = 0; v < VertexCount(large); ++v) EXPECT_EQ(PositionOf(after, v), PositionOf(large, v));
    if (TopologyOf(after).components.size() > 1) continue;  // an embedded crumb lives on
    ++deaths;
    ASSERT_EQ(events.size(), 1u) << "seed " << seed;
    EXPECT_EQ(events[0].type, TPA_EVENT_DEATH);
    EXPECT_EQ(events[0].before, VertexCount(large));
    EXPECT_EQ(events[0].after, TPA_NONE);
  }
  EXPECT_GE(deaths, Least(8));
}

// Afterwards volumes are known.
void MoveByAHair(tpa_context* context, const Mesh& m) {
  std::vector<double> targets = m.positions;
  targets[0] += 1e-4;
  ASSERT_EQ(MoveAll(context, targets), TPA_OK);
  ASSERT_EQ(tpa_step(context, nullptr, nullptr, nullptr), TPA_OK);
}

TEST(Step, ABodyThatIsTurnedInsideOutDiesWhateverIsKnownOfIt) {
  const Mesh large = Sphere({0, 0, 0}, 1, 12), small = Sphere({10, 0, 0}, 0.1, 1);
  const Mesh m = Together({large, small});
  for (const bool measured_before : {false, true}) {
    Arena arena(ConfigFor(m), m);
    std::vector<double> targets = m.positions;
    if (measured_before) MoveByAHair(*arena, m);
    for (size_t i = large.positions.size(); i < targets.size(); ++i) targets[i] = (i % 3 == 0 ? 20 : 0) - targets[i];
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    EXPECT_EQ(VertexCount(MeshOf(*arena)), VertexCount(large)) << measured_before;
    EXPECT_TRUE(Has(EventsOf(*arena), TPA_EVENT_DEATH, 1)) << measured_before;
  }
}

// Only the move touches the body.
TEST(Step, ABodyThatIsTurnedInsideOutDiesWhereOthersGrowTogether) {
  const Scene s = TwoSpheres(0.08);
  const Mesh m = Together({s.mesh, Sphere({10, 0, 0}, 0.1, 1)});
  for (const bool measured_before : {false, true}) {
    Arena arena(ConfigFor(m), m);
    if (measured_before) MoveByAHair(*arena, m);
    std::vector<double> targets = TargetsOf(s.mesh, s.target);
    for (size_t i = targets.size(); i < m.positions.size(); ++i)
      targets.push_back((i % 3 == 0 ? 20 : 0) - m.positions[i]);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    EXPECT_EQ(TopologyOf(after).Genera(), s.genera) << measured_before << Written(after, "turned-and-merged");
    EXPECT_TRUE(Has(EventsOf(*arena), TPA_EVENT_MERGE, 2)) << measured_before;
    EXPECT_TRUE(Has(EventsOf(*arena), TPA_EVENT_DEATH, 1)) << measured_before;
  }
}

TEST(Step, TheLastComponentMayDieToo) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  Random random(7);
  Arena arena(DefaultConfig(64 * VertexCount(m)), m);
  std::vector<double> targets = m.positions;
  for (double& x : targets) x = Uniform(random, -0.05, 0.05);
  for (size_t i = 2; i < targets.size(); i += 3) targets[i] = 0;  // flat: the faces bound nothing
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  tpa_issue issue;
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(VertexCount(MeshOf(*arena)), 0u);
  EXPECT_TRUE(Has(EventsOf(*arena), TPA_EVENT_DEATH, 1));
  // An empty mesh is a mesh.
  auto validation = Sized<tpa_validation>();
  EXPECT_EQ(tpa_validate(*arena, nullptr, &validation, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(validation.components, 0u);
  EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(tpa_adapt(*arena, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
  EXPECT_EQ(Load(*arena, m), TPA_OK);
}

// Hardly anything may be left of a body crumpled round a void, beside the void: then the void goes too. Bodies within
// the void stay.
void ExpectNoVoidWithoutItsBody(uint64_t first, uint64_t last, int least) {
  int gone = 0, islands = 0;
  for (uint64_t seed = first; seed <= last; ++seed) {
    Random random(seed);
    const Mesh body = Sphere({0, 0, 0}, 1, 6), empty = Reversed(Sphere({0, 0, 0}, 0.55, 4)),
               island = Sphere({0, 0, 0}, 0.1, 2);
    const Mesh m = seed % 2 == 0 ? Together({body, empty, island}) : Together({body, empty});
    tpa_config config = DefaultConfig(32 * VertexCount(m));
    config.max_contacts = 1 << 16;
    Arena arena(config, m);
    std::vector<double> targets = m.positions;
    const double size = Uniform(random, 0.2, 0.6);
    for (size_t i = 0; i < body.positions.size(); ++i) targets[i] += Uniform(random, -size, size);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    tpa_issue issue;
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), TPA_OK) << "seed " << seed << ": " << Text(issue);
    const Mesh result = MeshOf(*arena);
    ASSERT_TRUE(IsSound(result, "void-seed-" + std::to_string(seed)));
    const Topology after = TopologyOf(result);
    EXPECT_GE(after.Volume(), 0) << "seed " << seed << ", " << Written(result, "void-seed-" + std::to_string(seed));
    const auto any = [&](auto is) { return std::any_of(after.components.begin(), after.components.end(), is); };
    if (any([](const Component& c) { return c.volume < 0; })) continue;
    ++gone;
    islands += any([&](const Component& c) { return std::fabs(c.volume - TopologyOf(island).Volume()) < 1e-12; });
  }
  EXPECT_GT(gone, least);
  EXPECT_GT(islands, least / 3);
}

TEST(Step, AVoidDoesNotOutliveItsBody) { ExpectNoVoidWithoutItsBody(1, Share(16u), Least(8)); }
TEST(StepLong, AVoidDoesNotOutliveItsBody) { ExpectNoVoidWithoutItsBody(17, 60, 22); }

// Thinner than the triangles in contact, as the voids that a step may make and fill. It moves along, beside the event.
TEST(Step, AThinVoidOfBeforeOutlivesAnEvent) {
  const Mesh thin = Mapped(Sphere({0, 0, 0}, 0.4, 4), [](Point p) { return Point{p[0], p[1], 0.02 * p[2]}; });
  const Mesh body = Together({Sphere({0, 0, 0}, 1, 8), Reversed(thin)});
  const Mesh m = Together({body, Sphere({2.1, 0.03, 0.02}, 1, 8)});
  Arena arena(DefaultConfig(4 * VertexCount(m)), m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); i += 3) targets[i] += i < body.positions.size() ? 0.01 : -0.11;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
  EXPECT_EQ(report.handles[0], 1u);
  const Mesh after = MeshOf(*arena);
  EXPECT_TRUE(IsSound(after, "thin-void"));
  const Topology t = TopologyOf(after);
  ASSERT_EQ(t.components.size(), 2u);
  const double volume = std::min(t.components[0].volume, t.components[1].volume);
  EXPECT_NEAR(volume, -TopologyOf(thin).Volume(), 1e-12);
}

TEST(Step, AMeshThatBoundsTheOutsideIsDeclaredSo) {
  // Two bubbles in a solid, wound inward: they join as two balls do.
  Scene s = TwoSpheres(0.6);
  for (size_t i = 0; i < s.mesh.triangles.size(); i += 3) std::swap(s.mesh.triangles[i], s.mesh.triangles[i + 1]);
  tpa_config config = ConfigFor(s.mesh);
  config.region = TPA_REGION_OUTSIDE;
  Arena arena(config, s.mesh);
  ASSERT_EQ(MoveAll(*arena, TargetsOf(s.mesh, s.target)), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  const Mesh after = MeshOf(*arena);
  EXPECT_TRUE(IsSound(after, "bubbles"));
  const Topology t = TopologyOf(after);
  EXPECT_EQ(t.Genera(), s.genera);
  EXPECT_NEAR(t.Volume(), -6.53, 0.6);
}

// ---------------------------------------------------------------- the same however they are posed

TEST(Step, ScenesDoNotDependOnTheNumbering) {
  for (const Scene& scene : AllScenes())
    for (uint64_t seed = 1; seed <= Share(4u); ++seed) {
      Random random(seed);
      Scene s = scene;
      s.mesh = Renumbered(scene.mesh, random);
      const std::string name = std::string(s.name) + "-renumbered-" + std::to_string(seed);
      EXPECT_EQ(PlayToTheEnd(s, name).topology.Genera(), s.genera) << name;
    }
}

TEST(Step, ScenesDoNotDependOnTheOrientation) {
  for (const Scene& scene : AllScenes())
    for (int rotation = 1; rotation < Share(24); rotation += 5) {
      const Scene s = Turned(scene, rotation);
      const std::string name = std::string(s.name) + "-turned-" + std::to_string(rotation);
      EXPECT_EQ(PlayToTheEnd(s, name).topology.Genera(), s.genera) << name;
    }
}

TEST(Step, RandomPairsOfSpheresBecomeOneSphere) {
  for (uint64_t seed = 1; seed <= Share(100u); ++seed) {
    Random random(seed);
    Point d;
    do d = RandomPoint(random, -1, 1);
    while (Dot(d, d) < 0.01 || Dot(d, d) > 1);
    d = Unit(d);
    const double radius = Uniform(random, 0.4, 1), gap = 0.05, depth = Uniform(random, 0.1, 0.5) * radius;
    const Mesh first = Sphere({0, 0, 0}, 1, 4 + static_cast<int>(random() % 3));
    const Mesh second = Sphere(Scaled(1 + radius + gap, d), radius, 3 + static_cast<int>(random() % 3));
    Scene s{"pair", Together({first, second}), {}, 1, {0}};
    const uint32_t moving = VertexCount(first);
    std::vector<double> targets = s.mesh.positions;
    for (size_t i = 3 * size_t{moving}; i < targets.size(); ++i) targets[i] -= (gap + depth) * d[i % 3];
    Arena arena(ConfigFor(s.mesh), s.mesh);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const std::string name = "pair-seed-" + std::to_string(seed);
    EXPECT_TRUE(IsSound(MeshOf(*arena), name));
    EXPECT_EQ(TopologyOf(MeshOf(*arena)).Genera(), s.genera) << Written(MeshOf(*arena), name);
    ExpectConsistentMaps(*arena, s.mesh, targets);
  }
}

// Random jumps of random size: rollbacks, deaths and splits, and no promise but P1.
void ExpectSoundAfterJumps(uint64_t first, uint64_t last) {
  for (uint64_t seed = first; seed <= last; ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({2.5, 0, 0}, 0.9, 0.35, 12, 6)});
    tpa_config config = DefaultConfig(16 * VertexCount(m));
    config.max_contacts = 1 << 13;
    Arena arena(config, m);
    for (int step = 0; step < 4; ++step) {
      const Mesh before = MeshOf(*arena);
      std::vector<double> targets = before.positions;
      const double size = Uniform(random, 0.02, 0.5);
      for (double& x : targets) x += Uniform(random, -size, size);
      if (targets.empty()) break;
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      tpa_issue issue;
      const tpa_status status = tpa_step(*arena, nullptr, nullptr, &issue);
      if (status == TPA_E_LIMIT) break;  // crumpled beyond the room given here
      ASSERT_EQ(status, TPA_OK) << "seed " << seed << ": " << Text(issue);
      ASSERT_TRUE(IsSound(MeshOf(*arena), "jumps-seed-" + std::to_string(seed))) << "seed " << seed << " step " << step;
    }
  }
}

TEST(Step, WhateverIsAskedForTheMeshStaysSound) { ExpectSoundAfterJumps(1, Share(12u)); }
TEST(StepLong, WhateverIsAskedForTheMeshStaysSound) { ExpectSoundAfterJumps(13, 40); }

TEST(Step, EventsTellTheTopologyThatTheMeshHas) {
  // Components and genus before, plus what the events say, are components and genus after.
  for (uint64_t seed = 1; seed <= Share(40u); ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({2.5, 0, 0}, 0.9, 0.35, 12, 6), Sphere({0, 3, 0}, 1, 4)});
    tpa_config config = ConfigFor(m);
    config.max_contacts = config.max_cut_edges = 2000;  // all bodies crumple at once
    config.max_pieces = 8000;
    Arena arena(config, m);
    std::vector<double> targets = m.positions;
    const double size = Uniform(random, 0.1, 0.4);
    for (double& x : targets) x = 0.8 * x + Uniform(random, -size, size);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Topology before = TopologyOf(m), after = TopologyOf(MeshOf(*arena));
    const int64_t components = static_cast<int64_t>(before.components.size()) + ComponentsMade(EventsOf(*arena));
    int64_t genus = before.Genus();
    bool death = false;
    for (const tpa_event& e : EventsOf(*arena)) {
      const int64_t amount = e.amount;
      death = death || e.type == TPA_EVENT_DEATH;
      if (e.type == TPA_EVENT_GENUS_UP) genus += amount;
      if (e.type == TPA_EVENT_GENUS_DOWN) genus -= amount;
    }
    EXPECT_EQ(components, static_cast<int64_t>(after.components.size())) << "seed " << seed;
    if (!death) {  // the dead take their handles along
      EXPECT_EQ(genus, after.Genus()) << "seed " << seed;
    }
  }
}

TEST(Step, WhatIsRolledBackSaysWhere) {
  int rolled_back = 0;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh m = Sphere({0, 0, 0}, 1, 6);
    tpa_config config = DefaultConfig(16 * VertexCount(m));
    config.max_contacts = 1 << 14;
    config.max_cut_edges = 1 << 14;
    config.max_passes = 1;
    Arena arena(config, m);
    ASSERT_EQ(MoveAll(*arena, CoincidingTargets(m, random)), TPA_OK);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
    EXPECT_TRUE(IsSound(MeshOf(*arena), "rolled-back-seed-" + std::to_string(seed)));
    std::vector<tpa_event> events = EventsOf(*arena);
    std::erase_if(events, [](const tpa_event& e) { return e.type != TPA_EVENT_ROLLBACK; });
    ASSERT_EQ(events.size(), report.rolled_back_vertices > 0 ? 1u : 0u);
    if (events.empty()) continue;
    ++rolled_back;
    EXPECT_EQ(events[0].amount, report.rolled_back_vertices);
    const uint32_t* vertices = nullptr;
    uint32_t count = 0;
    ASSERT_EQ(tpa_rolled_back(*arena, &vertices, &count), TPA_OK);
    EXPECT_EQ(count, report.rolled_back_vertices);
    // The place lies on the moving surface: vertices move by .3 and a lattice of .2, and grow by a tenth. An event
    // without a place would have zeros.
    const Point where{events[0].position[0], events[0].position[1], events[0].position[2]};
    EXPECT_LT(Distance(where, {}), 2);
    EXPECT_GT(Distance(where, {}), 0);
  }
  EXPECT_GT(rolled_back, 0) << "nothing blocks any more: look for other seeds";
}

}  // namespace
}  // namespace step_test
