// SPDX-License-Identifier: MIT
// Remeshing: edges end near the target, the surface stays in place and sound, and a limit leaves everything alone.
#include <algorithm>
#include <cmath>

#include "support/share.h"
#include "support/step_scenes.h"
#include "support/support.h"

namespace remesh_test {
namespace {

using namespace support;

tpa_remesh_options Options(double target, uint32_t iterations = 5) {
  auto options = Sized<tpa_remesh_options>();
  options.iterations = iterations;
  options.target_length = target;
  options.relaxation = 0.5;
  return options;
}

std::vector<double> EdgeLengths(const Mesh& m) {
  std::vector<double> lengths;
  for (size_t f = 0; f < TriangleCount(m); ++f)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = m.triangles[3 * f + i], b = m.triangles[3 * f + (i + 1) % 3];
      if (a > b) continue;
      const Point p = PositionOf(m, a), q = PositionOf(m, b);
      lengths.push_back(
          std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2])));
    }
  return lengths;
}

double PartWithin(const std::vector<double>& lengths, double low, double high) {
  const auto n = std::count_if(lengths.begin(), lengths.end(), [&](double x) { return x >= low && x <= high; });
  return static_cast<double>(n) / static_cast<double>(lengths.size());
}

void ExpectRemeshed(const Mesh& m, double target, double volume_change, const std::string& name) {
  tpa_config config = DefaultConfig(20000);
  Arena arena(config, m);
  const tpa_remesh_options options = Options(target);
  auto report = Sized<tpa_report>();
  tpa_issue issue;
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, &issue), TPA_OK) << name << ": " << Text(issue);
  const Mesh after = MeshOf(*arena);
  EXPECT_TRUE(IsSound(after, name)) << name;
  const Topology before_topology = TopologyOf(m), topology = TopologyOf(after);
  EXPECT_EQ(topology.Genera(), before_topology.Genera()) << name;
  EXPECT_NEAR(topology.Volume(), before_topology.Volume(), volume_change * before_topology.Volume()) << name;
  EXPECT_GT(PartWithin(EdgeLengths(after), 0.8 * target, 4.0 / 3 * target), 0.85) << name;
  EXPECT_GT(PartWithin(EdgeLengths(after), 0.5 * target, 1.5 * target), 0.98) << name;
  EXPECT_EQ(report.vertices, VertexCount(after));
  // Each split adds a vertex, each collapse removes a vertex.
  EXPECT_EQ(int64_t{VertexCount(m)} + report.splits - report.collapses, int64_t{VertexCount(after)});
  EXPECT_TRUE(EventsOf(*arena).empty());
}

TEST(Remesh, BringsEdgesIntoTheBand) {
  ExpectRemeshed(Sphere({0, 0, 0}, 1, 6), 0.12, 0.05, "finer-sphere");
  ExpectRemeshed(Sphere({0, 0, 0}, 1, 24), 0.15, 0.05, "coarser-sphere");
  ExpectRemeshed(Torus({0, 0, 0}, 2, 0.7, 30, 16), 0.15, 0.05, "finer-torus");
  ExpectRemeshed(Torus({5, 6, 7}, 2, 0.7, 80, 40), 0.25, 0.06, "coarser-torus");
  ExpectRemeshed(Together({Sphere({0, 0, 0}, 1, 8), Sphere({3, 0, 0}, 1, 16)}), 0.15, 0.05, "two-spheres");
}

// At half the length each even triangle becomes four: a new vertex for each edge, and none that would have to go again.
TEST(Remesh, QuartersEvenTriangles) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 16);
  const double length = MeanEdgeOf(sphere);
  const Arena arena(DefaultConfig(20000), sphere);
  tpa_remesh_options options = Options(length);
  options.iterations = 10;
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
  const double edges = static_cast<double>(EdgeLengths(MeshOf(*arena)).size());
  options.target_length = 0.5 * length;
  options.iterations = 1;
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, nullptr), TPA_OK);
  EXPECT_NEAR(report.splits, edges, 0.05 * edges);
  EXPECT_LT(report.collapses, 0.05 * edges);
  EXPECT_GT(PartWithin(EdgeLengths(MeshOf(*arena)), 0.4 * length, 2.0 / 3 * length), 0.95);
}

