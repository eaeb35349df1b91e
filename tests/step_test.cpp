// Steps: each scene moves until its surface runs into itself, and ends in the topology that it should (P1, P3).
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "elementary.h"
#include "state.h"
#include "support.h"

namespace {

using namespace support;

// ---------------------------------------------------------------- scenes

struct Scene {
  const char* name;
  Mesh mesh;
  std::function<Point(const Point&)> target;  // where a vertex at p wants to go in one step
  int most_steps;
  std::vector<int64_t> genera;  // what it should end in
};

Point Scaled(const Point& p, double s) { return {s * p[0], s * p[1], s * p[2]}; }
Point Sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
double DotOf(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double Distance(const Point& a, const Point& b) {
  const Point d = Sum(a, Scaled(b, -1));
  return std::sqrt(DotOf(d, d));
}

Scene TwoSpheres(double overlap, int fineness = 6) {
  return {"two-spheres", Together({Sphere({-1.1, 0, 0}, 1, fineness), Sphere({1.1, 0.07, 0.03}, 1, fineness)}),
          [=](const Point& p) { return Point{p[0] + (p[0] < 0 ? 1 : -1) * (0.1 + overlap), p[1], p[2]}; }, 1, {0}};
}

// A spindle along x, thin in the middle, whose middle is pressed flat until its sides pass each other.
Scene Dumbbell() {
  std::vector<Point> points;
  std::vector<double> radii;
  for (int i = 0; i <= 24; ++i) {
    const double x = -3 + 0.25 * i;
    points.push_back({x, 0.01, 0.02});
    radii.push_back(0.3 + 0.7 * std::min(1.0, std::fabs(x) / 2));
  }
  return {"dumbbell", Tube(points, radii, 12, {0.1, 0.2, 1}),
          [](const Point& p) {
            const double s = std::fabs(p[0]) < 0.6 ? 0.08 : 0, r = std::sqrt(p[1] * p[1] + p[2] * p[2]);
            return r == 0 ? p : Point{p[0], p[1] * (1 - s / r), p[2] * (1 - s / r)};
          },
          12, {0, 0}};
}

// An open ring round z that closes: angles grow away from pi.
Scene ClosingRing() {
  std::vector<Point> points;
  for (int i = 0; i <= 40; ++i) {
    const double a = 0.35 + (2 * 3.14159265358979 - 0.7) * i / 40;
    points.push_back({3 * tool::cosine(a), 3 * tool::sine(a), 0});
  }
  return {"closing-ring", Tube(points, std::vector<double>(points.size(), 0.6), 10, {0, 0, 1}),
          [](const Point& p) {
            const double pi = 3.14159265358979, r = std::sqrt(p[0] * p[0] + p[1] * p[1]);
            const double a = tool::arc_tangent(-p[1], -p[0]) * 1.03 + pi;
            return Point{r * tool::cosine(a), r * tool::sine(a), p[2]};
          },
          10, {1}};
}

// A sphere drawn out to a spindle whose tip almost reaches the origin from the given direction.
Mesh Spindle(const Point& direction) {
  Mesh m = Sphere({0, 0, 0}, 0.5, 6);
  const Point d = Scaled(direction, 1 / std::sqrt(DotOf(direction, direction)));
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v), q = Sum(p, Scaled(d, 3 * DotOf(p, d) + 2.1));
    for (size_t i = 0; i < 3; ++i) m.positions[3 * v + i] = q[i];
  }
  return m;
}

// Spindles that arrive at one point in one step.
Scene Meeting(const char* name, const std::vector<Point>& directions) {
  std::vector<Mesh> parts;
  for (const Point& d : directions) parts.push_back(Spindle(d));
  const auto inward = [=](const Point& p) {
    Point best{};
    double most = -1;
    for (const Point& d : directions) {
      const Point u = Scaled(d, 1 / std::sqrt(DotOf(d, d)));
      if (DotOf(p, u) > most) {
        most = DotOf(p, u);
        best = u;
      }
    }
    return Sum(p, Scaled(best, -0.3));
  };
  return {name, Together(parts), inward, 1, {0}};
}

Scene ThreeSpindles() { return Meeting("three-spindles", {{1, 0.02, 0}, {-0.5, 0.87, 0.01}, {-0.5, -0.86, 0.03}}); }
Scene FourInACross() {
  return Meeting("four-in-a-cross", {{1, 0.02, 0.01}, {-0.02, 1, 0.02}, {-1, 0.01, -0.02}, {0.01, -1, 0.02}});
}
Scene FourTetrahedral() { return Meeting("four-tetrahedral", {{1, 1, 1.02}, {1, -1, -1}, {-1, 1.01, -1}, {-1, -1, 1}}); }

std::vector<Scene> AllScenes() {
  return {TwoSpheres(0.08), TwoSpheres(0.6), Dumbbell(), ClosingRing(), ThreeSpindles(), FourInACross(),
          FourTetrahedral()};
}

