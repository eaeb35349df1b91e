// SPDX-License-Identifier: MIT
#include "support/step_scenes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "tool/scenes/elementary.h"

namespace support {

Scene TwoSpheres(double overlap, int fineness) {
  return {"two-spheres",
          Together({Sphere({-1.1, 0, 0}, 1, fineness), Sphere({1.1, 0.07, 0.03}, 1, fineness)}),
          [=](const Point& p) {
            return Point{p[0] + (p[0] < 0 ? 1 : -1) * (0.1 + overlap), p[1], p[2]};
          },
          1,
          {0}};
}

Scene Dumbbell() {
  std::vector<Point> points;
  std::vector<double> radii;
  for (int i = 0; i <= 24; ++i) {
    const double x = -3 + 0.25 * i;
    points.push_back({x, 0.01, 0.02});
    radii.push_back(0.3 + 0.7 * std::min(1.0, std::fabs(x) / 2));
  }
  return {"dumbbell",
          Tube(points, radii, 12, {0.1, 0.2, 1}),
          [](const Point& p) {
            const double s = std::fabs(p[0]) < 0.6 ? 0.08 : 0, r = std::sqrt(p[1] * p[1] + p[2] * p[2]);
            return r == 0 ? p : Point{p[0], p[1] * (1 - s / r), p[2] * (1 - s / r)};
          },
          12,
          {0, 0}};
}

Scene ClosingRing() {
  std::vector<Point> points;
  for (int i = 0; i <= 40; ++i) {
    const double a = 0.35 + (2 * pi - 0.7) * i / 40;
    points.push_back({3 * tool::cosine(a), 3 * tool::sine(a), 0});
  }
  return {"closing-ring",
          Tube(points, std::vector<double>(points.size(), 0.6), 10, {0, 0, 1}),
          [](const Point& p) {
            const double r = std::sqrt(p[0] * p[0] + p[1] * p[1]);
            const double a = tool::arc_tangent(-p[1], -p[0]) * 1.03 + pi;
            return Point{r * tool::cosine(a), r * tool::sine(a), p[2]};
          },
          10,
          {1}};
}

namespace {

// A sphere drawn out to a spindle whose tip almost reaches the origin from the given direction.
Mesh Spindle(const Point& direction) {
  Mesh m = Sphere({0, 0, 0}, 0.5, 14);
  const Point d = Unit(direction);
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = PositionOf(m, v), q = Sum(p, Scaled(3 * Dot(p, d) + 2.1, d));
    for (size_t i = 0; i < 3; ++i) m.positions[3 * v + i] = q[i];
  }
  return m;
}

Scene Meeting(const char* name, const std::vector<Point>& directions) {
  std::vector<Mesh> parts;
  for (const Point& d : directions) parts.push_back(Spindle(d));
  const auto inward = [=](const Point& p) {
    Point best{};
    double most = -1;
    for (const Point& d : directions) {
      const Point u = Unit(d);
      if (Dot(p, u) > most) {
        most = Dot(p, u);
        best = u;
      }
    }
    return Sum(p, Scaled(-0.3, best));
  };
  return {name, Together(parts), inward, 1, {0}};
}

}  // namespace

Scene ThreeSpindles() { return Meeting("three-spindles", {{1, 0.02, 0}, {-0.5, 0.87, 0.01}, {-0.5, -0.86, 0.03}}); }
Scene FourInACross() {
  return Meeting("four-in-a-cross", {{1, 0.02, 0.01}, {-0.02, 1, 0.02}, {-1, 0.01, -0.02}, {0.01, -1, 0.02}});
}
Scene FourTetrahedral() {
  return Meeting("four-tetrahedral", {{1, 1, 1.02}, {1, -1, -1}, {-1, 1.01, -1}, {-1, -1, 1}});
}

std::vector<Scene> AllScenes() {
  return {TwoSpheres(0.08), TwoSpheres(0.6), Dumbbell(),       ClosingRing(),
          ThreeSpindles(),  FourInACross(),  FourTetrahedral()};
}

Scene Turned(Scene s, int rotation) {
  s.mesh = QuarterTurned(s.mesh, rotation);
  // The way back, by trying.
  int back = 0;
  const Point probe{1, 2, 3};
  while (QuarterTurned(QuarterTurned(probe, rotation), back) != probe) ++back;
  s.target = [=, target = s.target](const Point& p) { return QuarterTurned(target(QuarterTurned(p, back)), rotation); };
  return s;
}

