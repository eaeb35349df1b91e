// SPDX-License-Identifier: MIT
// Triangulations of points in a plane with segments to keep, against brute force in fractions of integers. A failure
// prints the seed and the number of the case.
#include "arrangement/planar_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "oracle/lattice_points.h"
#include "oracle/rational.h"
#include "support/share.h"

namespace planar_map_test {
namespace {

using namespace big_int;
using lattice_points::Random;
using lattice_points::seed;
using support::Least;
using support::Share;
using tpa::none;
using tpa::u32;
using tpa::Vec3;

constexpr u32 capacity = 2048;

// The coordinates of points in their plane, as the axis of the map shows them.
struct Flat {
  Rational u, v;
};
int compare(const Flat& a, const Flat& b) {
  const int order = compare(a.u, b.u);
  return order != 0 ? order : compare(a.v, b.v);
}
struct FlatLess {
  bool operator()(const Flat& a, const Flat& b) const { return compare(a, b) < 0; }
};
Flat operator-(const Flat& a, const Flat& b) { return {a.u - b.u, a.v - b.v}; }
Rational cross(const Flat& a, const Flat& b) { return a.u * b.v - a.v * b.u; }
Rational area(const Flat& a, const Flat& b, const Flat& c) { return cross(b - a, c - a); }
int side(const Flat& a, const Flat& b, const Flat& c) { return area(a, b, c).sign(); }
bool is_between(const Flat& a, const Flat& b, const Flat& x) {
  return side(a, b, x) == 0 && compare(a, x) * compare(b, x) < 0;
}
bool cross_inside(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

using Segment = std::array<u32, 2>;

// Different points of a plane as vertices of a mesh, and segments between them as first edges of faces that leave the
// plane. Face 0 lies in the plane.
struct Scene {
  std::vector<Vec3> position;
  std::vector<u32> corner;
  std::vector<Segment> segments;  // of segment i: half-edge 3 (i + 1)
  u32 count = 0;                  // of the points
  u32 axis = 0;

  static double Number(Random& random, int kind) {
    if (kind == 0) return static_cast<double>(random.upto(4));
    if (kind == 1) return static_cast<double>(random.within(1 << 20));
    if (kind == 2) return random.unit() - 0.5;
    return 1 + 0x1p-52 * static_cast<double>(random.upto(40));
  }
  Vec3 Turned(double u, double v, double w) const {
    Vec3 p;
    p[static_cast<int>((axis + 1) % 3)] = u, p[static_cast<int>((axis + 2) % 3)] = v, p[static_cast<int>(axis)] = w;
    return p;
  }
  // Whole coordinates in a slanted plane; or any coordinates, or few ulps apart, in a plane square to the axis.
  Scene(Random& random, int kind, u32 points, u32 wanted_segments) : axis(static_cast<u32>(random.upto(2))) {
    const bool slanted = kind < 2 && random.upto(1) != 0;
    std::set<std::array<double, 2>> seen;
    while (position.size() < points) {
      const double u = Number(random, kind), v = kind == 2 && random.upto(9) == 0 ? 0.25 : Number(random, kind);
      if (seen.insert({u, v}).second) position.push_back(Turned(u, v, slanted ? 2 * u - v : 3));
    }
    count = points;
    u32 apex = 2;
    while (apex < count && At(0, 1, apex) == 0) ++apex;
    if (apex == count) return;  // all on a line
    corner = {0, 1, apex};
    position.push_back(position[0]);
    position[count][static_cast<int>(axis)] += 1;
    while (segments.size() < wanted_segments) {
      const auto p = static_cast<u32>(random.upto(count - 1)), q = static_cast<u32>(random.upto(count - 1));
      if (p == q) continue;
      segments.push_back({p, q});
      corner.insert(corner.end(), {p, q, count});
    }
  }
  int At(u32 a, u32 b, u32 c) const { return side(FlatOf(a), FlatOf(b), FlatOf(c)); }
  Flat FlatOf(u32 p) const {
    return {Rational(position[p][static_cast<int>((axis + 1) % 3)]),
            Rational(position[p][static_cast<int>((axis + 2) % 3)])};
  }
};

// A map with its memory.
struct Map {
  std::vector<tpa::ArrangementPoint> list{capacity};
  std::vector<u32> slots, origin_slots, vertex, leaving, after, before, corner, opposite, trace, work;
  std::vector<tpa::u8> mark;
  tpa::Mesh mesh;
  tpa::ArrangementPoints points{};
  tpa::PlanarMap map{};
  std::vector<tpa::Trace> traces;

  explicit Map(Scene& scene)
      : slots(tpa::point_hash_slots(capacity)),
        origin_slots(tpa::point_hash_slots(capacity)),
        vertex(capacity),
        leaving(capacity),
        after(capacity),
        before(capacity),
        corner(6 * capacity),
        opposite(6 * capacity),
        trace(6 * capacity),
        work(6 * capacity),
        mark(2 * capacity) {
    mesh.position = scene.position.data();
    mesh.corner = scene.corner.data();
    points.mesh = &mesh;
    points.list = {list.data(), capacity, 0};
    points.by_position = {slots.data(), static_cast<u32>(slots.size())};
    points.by_origin = {origin_slots.data(), static_cast<u32>(origin_slots.size())};
    clear(points);
    map.points = &points;
    map.plane = tpa::plane_of_face(0);
    map.axis = scene.axis;
    map.vertex = {vertex.data(), capacity, 0};
    map.corner = {corner.data(), 6 * capacity, 0};
    map.work = {work.data(), 6 * capacity, 0};
    map.leaving = leaving.data(), map.after = after.data(), map.before = before.data();
    map.opposite = opposite.data(), map.trace = trace.data(), map.mark = mark.data();
    for (u32 v = 0; v < scene.count; ++v) map.vertex.push(add_vertex_point(points, v));
    for (u32 i = 0; i < scene.segments.size(); ++i) {
      const tpa::PlaneRef upright{3 * (i + 1), scene.axis}, other = i % 2 == 0 ? upright : tpa::plane_of_face(i + 1);
      traces.push_back({0, other, scene.segments[i][0], scene.segments[i][1]});
    }
  }
  Map(const Map&) = delete;  // the map points into the vectors

  u32 Place(u32 point) const {
    return static_cast<u32>(std::find(map.vertex.begin(), map.vertex.end(), point) - map.vertex.begin());
  }
  bool Keep(u32 i) {
    const Segment at{Place(traces[i].p), Place(traces[i].q)};
    return keep_segment(map, at[0], at[1], i, {traces.data(), static_cast<u32>(traces.size())});
  }
};

// ---------------------------------------------------------------- brute force

Rational hull_area(std::vector<Flat> points) {
  std::sort(points.begin(), points.end(), FlatLess());
  std::vector<Flat> hull;
  for (int round = 0; round < 2; ++round, std::reverse(points.begin(), points.end())) {
    const size_t first = hull.size();
    for (const Flat& p : points) {
      while (hull.size() >= first + 2 && side(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
  }
  Rational sum;
  for (size_t i = 1; i + 1 < hull.size(); ++i) sum = sum + area(hull[0], hull[i], hull[i + 1]);
  return sum;
}

// All points, and the points where segments cross.
std::set<Flat, FlatLess> crossings_and_points(const Scene& scene) {
  std::set<Flat, FlatLess> out;
  for (u32 p = 0; p < scene.count; ++p) out.insert(scene.FlatOf(p));
  for (size_t i = 0; i < scene.segments.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      const Flat a = scene.FlatOf(scene.segments[i][0]), b = scene.FlatOf(scene.segments[i][1]);
      const Flat c = scene.FlatOf(scene.segments[k][0]), d = scene.FlatOf(scene.segments[k][1]);
      if (!cross_inside(a, b, c, d)) continue;
      const Rational t = area(c, d, a) / (area(c, d, a) - area(c, d, b));
      out.insert({a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)});
    }
  return out;
}

// The vertices of the map, by the planes that make them.
std::vector<Flat> vertices_of(const Map& m, const Scene& scene) {
  const auto at = [&](u32 h) { return scene.position[scene.corner[h]]; };
  const auto plane = [&](const tpa::ArrangementPoint& p, size_t i) {
    const u32 id = p.id[i], axis = p.axis[i];
    return axis == tpa::of_face ? plane_through(at(3 * id), at(3 * id + 1), at(3 * id + 2))
                                : plane_along(at(id), at(tpa::next_edge(id)), axis);
  };
  std::vector<Flat> out;
  for (u32 number : m.map.vertex) {
    const tpa::ArrangementPoint& p = m.list[number];
    RationalPoint x = rational(p.at);
    if (p.kind != tpa::PointKind::vertex) {
      EXPECT_TRUE(planes_meet(plane(p, 0), plane(p, 1), plane(p, 2), x));
    }
    out.push_back({x[(scene.axis + 1) % 3], x[(scene.axis + 2) % 3]});
  }
  return out;
}

// Triangles, counter-clockwise, that fill the hull once, joined in both directions.
void expect_triangulation(const Map& m, const std::vector<Flat>& at) {
  Rational sum;
  std::map<std::array<u32, 2>, u32> edges;
  const u32 half_edges = m.map.corner.size;
  std::vector<bool> used(at.size(), false);
  for (u32 h = 0; h < half_edges; ++h) {
    const std::array<u32, 2> edge{m.map.corner[h], m.map.corner[tpa::next_edge(h)]};
    EXPECT_TRUE(edges.emplace(edge, h).second) << "an edge twice";
    used[edge[0]] = true;
    if (h % 3 != 0) continue;
    const Rational twice = area(at[edge[0]], at[edge[1]], at[m.map.corner[h + 2]]);
    EXPECT_GT(twice.sign(), 0);
    sum = sum + twice;
  }
  EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool b) { return b; }));
  EXPECT_EQ(compare(sum, hull_area(at)), 0);
  for (const auto& [edge, h] : edges) {
    const auto back = edges.find({edge[1], edge[0]});
    EXPECT_EQ(m.map.opposite[h], back == edges.end() ? none : back->second);
    if (back != edges.end()) {
      EXPECT_EQ(m.map.trace[h], m.map.trace[back->second]);
    }
    EXPECT_EQ(m.map.mark[h / 3], 0);
  }
  for (u32 v = 0; v < at.size(); ++v) EXPECT_EQ(m.map.corner[m.map.leaving[v]], v);
}

// Each segment is a chain of kept edges, and kept edges belong to their segments.
void expect_kept(const Map& m, const Scene& scene, const std::vector<Flat>& at) {
  std::set<std::array<u32, 2>> kept;
  for (u32 h = 0; h < m.map.corner.size; ++h) {
    if (m.map.trace[h] == none) continue;
    const u32 p = m.map.corner[h], q = m.map.corner[tpa::next_edge(h)];
    kept.insert({std::min(p, q), std::max(p, q)});
    const Segment& s = scene.segments[m.map.trace[h]];
    const Flat a = scene.FlatOf(s[0]), b = scene.FlatOf(s[1]);
    EXPECT_TRUE(side(a, b, at[p]) == 0 && side(a, b, at[q]) == 0);
    const Flat middle{(at[p].u + at[q].u) * Rational(0.5), (at[p].v + at[q].v) * Rational(0.5)};
    EXPECT_TRUE(is_between(a, b, middle));
  }
  std::set<std::array<u32, 2>> wanted;
  for (const Segment& s : scene.segments) {
    const Flat a = scene.FlatOf(s[0]), b = scene.FlatOf(s[1]);
    std::vector<u32> chain;
    for (u32 v = 0; v < at.size(); ++v)
      if (compare(a, at[v]) == 0 || compare(b, at[v]) == 0 || is_between(a, b, at[v])) chain.push_back(v);
    std::sort(chain.begin(), chain.end(), [&](u32 p, u32 q) { return compare(at[p], at[q]) < 0; });
    for (size_t i = 0; i + 1 < chain.size(); ++i)
      wanted.insert({std::min(chain[i], chain[i + 1]), std::max(chain[i], chain[i + 1])});
  }
  EXPECT_EQ(kept, wanted);
  for (const auto& e : kept)
    for (const auto& f : kept) {
      if (f >= e) break;
      EXPECT_FALSE(cross_inside(at[e[0]], at[e[1]], at[f[0]], at[f[1]]));
    }
}

struct Size {
  u32 points, segments;
};

TEST(PlanarMap, KeepsSegmentsAndTheirCrossings) {
  Random random;
  int crossed = 0, played = 0;
  const Size sizes[] = {{3, 3}, {6, 8}, {12, 6}, {16, 16}, {20, 30}};
  for (int i = 0; i < Share(60); ++i) {
    const int kind = i % 4;
    const Size& size = sizes[i / 4 % 5];
    Scene scene(random, kind, size.points, kind % 3 == 0 ? size.segments : std::min(size.segments, 16u));
    if (scene.corner.empty()) continue;
    SCOPED_TRACE("seed " + std::to_string(seed) + " case " + std::to_string(i));
    Map m(scene);
    std::vector<Flat> given;
    tpa::triangulate(m.map);
    for (u32 point : m.map.vertex) given.push_back(scene.FlatOf(point));
    EXPECT_TRUE(std::is_sorted(given.begin(), given.end(), FlatLess()));
    expect_triangulation(m, given);
    if (i % 2 == 0) make_even(m.map);
    if (i % 2 == 0) expect_triangulation(m, given);
    const std::set<Flat, FlatLess> expected = crossings_and_points(scene);
    for (u32 k = 0; k < scene.segments.size(); ++k) EXPECT_TRUE(m.Keep(k));
    ASSERT_EQ(m.map.vertex.size, expected.size());
    const std::vector<Flat> at = vertices_of(m, scene);
    const std::set<Flat, FlatLess> found(at.begin(), at.end());
    EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                           [](const Flat& a, const Flat& b) { return compare(a, b) == 0; }));
    expect_triangulation(m, at);
    expect_kept(m, scene, at);
    make_even(m.map);
    expect_triangulation(m, at);
    expect_kept(m, scene, at);
    for (const Segment& s : scene.segments) {
      const u32 h = edge_towards(m.map, m.Place(s[0]), m.Place(s[1]));
      // On the rim of the hull, one of the two directions has no triangle on its left.
      const bool on_rim = std::none_of(
          at.begin(), at.end(), [&](const Flat& x) { return side(scene.FlatOf(s[0]), scene.FlatOf(s[1]), x) > 0; });
      EXPECT_EQ(h == none, on_rim);
      if (h == none) continue;
      EXPECT_NE(m.map.trace[h], none);
      EXPECT_EQ(m.map.vertex[m.map.corner[h]], s[0]);
    }
    crossed += static_cast<int>(expected.size() - scene.count);
    ++played;
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(crossed, Least(150));
  EXPECT_GT(played, Least(30));
}

// Flips on a grid: no vertex across an edge lies clearly within the circle of the triangle on this side.
TEST(PlanarMap, IsDelaunayWhereNothingIsKept) {
  Random random;
  for (int i = 0; i < Share(40); ++i) {
    Scene scene(random, 1, 40, 0);
    if (scene.corner.empty()) continue;
    for (Vec3& p : scene.position) p[static_cast<int>(scene.axis)] = 0;
    Map m(scene);
    tpa::triangulate(m.map);
    make_even(m.map);
    const auto at = [&](u32 h) {
      const Vec3& p = scene.position[m.map.vertex[m.map.corner[h]]];
      return std::array<double, 2>{p[static_cast<int>((scene.axis + 1) % 3)],
                                   p[static_cast<int>((scene.axis + 2) % 3)]};
    };
    for (u32 h = 0; h < m.map.corner.size; ++h) {
      const u32 g = m.map.opposite[h];
      if (g == none) continue;
      // The sum of the angles across from the edge is at most half a turn.
      double sum = 0;
      for (u32 e : {h, g}) {
        const auto a = at(e), b = at(tpa::next_edge(e)), c = at(tpa::previous_edge(e));
        const double x[2] = {a[0] - c[0], a[1] - c[1]}, y[2] = {b[0] - c[0], b[1] - c[1]};
        sum += std::atan2(x[0] * y[1] - x[1] * y[0], x[0] * y[0] + x[1] * y[1]);
      }
      EXPECT_LE(sum, 3.14159265358979 + 1e-5);
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
}

// Crossings of segments between points a few ulps apart: angles by rounded coordinates are wrong, exact turns hold.
TEST(PlanarMap, StaysValidWhereRoundedAnglesLie) {
  Random random;
  for (int i = 0; i < Share(150); ++i) {
    Scene scene(random, 3, 8, 10);
    if (scene.corner.empty()) continue;
    Map m(scene);
    tpa::triangulate(m.map);
    make_even(m.map);
    for (u32 k = 0; k < scene.segments.size(); ++k) EXPECT_TRUE(m.Keep(k));
    make_even(m.map);
    expect_triangulation(m, vertices_of(m, scene));
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
}

TEST(PlanarMap, SaysThatPointsRanOut) {
  Random random;
  Scene scene(random, 2, 25, 20);
  Map m(scene);
  tpa::triangulate(m.map);
  const size_t crossings = crossings_and_points(scene).size() - scene.count;
  ASSERT_GT(crossings, 2u);
  m.map.vertex.capacity = scene.count + static_cast<u32>(crossings) - 1;
  bool fits = true;
  for (u32 k = 0; k < scene.segments.size() && fits; ++k) fits = m.Keep(k);
  EXPECT_FALSE(fits);
}

// A map is made again with the scratch memory that it told, and not with less.
TEST(PlanarMap, TellsTheScratchThatItNeeds) {
  Random random;
  const auto keeps_all = [](Scene& scene, u32 words, u32& needed) {
    Map m(scene);
    tpa::triangulate(m.map);
    m.map.work.capacity = words;
    bool fits = true;
    for (u32 k = 0; k < scene.segments.size() && fits; ++k) fits = m.Keep(k);
    needed = m.map.most_work;
    return fits;
  };
  for (int i = 0; i < Share(8); ++i) {
    Scene scene(random, 2, 25, 5);
    u32 needed = 0, again = 0;
    ASSERT_TRUE(keeps_all(scene, 6 * capacity, needed));
    ASSERT_GT(needed, 0u);
    EXPECT_TRUE(keeps_all(scene, needed, again)) << "seed " << seed << " case " << i;
    EXPECT_EQ(again, needed);
    EXPECT_FALSE(keeps_all(scene, needed - 1, again)) << "seed " << seed << " case " << i;
  }
}

}  // namespace
}  // namespace planar_map_test