// The same with everything turned.
Scene Turned(Scene s, int rotation) {
  s.mesh = QuarterTurned(s.mesh, rotation);
  // The way back, by trying.
  int back = 0;
  const Point probe{1, 2, 3};
  while (QuarterTurned(QuarterTurned(probe, rotation), back) != probe) ++back;
  s.target = [=, target = s.target](const Point& p) { return QuarterTurned(target(QuarterTurned(p, back)), rotation); };
  return s;
}

std::vector<double> TargetsOf(const Mesh& m, const std::function<Point(const Point&)>& target) {
  std::vector<double> targets;
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = target(PositionOf(m, v));
    targets.insert(targets.end(), p.begin(), p.end());
  }
  return targets;
}

// What the last commit did to the vertices must fit together.
void ExpectConsistentMaps(tpa_context* context, const Mesh& before, const std::vector<double>& targets) {
  const Mesh after = MeshOf(context);
  const std::vector<uint32_t> old_to_new = OldToNewOf(context), faces = TriangleOriginsOf(context);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
  ASSERT_EQ(old_to_new.size(), VertexCount(before));
  ASSERT_EQ(origins.size(), VertexCount(after));
  ASSERT_EQ(faces.size(), TriangleCount(after));
  for (uint32_t n = 0; n < origins.size(); ++n) {
    const tpa_vertex_origin& o = origins[n];
    ASSERT_LT(o.parents[0], old_to_new.size());
    ASSERT_TRUE(o.weight >= 0 && o.weight <= 1);
    if (o.parents[1] == TPA_NONE) {
      EXPECT_EQ(o.weight, 1.0f);
      EXPECT_EQ(old_to_new[o.parents[0]], n);
    } else {
      ASSERT_LT(o.parents[1], old_to_new.size());
    }
  }
  for (uint32_t v = 0; v < old_to_new.size(); ++v) {
    if (old_to_new[v] == TPA_NONE) continue;
    ASSERT_LT(old_to_new[v], origins.size());
    EXPECT_EQ(origins[old_to_new[v]].parents[0], v);
    EXPECT_EQ(origins[old_to_new[v]].parents[1], TPA_NONE);
  }
  // P4: away from the events the targets' bits are kept. Near is what lies within the smoothing's reach.
  double largest_edge = 0;
  for (size_t f = 0; f < TriangleCount(after); ++f)
    for (size_t i = 0; i < 3; ++i)
      largest_edge = std::max(largest_edge, Distance(PositionOf(after, after.triangles[3 * f + i]),
                                                     PositionOf(after, after.triangles[3 * f + (i + 1) % 3])));
  std::set<uint32_t> near_new;  // new vertices, corners of new triangles, and two rings round them
  for (uint32_t n = 0; n < origins.size(); ++n)
    if (origins[n].parents[1] != TPA_NONE) near_new.insert(n);
  for (uint32_t f = 0; f < faces.size(); ++f)
    for (size_t i = 0; i < 3 && faces[f] == TPA_NONE; ++i) near_new.insert(after.triangles[3 * f + i]);
  for (int ring = 0; ring < 2; ++ring) {
    std::set<uint32_t> grown = near_new;
    for (size_t f = 0; f < TriangleCount(after); ++f)
      for (size_t i = 0; i < 3; ++i)
        if (near_new.count(after.triangles[3 * f + i]) != 0)
          grown.insert(after.triangles.begin() + static_cast<std::ptrdiff_t>(3 * f),
                       after.triangles.begin() + static_cast<std::ptrdiff_t>(3 * f + 3));
    near_new = grown;
  }
  const uint32_t* rolled_back = nullptr;
  uint32_t rolled_back_count = 0;
  ASSERT_EQ(tpa_rolled_back(context, &rolled_back, &rolled_back_count), TPA_OK);
  const std::set<uint32_t> stayed(rolled_back, rolled_back + rolled_back_count);
  for (uint32_t n = 0; n < origins.size(); ++n) {
    const tpa_vertex_origin& o = origins[n];
    const Point p = PositionOf(after, n);
    const auto target = [&](uint32_t v) { return Point{targets[3 * v], targets[3 * v + 1], targets[3 * v + 2]}; };
    if (o.parents[1] == TPA_NONE) {
      if (near_new.count(n) != 0) continue;
      const bool refused = stayed.count(n) != 0;
      EXPECT_EQ(p, refused ? PositionOf(before, o.parents[0]) : target(o.parents[0])) << "vertex " << n;
    } else {
      const double w = static_cast<double>(o.weight);
      const Point mean = Sum(Scaled(target(o.parents[0]), w), Scaled(target(o.parents[1]), 1 - w));
      EXPECT_LT(Distance(p, mean), 2 * largest_edge) << "new vertex " << n;
    }
  }
  // A triangle that kept its three corners is the old one.
  for (uint32_t f = 0; f < faces.size(); ++f) {
    if (faces[f] == TPA_NONE) continue;
    ASSERT_LT(faces[f], TriangleCount(before));
    std::set<uint32_t> now, then;
    bool whole = true;
    for (size_t i = 0; i < 3; ++i) {
      const tpa_vertex_origin& o = origins[after.triangles[3 * f + i]];
      whole = whole && o.parents[1] == TPA_NONE;
      now.insert(o.parents[0]);
      then.insert(before.triangles[3 * faces[f] + i]);
    }
    if (whole) {
      EXPECT_EQ(now, then) << "triangle " << f;
    }
  }
}