// A double cone of 128 sides, whose tips are hubs: spokes wait until short edges of the rim have merged. The same sweep
// splits the spokes that are left.
TEST(Remesh, ASingleSweepSplitsTheLongEdgesOfAHub) {
  constexpr uint32_t sides = 128;
  Mesh cone;
  for (uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    cone.positions.insert(cone.positions.end(), {std::cos(angle), std::sin(angle), 0});
    const uint32_t next = (i + 1) % sides;
    cone.triangles.insert(cone.triangles.end(), {next, i, sides, i, next, sides + 1});
  }
  cone.positions.insert(cone.positions.end(), {0, 0, -0.3, 0, 0, 0.3});
  Arena arena(DefaultConfig(5000), cone);
  tpa_remesh_options options = Options(0.3, 1);
  options.relaxation = 0;
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, nullptr), TPA_OK);
  const Mesh after = MeshOf(*arena);
  EXPECT_TRUE(IsSound(after, "hub"));
  EXPECT_GT(report.collapses, 0u);
  EXPECT_GT(report.splits, 0u);
  const std::vector<double> lengths = EdgeLengths(after);
  const double spoke = std::hypot(1, 0.3);
  EXPECT_LT(*std::max_element(lengths.begin(), lengths.end()), 0.75 * spoke);
}

TEST(Remesh, LeavesAGoodMeshAlone) {
  Arena arena(DefaultConfig(10000), Sphere({0, 0, 0}, 1, 10));
  const tpa_remesh_options options = Options(0.15, 10);
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
  // A fully remeshed mesh keeps its bits, except for a few stragglers.
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, nullptr), TPA_OK);
  EXPECT_LT(report.splits + report.collapses + report.flips, VertexCount(MeshOf(*arena)) / 20);
  auto untouched = Options(10, 1);
  untouched.collapse_ratio = 1e-6;
  const Mesh before = MeshOf(*arena);
  untouched.split_ratio = 100;
  ASSERT_EQ(tpa_remesh(*arena, &untouched, nullptr, &report, nullptr), TPA_OK);
  if (report.flips == 0) {
    EXPECT_EQ(MeshOf(*arena).positions, before.positions);
  }
}

TEST(Remesh, NoisyThinAndClosePartsStaySound) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    // Two parallel shells close together, just left apart by noise.
    Mesh m = Together({Sphere({0, 0, 0}, 1, 7), Sphere({0, 0, 0}, 0.93, 7)});
    for (size_t i = m.triangles.size() / 2; i < m.triangles.size(); i += 3)
      std::swap(m.triangles[i], m.triangles[i + 1]);
    for (double& x : m.positions) x += Uniform(random, -0.02, 0.02);
    if (!AllMeetingPairs(m).empty()) continue;
    Arena arena(DefaultConfig(10000), m);
    const tpa_remesh_options options = Options(Uniform(random, 0.1, 0.5), 3);
    ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
    const std::string name = "shells-seed-" + std::to_string(seed);
    EXPECT_TRUE(IsSound(MeshOf(*arena), name)) << name;
    EXPECT_EQ(TopologyOf(MeshOf(*arena)).Genera(), (std::vector<int64_t>{0, 0}));
  }
}

// Slanted sheets 2^-23 apart. Middles of edges between coordinates of 25 bits are exact and need no search, others are
// rounded.
TEST(Remesh, CloseSheetsStayApart) {
  uint64_t units[2] = {};
  for (const bool exact : {true, false})
    for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
      Random random(seed);
      Mesh m = Together({Box({0, 0, 0}, {1, 1, 1}, 4), Box({0, 0, 1 + 0x1p-23}, {1, 1, 2}, 4)});
      for (size_t i = 0; i < m.positions.size(); i += 3) {
        for (size_t k = i; k < i + 2; ++k) {
          m.positions[k] += Uniform(random, -0.05, 0.05);
          if (exact) m.positions[k] = static_cast<double>(static_cast<float>(m.positions[k]));
        }
        m.positions[i + 2] += 0.5 * m.positions[i];
      }
      Arena arena(DefaultConfig(20000), m);
      auto options = Options(0.1, 1);
      options.relaxation = 0;
      options.collapse_ratio = 1e-6;
      auto exec = Sized<tpa_exec>();
      uint64_t spent = 0;
      exec.progress = &spent;
      auto report = Sized<tpa_report>();
      ASSERT_EQ(tpa_remesh(*arena, &options, &exec, &report, nullptr), TPA_OK);
      units[exact ? 1 : 0] += spent;
      const std::string name = (exact ? "exact-sheets-" : "rounded-sheets-") + std::to_string(seed);
      EXPECT_GT(report.splits, 500u) << name;
      EXPECT_TRUE(IsSound(MeshOf(*arena), name)) << name;
    }
  EXPECT_LT(2 * units[1], units[0]);
}