std::vector<double> ShakenTargets(const Mesh& m, double most, Random& random) {
  std::vector<double> targets = m.positions;
  for (double& x : targets) x += Uniform(random, -most, most);
  return targets;
}

std::vector<double> CoincidingTargets(const Mesh& m, Random& random) {
  std::vector<double> targets = ShakenTargets(m, 0.3, random);
  for (double& x : targets) x = 0.2 * std::floor(x / 0.2 + 0.5);
  for (size_t i = 0; i < targets.size(); i += 3) {
    const double x = 0.8 * targets[i] - 0.6 * targets[i + 1], y = 0.6 * targets[i] + 0.8 * targets[i + 1];
    const double z = targets[i + 2];
    targets[i] = 1.1 * x, targets[i + 1] = 1.1 * (0.28 * y - 0.96 * z), targets[i + 2] = 1.1 * (0.96 * y + 0.28 * z);
  }
  return targets;
}

std::vector<double> TargetsOf(const Mesh& m, const std::function<Point(const Point&)>& target) {
  std::vector<double> targets;
  for (size_t v = 0; v < VertexCount(m); ++v) {
    const Point p = target(PositionOf(m, v));
    targets.insert(targets.end(), p.begin(), p.end());
  }
  return targets;
}

namespace {

struct Maps {
  std::vector<uint32_t> old_to_new, faces;
  std::vector<tpa_vertex_origin> origins;
};

void ExpectInverse(const Maps& maps) {
  for (uint32_t n = 0; n < maps.origins.size(); ++n) {
    const tpa_vertex_origin& o = maps.origins[n];
    ASSERT_LT(o.parents[0], maps.old_to_new.size());
    ASSERT_TRUE(o.weight >= 0 && o.weight <= 1);
    if (o.parents[1] == TPA_NONE) {
      EXPECT_EQ(o.weight, 1.0f);
      EXPECT_EQ(maps.old_to_new[o.parents[0]], n);
    } else {
      ASSERT_LT(o.parents[1], maps.old_to_new.size());
    }
  }
  for (uint32_t v = 0; v < maps.old_to_new.size(); ++v) {
    if (maps.old_to_new[v] == TPA_NONE) continue;
    ASSERT_LT(maps.old_to_new[v], maps.origins.size());
    EXPECT_EQ(maps.origins[maps.old_to_new[v]].parents[0], v);
    EXPECT_EQ(maps.origins[maps.old_to_new[v]].parents[1], TPA_NONE);
  }
}

double LargestEdge(const Mesh& m) {
  double largest = 0;
  for (size_t f = 0; f < TriangleCount(m); ++f)
    for (size_t i = 0; i < 3; ++i)
      largest = std::max(
          largest, Distance(PositionOf(m, m.triangles[3 * f + i]), PositionOf(m, m.triangles[3 * f + (i + 1) % 3])));
  return largest;
}

// The reach of smoothing: new vertices, corners of new triangles, and two rings round them.
std::set<uint32_t> NearNew(const Mesh& after, const Maps& maps) {
  std::set<uint32_t> near;
  for (uint32_t n = 0; n < maps.origins.size(); ++n)
    if (maps.origins[n].parents[1] != TPA_NONE) near.insert(n);
  for (uint32_t f = 0; f < maps.faces.size(); ++f)
    for (size_t i = 0; i < 3 && maps.faces[f] == TPA_NONE; ++i) near.insert(after.triangles[3 * f + i]);
  for (int ring = 0; ring < 2; ++ring) {
    std::set<uint32_t> grown = near;
    for (auto f = after.triangles.begin(); f != after.triangles.end(); f += 3)
      if (std::any_of(f, f + 3, [&](uint32_t v) { return near.count(v) != 0; })) grown.insert(f, f + 3);
    near = grown;
  }
  return near;
}

// P4: away from the events the targets' bits are kept.
void ExpectArrived(tpa_context* context, const Mesh& before, const Mesh& after, const Maps& maps,
                   const std::vector<double>& targets) {
  const std::set<uint32_t> near_new = NearNew(after, maps);
  const double largest_edge = LargestEdge(after);
  const uint32_t* rolled_back = nullptr;
  uint32_t rolled_back_count = 0;
  ASSERT_EQ(tpa_rolled_back(context, &rolled_back, &rolled_back_count), TPA_OK);
  const std::set<uint32_t> stayed(rolled_back, rolled_back + rolled_back_count);
  const auto target = [&](uint32_t v) { return Point{targets[3 * v], targets[3 * v + 1], targets[3 * v + 2]}; };
  for (uint32_t n = 0; n < maps.origins.size(); ++n) {
    const tpa_vertex_origin& o = maps.origins[n];
    const Point p = PositionOf(after, n);
    if (o.parents[1] == TPA_NONE) {
      if (near_new.count(n) != 0) continue;
      const bool refused = stayed.count(n) != 0;
      EXPECT_EQ(p, refused ? PositionOf(before, o.parents[0]) : target(o.parents[0])) << "vertex " << n;
    } else {
      const double w = static_cast<double>(o.weight);
      const Point mean = Sum(Scaled(w, target(o.parents[0])), Scaled(1 - w, target(o.parents[1])));
      EXPECT_LT(Distance(p, mean), 2 * largest_edge) << "new vertex " << n;
    }
  }
}

// A triangle with its three old corners is the old triangle.
void ExpectOldTriangles(const Mesh& before, const Mesh& after, const Maps& maps) {
  for (uint32_t f = 0; f < maps.faces.size(); ++f) {
    if (maps.faces[f] == TPA_NONE) continue;
    ASSERT_LT(maps.faces[f], TriangleCount(before));
    std::set<uint32_t> now, then;
    bool whole = true;
    for (size_t i = 0; i < 3; ++i) {
      const tpa_vertex_origin& o = maps.origins[after.triangles[3 * f + i]];
      whole = whole && o.parents[1] == TPA_NONE;
      now.insert(o.parents[0]);
      then.insert(before.triangles[3 * maps.faces[f] + i]);
    }
    if (whole) {
      EXPECT_EQ(now, then) << "triangle " << f;
    }
  }
}

}  // namespace