struct Played {
  Topology topology;
  std::vector<tpa_event> events;  // of all steps
  uint32_t rolled_back = 0;
  Mesh mesh;
};

// Steps until the scene has the topology that it should end in, judging the mesh after every step.
Played Play(const Scene& s, const std::string& name) {
  Arena arena(ConfigFor(s.mesh), s.mesh);
  Played played;
  for (int step = 0; step < s.most_steps; ++step) {
    const Mesh before = MeshOf(*arena);
    const std::vector<double> targets = TargetsOf(before, s.target);
    tpa_issue issue;
    auto report = Sized<tpa_report>();
    EXPECT_EQ(MoveAll(*arena, targets, &issue), TPA_OK) << name << ": " << Text(issue);
    const tpa_status status = tpa_step(*arena, nullptr, &report, &issue);
    EXPECT_EQ(status, TPA_OK) << name << ", step " << step << ": " << Text(issue);
    if (status != TPA_OK) break;
    played.mesh = MeshOf(*arena);
    EXPECT_EQ(report.vertices, VertexCount(played.mesh));
    EXPECT_EQ(report.triangles, TriangleCount(played.mesh));
    EXPECT_TRUE(IsSound(played.mesh, name)) << name << ", step " << step;
    ExpectConsistentMaps(*arena, before, targets);
    const std::vector<tpa_event> events = EventsOf(*arena);
    played.events.insert(played.events.end(), events.begin(), events.end());
    played.rolled_back += report.rolled_back_vertices;
    played.topology = TopologyOf(played.mesh);
    if (played.topology.Genera() == s.genera) break;
  }
  return played;
}

// Sum of the amounts of one kind of event.
uint32_t Amount(const std::vector<tpa_event>& events, int32_t type) {
  uint32_t sum = 0;
  for (const tpa_event& e : events) sum += e.type == type ? e.amount : 0;
  return sum;
}
bool Has(const std::vector<tpa_event>& events, int32_t type, uint32_t amount) {
  return std::any_of(events.begin(), events.end(),
                     [&](const tpa_event& e) { return e.type == type && e.amount == amount; });
}

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
  const Scene s = TwoSpheres(0.08);
  const Played p = Play(s, s.name);
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
      EXPECT_EQ(e.type, TPA_EVENT_REMOVAL);  // vertices that were inside the other one
    }
  }
  EXPECT_TRUE(std::is_sorted(p.events.begin(), p.events.end(), [](const tpa_event& x, const tpa_event& y) {
    return x.type < TPA_EVENT_MERGE && y.type < TPA_EVENT_MERGE ? false : x.type < y.type;  // regions first
  }));
  EXPECT_EQ(p.rolled_back, 0u);
}

// Total length of the edges of the triangles that an event made, each edge counted once for each of them.
double LengthOfNewTriangles(const tpa_context* context) {
  const Mesh m = MeshOf(context);
  const std::vector<uint32_t> origins = TriangleOriginsOf(context);
  const auto at = [&m](size_t corner) {
    const size_t v = m.triangles[corner];
    return Point{m.positions[3 * v], m.positions[3 * v + 1], m.positions[3 * v + 2]};
  };
  double sum = 0;
  for (size_t f = 0; f < origins.size(); ++f)
    for (size_t c = 0; c < 3 && origins[f] == TPA_NONE; ++c) sum += Distance(at(3 * f + c), at(3 * f + (c + 1) % 3));
  return sum;
}

TEST(Step, TheShortestHandleIsTakenWhereItIsAskedFor) {
  const Scene s = TwoSpheres(0.08, 3);  // coarse enough for loops of the database
  double length[2];
  for (uint32_t order : {TPA_HANDLES_STORED_FIRST, TPA_HANDLES_SHORTEST_FIRST}) {
    tpa_config config = ConfigFor(s.mesh);
    config.handle_order = order;
    config.smooth_iterations = 0;
    Arena arena(config, s.mesh);
    ASSERT_EQ(MoveAll(*arena, TargetsOf(s.mesh, s.target)), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    EXPECT_EQ(TopologyOf(MeshOf(*arena)).Genera(), s.genera);
    EXPECT_TRUE(Has(EventsOf(*arena), TPA_EVENT_HANDLE, 2));
    length[order] = LengthOfNewTriangles(*arena);
  }
  EXPECT_LT(length[TPA_HANDLES_SHORTEST_FIRST], length[TPA_HANDLES_STORED_FIRST]);
}

// A bar is pushed half way into a cube, along each axis, both ways: its sides, and those of the cube, are parallel to
// the axes, and so to the rays that tell what is inside.
TEST(Step, ABarThatIsParallelToTheAxesGrowsTogetherWithTheCube) {
  const Mesh cube = Box({0, 0, 0}, {1, 1, 1}, 5), bar = Box({1.06, .31, .27}, {2.5, .64, .71}, 4);
  const uint32_t corners = VertexCount(cube);
  const double exact = 1 + .33 * .44 * (2.5 - 1.06 - .53 + .06);
  for (int rotation = 0; rotation < 24; ++rotation) {
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
      // A step rounds off by an edge; adapt, which cuts along the seam, by a quarter of one.
      const double off = arena == &stepped ? .08 : .02;
      EXPECT_NEAR(TopologyOf(result).Volume(), exact, off * exact) << Written(result, name);
      EXPECT_TRUE(Has(EventsOf(**arena), TPA_EVENT_HANDLE, 2)) << name;
      if (arena == &stepped) {
        EXPECT_LT(VertexCount(result), corners + VertexCount(bar)) << name;
      }
    }
  }
}