// A call of exact splits alone has asked for no volume when it comes to relax.
TEST(Remesh, VerticesOfExactSplitsAreRelaxed) {
  Mesh m;
  m.positions = {1.25, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  m.triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  Arena arena(DefaultConfig(1000), m);
  auto options = Options(1.15, 1);
  options.collapse_ratio = 1e-6;
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, nullptr), TPA_OK);
  EXPECT_GT(report.splits, 0u);
  EXPECT_EQ(report.collapses + report.flips, 0u);
  EXPECT_GT(report.moved, 0u);
  EXPECT_TRUE(IsSound(MeshOf(*arena), "octahedron"));
}

// Two tips over a triangle, flat and not convex: a tip with one edge collapsed has no faces left to meet.
TEST(Remesh, SmallBodiesAreNotTurnedInsideOut) {
  uint32_t tried = 0, collapses = 0;
  for (uint64_t seed = 1; seed <= Share(20000u); ++seed) {
    Random random(seed);
    Mesh m;
    for (int v = 0; v < 5; ++v)
      m.positions.insert(m.positions.end(),
                         {Uniform(random, 0, 1), Uniform(random, 0, 1), 0.05 * Uniform(random, 0, 1)});
    m.triangles = {0, 1, 3, 1, 2, 3, 2, 0, 3, 1, 0, 4, 2, 1, 4, 0, 2, 4};
    if (!AllMeetingPairs(m).empty()) continue;
    const bool hollow = TopologyOf(m).Volume() < 0;
    ++tried;
    Arena arena(DefaultConfig(100), m);
    const tpa_remesh_options options = Options(1.2, 1);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, nullptr), TPA_OK) << "seed " << seed;
    collapses += report.collapses;
    EXPECT_EQ(TopologyOf(MeshOf(*arena)).Volume() < 0, hollow) << "seed " << seed;
  }
  EXPECT_GT(tried, Least(1000u));
  EXPECT_GT(collapses, Least(100u));
}

// Each vertex of such a body moves all of the body: no surface stays behind to be met.
TEST(Remesh, ThinBodiesAreNotTurnedInsideOut) {
  uint32_t tried = 0, collapses = 0, flips = 0;
  for (uint64_t seed = 1; seed <= Share(30000u); ++seed) {
    Random random(seed);
    const Mesh m = ThinBody(random);
    if (!AllMeetingPairs(m).empty()) continue;
    ++tried;
    Arena arena(DefaultConfig(1000), m);
    auto options = Options(Uniform(random, 0.2, 2), static_cast<uint32_t>(1 + seed % 3));
    if (seed % 4 == 0) options.collapse_ratio = 1e-6;
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, &report, nullptr), TPA_OK) << "seed " << seed;
    collapses += report.collapses;
    flips += report.flips;
    EXPECT_EQ(TopologyOf(MeshOf(*arena)).Volume() < 0, TopologyOf(m).Volume() < 0) << "seed " << seed;
  }
  EXPECT_GT(tried, Least(5000u));
  EXPECT_GT(collapses, Least(10000u));
  EXPECT_GT(flips, Least(1000u));
}