void ExpectConsistentMaps(tpa_context* context, const Mesh& before, const std::vector<double>& targets) {
  const Mesh after = MeshOf(context);
  const Maps maps{OldToNewOf(context), TriangleOriginsOf(context), VertexOriginsOf(context)};
  ASSERT_EQ(maps.old_to_new.size(), VertexCount(before));
  ASSERT_EQ(maps.origins.size(), VertexCount(after));
  ASSERT_EQ(maps.faces.size(), TriangleCount(after));
  ASSERT_NO_FATAL_FAILURE(ExpectInverse(maps));
  ASSERT_NO_FATAL_FAILURE(ExpectArrived(context, before, after, maps, targets));
  ExpectOldTriangles(before, after, maps);
}

Played PlayToTheEnd(const Scene& s, const std::string& name, const tpa_config* config) {
  Arena arena(config != nullptr ? *config : ConfigFor(s.mesh), s.mesh);
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

uint32_t Amount(const std::vector<tpa_event>& events, int32_t type) {
  uint32_t sum = 0;
  for (const tpa_event& e : events) sum += e.type == type ? e.amount : 0;
  return sum;
}
int64_t ComponentsMade(const std::vector<tpa_event>& events) {
  int64_t made = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    const int64_t amount = events[i].amount;
    if (events[i].type == TPA_EVENT_MERGE) made -= amount - 1;
    if (events[i].type == TPA_EVENT_DEATH) made -= amount;
    if (events[i].type != TPA_EVENT_SPLIT) continue;
    made += amount - 1;
    // An event for each piece, in a row.
    for (const size_t first = i; i + 1 < first + events[first].amount; ++i) {
      if (i + 1 < events.size() && events[i + 1].type == TPA_EVENT_SPLIT && events[i + 1].amount == amount) continue;
      ADD_FAILURE() << "a split without an event for each piece";
      return made;
    }
  }
  return made;
}
bool Has(const std::vector<tpa_event>& events, int32_t type, uint32_t amount) {
  return std::any_of(events.begin(), events.end(),
                     [&](const tpa_event& e) { return e.type == type && e.amount == amount; });
}

}  // namespace support