TEST(Step, DeepOverlapLosesTheSwallowedCaps) {
  const Scene s = TwoSpheres(0.6);
  const Played p = Play(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_GT(Amount(p.events, TPA_EVENT_REMOVAL), 0u);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_MERGE, 2));
  // The union of two balls of radius 1 whose centres are 0.8 apart, meshed with chords.
  EXPECT_NEAR(p.topology.Volume(), 6.53, 0.6);
}

TEST(Step, APinchedNeckSplits) {
  const Scene s = Dumbbell();
  const Played p = Play(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_SPLIT, 2));
  EXPECT_GE(Amount(p.events, TPA_EVENT_CAP), 2u);
}

TEST(Step, ABentTubeClosesToARing) {
  const Scene s = ClosingRing();
  const Played p = Play(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_GENUS_UP, 1));
}

TEST(Step, ThreeMeetAtAPointInOneStep) {
  const Scene s = ThreeSpindles();
  const Played p = Play(s, s.name);
  EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
  EXPECT_TRUE(Has(p.events, TPA_EVENT_HANDLE, 3));
  EXPECT_TRUE(Has(p.events, TPA_EVENT_MERGE, 3));
}

TEST(Step, FourMeetAtAPointInOneStep) {
  for (const Scene& s : {FourInACross(), FourTetrahedral()}) {
    const Played p = Play(s, s.name);
    EXPECT_EQ(p.topology.Genera(), s.genera) << Written(p.mesh, s.name);
    EXPECT_TRUE(Has(p.events, TPA_EVENT_HANDLE, 4)) << s.name;
    EXPECT_TRUE(Has(p.events, TPA_EVENT_MERGE, 4)) << s.name;
  }
}

TEST(Step, AComponentCrumpledToNothingDies) {
  const Mesh large = Sphere({0, 0, 0}, 1, 5), small = Sphere({4, 0, 0}, 0.5, 3);
  const Mesh m = Together({large, small});
  int deaths = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    Arena arena(ConfigFor(m), m);
    std::vector<double> targets = m.positions;
    for (size_t i = large.positions.size(); i < targets.size(); i += 3) {
      const Point p = RandomPoint(random, -0.05, 0.05);
      targets[i] = 4 + p[0];
      targets[i + 1] = p[1];
      targets[i + 2] = p[2];
    }
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    EXPECT_TRUE(IsSound(after, "death")) << "seed " << seed;
    const std::vector<tpa_event> events = EventsOf(*arena);
    for (size_t v = 0; v < VertexCount(large); ++v) EXPECT_EQ(PositionOf(after, v), PositionOf(large, v));
    if (TopologyOf(after).components.size() > 1) continue;  // a crumb that happens to be embedded lives on
    ++deaths;
    ASSERT_EQ(events.size(), 1u) << "seed " << seed;
    EXPECT_EQ(events[0].type, TPA_EVENT_DEATH);
    EXPECT_EQ(events[0].before, VertexCount(large));
    EXPECT_EQ(events[0].after, TPA_NONE);
  }
  EXPECT_GE(deaths, 8);
}

TEST(Step, TheLastComponentMayDieToo) {
  const Mesh m = Sphere({0, 0, 0}, 1, 3);
  Random random(7);
  Arena arena(ConfigFor(m), m);
  std::vector<double> targets = m.positions;
  for (double& x : targets) x = Uniform(random, -0.05, 0.05);
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
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      Random random(seed);
      Scene s = scene;
      s.mesh = Renumbered(scene.mesh, random);
      const std::string name = std::string(s.name) + "-renumbered-" + std::to_string(seed);
      EXPECT_EQ(Play(s, name).topology.Genera(), s.genera) << name;
    }
}

TEST(Step, ScenesDoNotDependOnTheOrientation) {
  for (const Scene& scene : AllScenes())
    for (int rotation = 1; rotation < 24; rotation += 5) {
      const Scene s = Turned(scene, rotation);
      const std::string name = std::string(s.name) + "-turned-" + std::to_string(rotation);
      EXPECT_EQ(Play(s, name).topology.Genera(), s.genera) << name;
    }
}