TEST(Remesh, NewVerticesLieBetweenTheirParents) {
  const Mesh m = Sphere({0, 0, 0}, 1, 6);
  Arena arena(DefaultConfig(10000), m);
  auto options = Options(0.2, 1);
  options.relaxation = 0;
  ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
  const Mesh after = MeshOf(*arena);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(*arena);
  const std::vector<uint32_t> old_to_new = OldToNewOf(*arena);
  size_t made = 0;
  for (uint32_t n = 0; n < origins.size(); ++n) {
    const tpa_vertex_origin& o = origins[n];
    const Point p = PositionOf(after, n), a = PositionOf(m, o.parents[0]);
    if (o.parents[1] == TPA_NONE) {
      EXPECT_EQ(p, a);
      EXPECT_EQ(old_to_new[o.parents[0]], n);
      continue;
    }
    ++made;
    const Point b = PositionOf(m, o.parents[1]);
    const double w = static_cast<double>(o.weight);
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(p[i], w * a[i] + (1 - w) * b[i], 0.2) << "vertex " << n;
  }
  EXPECT_GT(made, 0u);
  for (uint32_t f : TriangleOriginsOf(*arena)) EXPECT_LT(f, TriangleCount(m));
}

TEST(Remesh, LimitsLeaveEverythingAsItWas) {
  const Mesh m = Sphere({0, 0, 0}, 1, 5);
  const tpa_remesh_options options = Options(0.2);
  Arena ample(DefaultConfig(10000), m);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_remesh(*ample, &options, nullptr, &report, nullptr), TPA_OK);
  for (uint32_t room = 0; room < 200; room += 7) {
    tpa_config vertices = DefaultConfig(VertexCount(m) + room), triangles = DefaultConfig(10000);
    vertices.max_triangles = 20000;
    triangles.max_triangles = TriangleCount(m) + 2 * room;
    for (const tpa_config& config : {vertices, triangles}) {
      Arena arena(config, m);
      const Observed before = Observe(*arena);
      tpa_issue issue;
      const tpa_status status = tpa_remesh(*arena, &options, nullptr, nullptr, &issue);
      const int32_t limit = config.max_triangles == 20000 ? TPA_LIMIT_VERTICES : TPA_LIMIT_TRIANGLES;
      ASSERT_EQ(status, TPA_E_LIMIT) << room;
      EXPECT_EQ(issue.limit, limit);
      EXPECT_GT(issue.needed, issue.available);
      EXPECT_TRUE(Observe(*arena) == before) << room;
    }
  }
}

// The bodies are known from call to call. The judge counts them again.
void ExpectNames(uint64_t first, uint64_t last, int least) {
  const std::vector<Point> middles = {{0, 0, 0}, {2.3, 0, 0}, {0, 2.3, 0}, {0, 0, 2.3}, {2.3, 2.3, 0}};
  int merges = 0, deaths = 0;
  for (uint64_t seed = first; seed <= last; ++seed) {
    Random random(seed);
    std::vector<Mesh> balls;
    for (const Point& at : middles)
      balls.push_back(Sphere(at, Uniform(random, 0.7, 1), 4 + static_cast<int>(random() % 6)));
    tpa_config config = DefaultConfig(20000);
    config.max_contacts = config.max_cut_edges = 20000;
    Arena arena(config, Renumbered(Together(balls), random));
    for (int round = 0; round < 4 && VertexCount(MeshOf(*arena)) > 0; ++round) {
      const tpa_remesh_options options = Options(Uniform(random, 0.25, 0.5), 2);
      tpa_issue issue;
      ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, &issue), TPA_OK) << Text(issue);
      const Mesh before = MeshOf(*arena);
      // Each body swells, or is turned inside out.
      std::vector<double> factor;
      for (size_t k = 0; k < middles.size(); ++k)
        factor.push_back(random() % 5 == 0 ? -0.5 : Uniform(random, 1.1, 1.4));
      std::vector<double> targets = before.positions;
      for (uint32_t v = 0; v < VertexCount(before); ++v) {
        const Point p = PositionOf(before, v);
        size_t nearest = 0;
        for (size_t k = 1; k < middles.size(); ++k)
          if (Distance(p, middles[k]) < Distance(p, middles[nearest])) nearest = k;
        for (size_t k = 0; k < 3; ++k)
          targets[3 * v + k] = middles[nearest][k] + factor[nearest] * (p[k] - middles[nearest][k]);
      }
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      const tpa_status status = tpa_step(*arena, nullptr, nullptr, &issue);
      if (status == TPA_E_LIMIT) break;  // crumpled beyond the room given here
      ASSERT_EQ(status, TPA_OK) << Text(issue);
      const Topology old = TopologyOf(before), now = TopologyOf(MeshOf(*arena));
      const auto is_name = [](const Topology& t, uint32_t id) {
        return std::any_of(t.components.begin(), t.components.end(),
                           [&](const auto& c) { return c.smallest_vertex == id; });
      };
      for (const tpa_event& e : EventsOf(*arena)) {
        if (e.type < TPA_EVENT_MERGE) continue;
        EXPECT_TRUE(is_name(old, e.before)) << e.before;
        EXPECT_TRUE(e.type == TPA_EVENT_DEATH || is_name(now, e.after)) << e.after;
        merges += e.type == TPA_EVENT_MERGE ? 1 : 0;
        deaths += e.type == TPA_EVENT_DEATH ? 1 : 0;
      }
      const int64_t bodies = static_cast<int64_t>(old.components.size()) + ComponentsMade(EventsOf(*arena));
      EXPECT_EQ(bodies, static_cast<int64_t>(now.components.size()))
          << Written(before, "names-" + std::to_string(seed));
    }
  }
  EXPECT_GT(merges, least);
  EXPECT_GT(deaths, least);
}