TEST(Step, RandomPairsOfSpheresBecomeOneSphere) {
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    Point d;
    do d = RandomPoint(random, -1, 1);
    while (DotOf(d, d) < 0.01 || DotOf(d, d) > 1);
    d = Scaled(d, 1 / std::sqrt(DotOf(d, d)));
    const double radius = Uniform(random, 0.4, 1), gap = 0.05, depth = Uniform(random, 0.1, 0.5) * radius;
    const Mesh first = Sphere({0, 0, 0}, 1, 4 + static_cast<int>(random() % 3));
    const Mesh second = Sphere(Scaled(d, 1 + radius + gap), radius, 3 + static_cast<int>(random() % 3));
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

TEST(Step, WhateverIsAskedForTheMeshStaysSound) {
  // Random jumps of random size: rollbacks, deaths and splits, and no promise but P1.
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({2.5, 0, 0}, 0.9, 0.35, 12, 6)});
    Arena arena(ConfigFor(m), m);
    for (int step = 0; step < 4; ++step) {
      const Mesh before = MeshOf(*arena);
      std::vector<double> targets = before.positions;
      const double size = Uniform(random, 0.02, 0.5);
      for (double& x : targets) x += Uniform(random, -size, size);
      if (targets.empty()) break;
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      tpa_issue issue;
      ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, &issue), TPA_OK) << "seed " << seed << ": " << Text(issue);
      ASSERT_TRUE(IsSound(MeshOf(*arena), "jumps-seed-" + std::to_string(seed))) << "seed " << seed << " step " << step;
    }
  }
}

TEST(Step, EventsTellTheTopologyThatTheMeshHas) {
  // Components and genus before, plus what the events say, are components and genus after.
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({2.5, 0, 0}, 0.9, 0.35, 12, 6), Sphere({0, 3, 0}, 1, 4)});
    Arena arena(ConfigFor(m), m);
    std::vector<double> targets = m.positions;
    const double size = Uniform(random, 0.1, 0.4);
    for (double& x : targets) x = 0.8 * x + Uniform(random, -size, size);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    const Topology before = TopologyOf(m), after = TopologyOf(MeshOf(*arena));
    int64_t components = static_cast<int64_t>(before.components.size()), genus = before.Genus();
    bool death = false;
    for (const tpa_event& e : EventsOf(*arena)) {
      const int64_t amount = e.amount;
      if (e.type == TPA_EVENT_MERGE) components -= amount - 1;
      if (e.type == TPA_EVENT_SPLIT) components += amount - 1;
      if (e.type == TPA_EVENT_BIRTH) components += amount;
      if (e.type == TPA_EVENT_DEATH) components -= amount, death = true;
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
  // Noise so large that all of the mesh is in contact. Few such steps cannot be made: these.
  struct Case {
    uint64_t seed;
    int fineness;
  };
  int rolled_back = 0;
  for (const Case& c : {Case{24, 6}, Case{52, 8}, Case{13, 10}}) {
    SCOPED_TRACE("seed " + std::to_string(c.seed));
    Random random(c.seed);
    const Mesh m = Sphere({0, 0, 0}, 1, c.fineness);
    tpa_config config = ConfigFor(m);
    config.max_contacts = 1 << 18;
    config.max_cut_edges = 1 << 14;
    Arena arena(config, m);
    std::vector<double> targets = m.positions;
    for (double& x : targets) x += Uniform(random, -0.3, 0.3);
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
    EXPECT_TRUE(IsSound(MeshOf(*arena), "rolled-back-seed-" + std::to_string(c.seed)));
    std::vector<tpa_event> events = EventsOf(*arena);
    std::erase_if(events, [](const tpa_event& e) { return e.type != TPA_EVENT_ROLLBACK; });
    ASSERT_EQ(events.size(), report.rolled_back_vertices > 0 ? 1u : 0u);
    if (events.empty()) continue;
    ++rolled_back;
    EXPECT_EQ(events[0].amount, report.rolled_back_vertices);
    // The place is one of the surface on its way, whose vertices lie within .6 (the root of .3^2 + .3^2 + .3^2 is .52)
    // of the unit sphere, and not the zeros that an event without a place has.
    const Point where{events[0].position[0], events[0].position[1], events[0].position[2]};
    EXPECT_LT(Distance(where, {}), 1.6);
    EXPECT_GT(Distance(where, {}), 0);
  }
  EXPECT_GT(rolled_back, 0) << "nothing blocks any more: look for other seeds";
}

// Components after, by the events and those before.
int64_t ComponentsAfter(int64_t before, const std::vector<tpa_event>& events) {
  return before - Amount(events, TPA_EVENT_DEATH) + Amount(events, TPA_EVENT_BIRTH) +
         std::accumulate(events.begin(), events.end(), int64_t{0}, [](int64_t sum, const tpa_event& e) {
           const int64_t more = static_cast<int64_t>(e.amount) - 1;
           return sum + (e.type == TPA_EVENT_SPLIT ? more : e.type == TPA_EVENT_MERGE ? -more : 0);
         });
}

TEST(Step, ComponentsAreKnownFromStepToStep) {
  // What a context remembers of the components makes no difference: a copy of it forgets them (tpa_validate).
  size_t changes = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({2.4, 0, 0}, 0.9, 0.35, 12, 6), Sphere({0, 2.2, 0}, 1, 4)});
    const tpa_config config = DefaultConfig(4000);
    Arena arena(config, m);
    for (int step = 0; step < 6; ++step) {
      const Mesh before = MeshOf(*arena);
      if (before.positions.empty()) break;
      const double size = step % 2 == 0 ? 0.002 : Uniform(random, 0.05, 0.3);
      std::vector<double> targets = before.positions;
      for (double& x : targets) x = (step % 2 == 0 ? 1 : 0.9) * x + Uniform(random, -size, size);
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      Arena copy(config);
      std::memcpy(copy.block(), arena.block(), arena.size().bytes);
      auto validation = Sized<tpa_validation>();
      ASSERT_EQ(tpa_validate(*copy, nullptr, &validation, nullptr), TPA_OK);
      for (tpa_context* context : {*arena, *copy}) ASSERT_EQ(tpa_step(context, nullptr, nullptr, nullptr), TPA_OK);
      EXPECT_EQ(Observe(*arena), Observe(*copy)) << "seed " << seed << " step " << step;
      const auto parts = [](const Mesh& mesh) { return static_cast<int64_t>(TopologyOf(mesh).components.size()); };
      EXPECT_EQ(ComponentsAfter(parts(before), EventsOf(*arena)), parts(MeshOf(*arena))) << "seed " << seed << " step " << step;
      changes += EventsOf(*arena).empty() ? 0 : 1;
      auto options = Sized<tpa_remesh_options>();
      options.iterations = 1;
      options.target_length = 0.4;
      if (Uniform(random, 0, 1) < 0.3) {
        ASSERT_EQ(tpa_remesh(*arena, &options, nullptr, nullptr, nullptr), TPA_OK);
      }
    }
  }
  EXPECT_GT(changes, 20u);
}

// Of what a context keeps of its components: how many volumes are known, and within their bounds of what the mesh has.
size_t KnownVolumes(tpa_context* context, const Mesh& m) {
  tpa::Context& c = *reinterpret_cast<tpa::Context*>(context);
  const Topology topology = TopologyOf(m);
  if (!c.components_known) return 0;
  const tpa::Workspace w = tpa::open(c);
  EXPECT_EQ(w.before.list.size, topology.components.size());
  size_t known = 0;
  for (uint32_t i = 0; i < w.before.list.size; ++i) {
    const tpa::Component& part = w.before.list[i];
    EXPECT_EQ(part.id, topology.components[i].smallest_vertex);
    EXPECT_EQ(2 - 2 * topology.components[i].genus, part.euler / 2);
    if (part.volume_doubt == tpa::unknown_volume) continue;
    // The judge's sum has an error as well.
    EXPECT_NEAR(part.six_volumes, 6 * topology.components[i].volume, part.volume_doubt + 1e-11);
    EXPECT_LT(part.volume_doubt, 1e-4);
    ++known;
    for (uint32_t v = 0; v < VertexCount(m); ++v)
      if (tpa::component_of(w.before, v) == i) {
        const Point p = PositionOf(m, v), q = PositionOf(m, part.id);
        EXPECT_LE(std::fabs(p[0] - q[0]) + std::fabs(p[1] - q[1]) + std::fabs(p[2] - q[2]), part.size);
      }
  }
  return known;
}

TEST(Step, AFewThatMoveAreSeenAsInAFullDetection) {
  // A context keeps its arrangement of the mesh from step to step, through events. A copy of it forgets that
  // (tpa_smooth of nothing), and arranges anew.
  size_t quiet = 0, eventful = 0, most_contacts = 0, known_volumes = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    const Mesh m = Renumbered(
        Together({Sphere({0, 0, 0}, 1, 12), Torus({2.2, 0, 0}, 0.8, 0.25, 30, 12), Sphere({0, 2.2, 0}, 1, 10), Sphere({0, 0, 0}, .7, 8)}), random);
    const tpa_config config = DefaultConfig(3 * VertexCount(m));
    Arena arena(config, m);
    for (int step = 0; step < 30; ++step) {
      const Mesh before = MeshOf(*arena);
      const Point place = PositionOf(before, random() % VertexCount(before)), way = RandomPoint(random, -1, 1);
      const double reach = Uniform(random, .1, .4), size = step % 3 == 0 ? 1 : .05;
      std::vector<uint32_t> vertices;
      std::vector<double> targets;
      for (uint32_t v = 0; v < VertexCount(before); ++v) {
        const Point p = PositionOf(before, v);
        const double far = Distance(p, place) / reach;
        if (far >= 1) continue;
        vertices.push_back(v);
        for (size_t k = 0; k < 3; ++k) targets.push_back(p[k] + (1 - far * far) * size * way[k]);
      }
      auto move = Sized<tpa_move_input>();
      move.count = static_cast<uint32_t>(vertices.size());
      move.position_type = TPA_FLOAT64;
      move.positions = targets.data();
      move.vertices = vertices.data();
      Arena copy(config);
      std::memcpy(copy.block(), arena.block(), arena.size().bytes);
      auto nothing = Sized<tpa_smooth_options>();
      nothing.vertices = vertices.data();
      ASSERT_EQ(tpa_smooth(*copy, &nothing, nullptr, nullptr, nullptr), TPA_OK);
      tpa_report reports[2] = {Sized<tpa_report>(), Sized<tpa_report>()};
      tpa_context* const contexts[2] = {*arena, *copy};
      for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(tpa_move(contexts[i], &move, nullptr), TPA_OK);
        ASSERT_EQ(tpa_step(contexts[i], nullptr, &reports[i], nullptr), TPA_OK);
      }
      EXPECT_EQ(reports[0].contacts, reports[1].contacts) << "seed " << seed << " step " << step;
      // The epoch tells how many commits there were.
      EXPECT_EQ(MeshOf(*arena).positions, MeshOf(*copy).positions) << "seed " << seed << " step " << step;
      EXPECT_EQ(MeshOf(*arena).triangles, MeshOf(*copy).triangles) << "seed " << seed << " step " << step;
      EXPECT_EQ(OldToNewOf(*arena), OldToNewOf(*copy)) << "seed " << seed << " step " << step;
      EXPECT_EQ(TriangleOriginsOf(*arena), TriangleOriginsOf(*copy)) << "seed " << seed << " step " << step;
      ASSERT_TRUE(IsSound(MeshOf(*arena), "few-seed-" + std::to_string(seed))) << "seed " << seed << " step " << step;
      known_volumes += KnownVolumes(*arena, MeshOf(*arena));
      ++(reports[0].contacts == 0 ? quiet : eventful);
      most_contacts = std::max<size_t>(most_contacts, reports[0].contacts);
    }
  }
  EXPECT_GT(quiet, 20u);
  EXPECT_GT(eventful, 10u);
  EXPECT_GT(most_contacts, 50u);
  EXPECT_GT(known_volumes, 200u);
}