TEST(Remesh, BodiesKeepTheirNames) { ExpectNames(1, Share(4u), Least(3)); }
TEST(RemeshLong, BodiesKeepTheirNames) { ExpectNames(5, 12, 6); }

// Steps and sweeps with a few changed faces each time, some without a place in the tree. Powers of two round nothing.
TEST(Remesh, ScaleDoesNotMatter) {
  std::vector<double> as_it_is;
  for (const int exponent : {0, -60, 20, 40, 90}) {
    const double scale = std::ldexp(1.0, exponent);
    Random random(1);
    Mesh mesh = Sphere({0.25, 0.125, 0}, 1, 30);
    for (double& x : mesh.positions) x *= scale;
    Arena arena(DefaultConfig(20000), mesh);
    for (int round = 0; round < 3; ++round) {
      std::vector<double> targets = MeshOf(*arena).positions;
      for (size_t i = 0; i < targets.size(); i += 3)
        if (targets[i + 2] > 0.9 * scale || targets[i] < -0.7 * scale)
          for (size_t k = 0; k < 3; ++k)
            targets[i + k] *= (round % 2 == 0 ? 1.125 : 0.875) + Uniform(random, -0.002, 0.002);
      tpa_issue issue;
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), TPA_OK) << exponent << ": " << Text(issue);
      const tpa_remesh_options options = Options(0.06 * scale, 1);
      ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, &issue), TPA_OK) << exponent << ": " << Text(issue);
    }
    std::vector<double> positions = MeshOf(*arena).positions;
    for (double& x : positions) x /= scale;
    if (exponent == 0) as_it_is = positions;
    EXPECT_EQ(positions, as_it_is) << exponent;
  }
}

TEST(Remesh, OptionsOutOfRangeAreRefused) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  Arena arena(ConfigFor(m), m);
  const Observed before = Observe(*arena);
  const auto refuse = [&](auto&& change) {
    tpa_remesh_options options = Options(0.3);
    change(options);
    tpa_issue issue;
    EXPECT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, &issue), TPA_E_ARGUMENT);
    EXPECT_EQ(issue.argument, 2);
    EXPECT_TRUE(Observe(*arena) == before);
  };
  refuse([](tpa_remesh_options& o) { o.struct_size = 0; });
  refuse([](tpa_remesh_options& o) { o.iterations = 0; });
  refuse([](tpa_remesh_options& o) { o.iterations = 101; });
  for (double bad : {0.0, -1.0, double{NAN}, double{INFINITY}})
    refuse([&](tpa_remesh_options& o) { o.target_length = bad; });
  refuse([](tpa_remesh_options& o) { o.collapse_ratio = 1; });  // more than 4/3 / 1.5
  refuse([](tpa_remesh_options& o) { o.split_ratio = -1; });
  refuse([](tpa_remesh_options& o) { o.collapse_ratio = double{NAN}; });
  for (double bad : {-0.1, 1.1, double{NAN}}) refuse([&](tpa_remesh_options& o) { o.relaxation = bad; });
  tpa_issue issue;
  EXPECT_EQ(tpa_remesh(*arena, nullptr, nullptr, nullptr, &issue), TPA_E_ARGUMENT);
}

}  // namespace
}  // namespace remesh_test