// ---------------------------------------------------------------- adapt

TEST(Adapt, TangledSpheresBecomeTheirUnion) {
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Mesh m = Together({Sphere({0, 0, 0}, 1, 6), Sphere(RandomPoint(random, -0.6, 0.6), 0.9, 6)});
    if (AllMeetingPairs(m).empty()) continue;
    Arena arena(ConfigFor(m), m);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_adapt(*arena, nullptr, &report, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    const Topology t = TopologyOf(after);
    EXPECT_EQ(t.defect, "") << "seed " << seed;
    EXPECT_EQ(report.unresolved, AllMeetingPairs(after).size()) << "seed " << seed;
    EXPECT_EQ(report.unresolved, 0u) << "seed " << seed;
    EXPECT_EQ(t.Genera(), (std::vector<int64_t>{0})) << Written(after, "adapt-seed-" + std::to_string(seed));
  }
}

TEST(Adapt, WhateverIsLeftIsCountedAndTheMeshIsAManifold) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Torus({0.8, 0, 0}, 0.9, 0.4, 12, 6)});
    const double noise = Uniform(random, 0, 0.5);
    for (double& x : m.positions) x += Uniform(random, -noise, noise);
    tpa_config config = ConfigFor(m);
    config.max_contacts = 1 << 14;
    Arena arena(config, m);
    auto report = Sized<tpa_report>();
    tpa_issue issue;
    ASSERT_EQ(tpa_adapt(*arena, nullptr, &report, &issue), TPA_OK) << "seed " << seed << ": " << Text(issue);
    const Mesh after = MeshOf(*arena);
    EXPECT_EQ(TopologyOf(after).defect, "") << "seed " << seed;
    EXPECT_EQ(report.unresolved, AllMeetingPairs(after).size())
        << "seed " << seed << "; " << Written(after, "adapt-left-seed-" + std::to_string(seed));
  }
}

// ---------------------------------------------------------------- failures

TEST(Failure, AStepOnATangledMeshNamesAPair) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 5), Sphere({1, 0.1, 0.2}, 1, 5)});
  Arena arena(ConfigFor(m), m);
  const Observed before = Observe(*arena);
  tpa_issue issue;
  const auto expect = [&](tpa_status status) {
    EXPECT_EQ(status, TPA_E_TANGLED);
    EXPECT_EQ(issue.status, TPA_E_TANGLED);
    EXPECT_TRUE(TrianglesMeet(m, static_cast<uint32_t>(issue.element), static_cast<uint32_t>(issue.other)));
    EXPECT_TRUE(Observe(*arena) == before);
  };
  expect(tpa_step(*arena, nullptr, nullptr, &issue));
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  remesh.target_length = 0.5;
  expect(tpa_remesh(*arena, &remesh, nullptr, nullptr, &issue));
  auto smooth = Sized<tpa_smooth_options>();
  smooth.iterations = 1;
  expect(tpa_smooth(*arena, &smooth, nullptr, nullptr, &issue));
}

using SetLimit = std::function<void(tpa_config&, uint32_t)>;

// Raises one limit from `least` until the call succeeds. Before that every failure names the limit, and leaves all as
// it was; at the end the result is that of ample limits.
void ExhaustLimit(int32_t limit, uint32_t least, const SetLimit& set, bool adapt) {
  // An event before, so that there are maps and events to preserve.
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 4), Sphere({1.7, 0.1, 0.2}, 1, 4), Sphere({0.9, 2.0, 0.1}, 1, 4)});
  const auto run = [&](tpa_context* context, tpa_issue* issue) {
    if (adapt) return tpa_adapt(context, nullptr, nullptr, issue);
    return tpa_step(context, nullptr, nullptr, issue);
  };
  const auto prepare = [&](Arena& arena) {
    if (adapt) {
      ASSERT_EQ(Load(*arena, m), TPA_OK);
      return;
    }
    const Mesh apart = Together({Sphere({0, 0, 0}, 1, 4), Sphere({2.1, 0.1, 0.2}, 1, 4)});
    ASSERT_EQ(Load(*arena, apart), TPA_OK);
    std::vector<double> targets = apart.positions;
    for (size_t i = 0; i < targets.size(); i += 3) targets[i] += i < targets.size() / 2 ? 0.3 : -0.3;
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  };
  tpa_config config = ConfigFor(m);
  Arena ample(config);
  prepare(ample);
  tpa_issue issue;
  ASSERT_EQ(run(*ample, &issue), TPA_OK) << Text(issue);
  const Observed expected = Observe(*ample);
  int failures = 0;
  for (uint32_t n = least; n < least + 2000; ++n) {
    config = ConfigFor(m);
    set(config, n);
    Arena arena(config);
    prepare(arena);
    if (testing::Test::HasFatalFailure()) return;
    const Observed before = Observe(*arena);
    const tpa_status status = run(*arena, &issue);
    if (status == TPA_OK) {
      EXPECT_TRUE(Observe(*arena) == expected) << "limit " << limit << " at " << n << " succeeds otherwise";
      EXPECT_GT(failures, 0) << "limit " << limit << " was never met";
      return;
    }
    ++failures;
    ASSERT_EQ(status, TPA_E_LIMIT) << Text(issue);
    ASSERT_EQ(issue.limit, limit) << Text(issue);
    EXPECT_EQ(issue.available, n) << Text(issue);
    EXPECT_GT(issue.needed, n) << Text(issue);
    ASSERT_TRUE(Observe(*arena) == before) << "limit " << limit << " at " << n;
    // Targets are kept: the same call fails the same way.
    tpa_issue again;
    EXPECT_EQ(run(*arena, &again), status);
    EXPECT_EQ(again.needed, issue.needed);
    ASSERT_TRUE(Observe(*arena) == before) << "limit " << limit << " at " << n;
  }
  FAIL() << "limit " << limit << " of " << least + 2000 << " is still too low";
}

class Exhausting : public testing::TestWithParam<bool> {};

TEST_P(Exhausting, Contacts) {
  ExhaustLimit(TPA_LIMIT_CONTACTS, 1, [](tpa_config& c, uint32_t n) { c.max_contacts = n; }, GetParam());
}
TEST_P(Exhausting, CutEdges) {
  ExhaustLimit(TPA_LIMIT_CUT, 3, [](tpa_config& c, uint32_t n) { c.max_cut_edges = n; }, GetParam());
}
TEST_P(Exhausting, Vertices) {
  const uint32_t loaded = (GetParam() ? 3 : 2) * VertexCount(Sphere({0, 0, 0}, 1, 4));
  ExhaustLimit(TPA_LIMIT_VERTICES, loaded,
               [](tpa_config& c, uint32_t n) {
                 const tpa_config ample = c;
                 c.max_vertices = n;
                 // The other limits stay as ample as they were.
                 c.max_triangles = 2 * ample.max_vertices + 1024;
                 c.max_contacts = ample.max_vertices / 2 + 1024;
                 c.max_cut_edges = ample.max_vertices / 4 + 1024;
                 c.max_events = ample.max_vertices / 64 + 256;
               },
               GetParam());
}
TEST_P(Exhausting, Triangles) {
  const uint32_t loaded = (GetParam() ? 3 : 2) * TriangleCount(Sphere({0, 0, 0}, 1, 4));
  ExhaustLimit(TPA_LIMIT_TRIANGLES, loaded, [](tpa_config& c, uint32_t n) { c.max_triangles = n; }, GetParam());
}

TEST_P(Exhausting, Events) {
  ExhaustLimit(TPA_LIMIT_EVENTS, 1, [](tpa_config& c, uint32_t n) { c.max_events = n; }, GetParam());
}

INSTANTIATE_TEST_SUITE_P(StepAndAdapt, Exhausting, testing::Bool(),
                         [](const auto& given) { return given.param ? "adapt" : "step"; });

TEST(Failure, TargetsSurviveAndCanBeCorrected) {
  const Mesh m = Together({Sphere({0, 0, 0}, 1, 5), Sphere({2.3, 0.1, 0}, 1, 5)});
  tpa_config config = ConfigFor(m);
  config.max_contacts = 1;
  Arena arena(config, m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); i += 3) targets[i] += i < targets.size() / 2 ? 0.2 : -0.2;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_E_LIMIT);
  // The first sphere goes back where it is; the second one's targets still stand.
  auto move = Sized<tpa_move_input>();
  move.count = VertexCount(m) / 2;
  move.position_type = TPA_FLOAT64;
  move.positions = m.positions.data();
  ASSERT_EQ(tpa_move(*arena, &move, nullptr), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
  const Mesh after = MeshOf(*arena);
  for (size_t i = m.positions.size() / 2; i < m.positions.size(); i += 3)
    EXPECT_EQ(after.positions[i], m.positions[i] - 0.2);
}

}  // namespace
