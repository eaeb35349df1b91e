// SPDX-License-Identifier: MIT
// Polygons cut into triangles. Corners lie on a grid of whole numbers and are turned in space before the cut; the
// oracle adds up areas in whole numbers on the grid.
#include "tool/io/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>

#include "tool/io/polygon_mesh.h"

namespace tool {
namespace polygon_test {
namespace {

struct GridPoint {
  int64_t x = 0, y = 0;
  auto operator<=>(const GridPoint&) const = default;
};
using Polygon = std::vector<GridPoint>;

int64_t TwiceArea(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

int64_t TwiceArea(const Polygon& p) {
  int64_t sum = 0;
  for (size_t i = 0; i < p.size(); ++i) sum += TwiceArea({0, 0}, p[i], p[(i + 1) % p.size()]);
  return sum;
}

std::string Text(const Polygon& p) {
  std::string text;
  for (const GridPoint& q : p) text += "(" + std::to_string(q.x) + "," + std::to_string(q.y) + ") ";
  return text;
}

// Where the grid lies in space.
struct Placing {
  std::array<double, 3> origin{0, 0, 0}, across{1, 0, 0}, up{0, 1, 0};
  double bulge = 0;  // height of a saddle, as a part of its width
};

Placing Turned(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Placing p;
  for (double& x : p.origin) x = 3 * normal(random);
  std::array<double, 3> u{normal(random), normal(random), normal(random)}, v = u;
  double length = std::hypot(u[0], u[1], u[2]);
  for (double& x : u) x /= length;
  for (double& x : v) x = normal(random);
  const double along = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  for (size_t i = 0; i < 3; ++i) v[i] -= along * u[i];
  length = std::hypot(v[0], v[1], v[2]);
  for (double& x : v) x /= length;
  const double scale = std::exp(2 * normal(random));
  for (size_t i = 0; i < 3; ++i) p.across[i] = scale * u[i], p.up[i] = scale * v[i];
  return p;
}

std::vector<double> Placed(const Polygon& polygon, const Placing& p) {
  const std::array<double, 3>&u = p.across, &v = p.up;
  const std::array<double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double size = std::hypot(n[0], n[1], n[2]);
  std::vector<double> corners;
  for (const GridPoint& q : polygon) {
    const auto x = static_cast<double>(q.x), y = static_cast<double>(q.y);
    for (size_t i = 0; i < 3; ++i)
      corners.push_back(p.origin[i] + x * u[i] + y * v[i] + p.bulge * (x * y / 100) * n[i] / std::sqrt(size));
  }
  return corners;
}

std::vector<uint32_t> Cut(const std::vector<double>& corners) {
  std::vector<uint32_t> triangles;
  triangulate(corners, triangles);
  return triangles;
}

// Triangles of area `least` or more each, that together cover the polygon. Sides occur once, diagonals twice.
void ExpectCut(const Polygon& polygon, const std::vector<uint32_t>& t, int64_t least, const std::string& what) {
  SCOPED_TRACE(what + ": " + Text(polygon));
  const auto n = static_cast<uint32_t>(polygon.size());
  ASSERT_EQ(t.size(), 3 * (size_t{n} - 2));
  int64_t sum = 0;
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (size_t f = 0; f < t.size(); f += 3) {
    for (size_t i = 0; i < 3; ++i) ASSERT_LT(t[f + i], n);
    const int64_t area = TwiceArea(polygon[t[f]], polygon[t[f + 1]], polygon[t[f + 2]]);
    EXPECT_GE(area, least) << t[f] << " " << t[f + 1] << " " << t[f + 2];
    sum += std::abs(area);
    for (size_t i = 0; i < 3; ++i) ++uses[{t[f + i], t[f + (i + 1) % 3]}];
  }
  EXPECT_EQ(sum, TwiceArea(polygon));
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    const bool is_side = (edge.first + 1) % n == edge.second;
    EXPECT_NE(is_side, uses.count({edge.second, edge.first}) != 0);
  }
}

// As it lies, turned in space, from every first corner, and slightly bent.
void ExpectCutEverywhere(Polygon polygon, int64_t least, uint32_t seed, const std::string& what) {
  std::mt19937 random(seed);
  ASSERT_GT(TwiceArea(polygon), 0);
  ExpectCut(polygon, Cut(Placed(polygon, {})), least, what + " flat");
  for (int trial = 0; trial < 4; ++trial) {
    const std::string now = what + " seed " + std::to_string(seed) + " trial " + std::to_string(trial);
    std::rotate(polygon.begin(), polygon.begin() + static_cast<long>(random() % polygon.size()), polygon.end());
    Placing placing = Turned(random);
    ExpectCut(polygon, Cut(Placed(polygon, placing)), least, now);
    placing.bulge = 1e-3;
    ExpectCut(polygon, Cut(Placed(polygon, placing)), 0, now + " bent");
    if (testing::Test::HasFailure()) return;
  }
}

bool Touch(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto sign = [](int64_t x) { return (x > 0) - (x < 0); };
  const int s = sign(TwiceArea(a, b, c)) * sign(TwiceArea(a, b, d));
  const int t = sign(TwiceArea(c, d, a)) * sign(TwiceArea(c, d, b));
  const bool boxes = std::max(a.x, b.x) >= std::min(c.x, d.x) && std::max(c.x, d.x) >= std::min(a.x, b.x) &&
                     std::max(a.y, b.y) >= std::min(c.y, d.y) && std::max(c.y, d.y) >= std::min(a.y, b.y);
  return s <= 0 && t <= 0 && boxes;
}

// A simple polygon through random points, some left out: corners are inserted where no sides come to touch.
Polygon RandomSimple(size_t n, int64_t range, std::mt19937& random) {
  const auto at = [&] { return static_cast<int64_t>(random() % static_cast<uint64_t>(range)); };
  Polygon p{{0, 0}, {range, 0}, {at() + 1, range}};
  for (size_t tries = 0; p.size() < n && tries < 50 * n; ++tries) {
    const GridPoint q{at(), at()};
    const size_t side = random() % p.size();
    const GridPoint a = p[side], b = p[(side + 1) % p.size()];
    bool good = TwiceArea(a, b, q) != 0;
    for (size_t i = 0; i < p.size() && good; ++i) {
      const GridPoint c = p[i], d = p[(i + 1) % p.size()];
      if (i == side) continue;
      good = !(Touch(a, q, c, d) && d != a) && !(Touch(q, b, c, d) && c != b);
      if (d == a) good = good && TwiceArea(c, a, q) != 0 && !Touch(q, b, c, d);
      if (c == b) good = good && TwiceArea(q, b, d) != 0 && !Touch(a, q, c, d);
    }
    if (good) p.insert(p.begin() + static_cast<long>(side) + 1, q);
  }
  if (TwiceArea(p) < 0) std::reverse(p.begin(), p.end());
  return p;
}

// Further corners in line, on the sides.
Polygon WithCornersOnSides(const Polygon& p, int64_t parts) {
  Polygon more;
  for (size_t i = 0; i < p.size(); ++i) {
    const GridPoint a = p[i], b = p[(i + 1) % p.size()];
    for (int64_t k = 0; k < parts; ++k) more.push_back({a.x * parts + (b.x - a.x) * k, a.y * parts + (b.y - a.y) * k});
  }
  return more;
}

// The outline of grid squares grown at random without a hole, with a corner at each grid point.
Polygon RandomSquares(size_t squares, std::mt19937& random) {
  std::set<GridPoint> in{{0, 0}};
  constexpr GridPoint around[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  for (size_t tries = 0; in.size() < squares && tries < 100 * squares; ++tries) {
    auto from = in.begin();
    std::advance(from, static_cast<long>(random() % in.size()));
    const GridPoint way = around[2 * (random() % 4)], to{from->x + way.x, from->y + way.y};
    // One run of neighbours, which has more than a corner: neither a hole nor two squares that touch in a corner.
    int starts = 0;
    bool sides_only = true;
    for (size_t i = 0; i < 8; ++i) {
      const auto has = [&](size_t k) { return in.count({to.x + around[k % 8].x, to.y + around[k % 8].y}) != 0; };
      starts += has(i) && !has(i + 7);
      if (i % 2 == 1 && has(i) && !has(i + 1) && !has(i + 7)) sides_only = false;
    }
    if (starts == 1 && sides_only) in.insert(to);
  }
  std::map<GridPoint, GridPoint> next;
  for (const GridPoint& s : in) {
    if (!in.count({s.x, s.y - 1})) next[{s.x, s.y}] = {s.x + 1, s.y};
    if (!in.count({s.x + 1, s.y})) next[{s.x + 1, s.y}] = {s.x + 1, s.y + 1};
    if (!in.count({s.x, s.y + 1})) next[{s.x + 1, s.y + 1}] = {s.x, s.y + 1};
    if (!in.count({s.x - 1, s.y})) next[{s.x, s.y + 1}] = {s.x, s.y};
  }
  Polygon p{next.begin()->first};
  while (next.at(p.back()) != p.front()) p.push_back(next.at(p.back()));
  EXPECT_EQ(p.size(), next.size());
  return p;
}

TEST(Polygon, ShapesByHand) {
  EXPECT_EQ(Cut({0, 0, 0, 1, 0, 0, 1, 1, 0}), (std::vector<uint32_t>{0, 1, 2}));
  ExpectCutEverywhere({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 1, 1, "L");
  ExpectCutEverywhere({{0, 0}, {4, 0}, {1, 1}, {0, 4}}, 1, 2, "arrow head");
  ExpectCutEverywhere({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}}, 1, 3, "triangle with corners in line");
  ExpectCutEverywhere({{0, 0}, {9, 0}, {9, 9}, {5, 9}, {5, 1}, {4, 1}, {4, 9}, {0, 9}}, 1, 4, "U");
  Polygon comb;
  for (int64_t i = 0; i < 40; ++i) comb.insert(comb.end(), {{2 * i, 0}, {2 * i + 1, i % 3 == 0 ? 1 : 50}});
  comb.insert(comb.end(), {{80, 60}, {0, 60}});
  ExpectCutEverywhere(comb, 1, 5, "comb");
}

TEST(Polygon, RandomSimplePolygons) {
  for (uint32_t seed = 0; seed < 120; ++seed) {
    std::mt19937 random(seed);
    const Polygon p = RandomSimple(4 + seed % 60, seed % 2 == 0 ? 1000 : 12, random);
    ExpectCutEverywhere(p, 1, seed, "random");
    ExpectCutEverywhere(WithCornersOnSides(p, 2 + seed % 3), 1, seed, "random, corners in line");
    if (HasFailure()) return;
  }
}

TEST(Polygon, OutlinesOfSquares) {
  for (uint32_t seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    ExpectCutEverywhere(RandomSquares(2 + seed % 50, random), 1, seed, "squares");
    if (HasFailure()) return;
  }
}

// Shears keep areas, so the oracle stays on the grid, while products round by more than the area of many a triangle.
TEST(Polygon, NeedlesNeedExactAreas) {
  for (uint32_t seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const Polygon p = WithCornersOnSides(RandomSimple(4 + seed % 30, 100, random), 1 + seed % 3);
    Polygon needle = p;
    for (GridPoint& q : needle) {
      q.x += q.y << 16;
      q.y += q.x << 16;
    }
    ExpectCut(p, Cut(Placed(needle, {})), 1, "needle seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

// A frame as a polygon: round the outside, over a bridge, round the hole, back over the bridge.
TEST(Polygon, BridgesToHoles) {
  for (uint32_t seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const Polygon hole = RandomSimple(3 + seed % 20, 30, random);
    Polygon p = {{-50, -50}, {80, -50}, {80, 80}, {-50, 80}};
    // The lowest corner, the leftmost of several, sees all that lies lower.
    const auto lowest = std::min_element(hole.begin(), hole.end(), [](const GridPoint& a, const GridPoint& b) {
      return std::pair(a.y, a.x) < std::pair(b.y, b.x);
    });
    p.push_back(p[0]);
    for (auto q = lowest;;) {
      p.push_back(*q);
      q = q == hole.begin() ? hole.end() - 1 : q - 1;
      if (q == lowest) break;
    }
    p.push_back(*lowest);
    ASSERT_EQ(TwiceArea(p), 2 * 130 * 130 - TwiceArea(hole));
    ExpectCutEverywhere(p, 1, seed, "bridge");
    if (HasFailure()) return;
  }
}

TEST(Polygon, RepeatedCornersAndSpikesCostNoArea) {
  ExpectCutEverywhere({{0, 0}, {0, 0}, {3, 0}, {3, 3}, {3, 3}, {3, 3}, {0, 3}}, 0, 1, "repeated");
  ExpectCutEverywhere({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 7}, {2, 4}, {0, 4}}, 0, 2, "spike");
  ExpectCutEverywhere({{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}}, 0, 3, "hourglass");
}

// Nothing to expect but an end, n - 2 triangles and all corners used.
TEST(Polygon, AnyInputEnds) {
  std::mt19937 random(7);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), huge = 1e308, tiny = 5e-324;
  constexpr double odd[] = {0, 1, -1, 2, huge, -huge, tiny, nan, HUGE_VAL, 1e-300};
  for (int trial = 0; trial < 3000; ++trial) {
    const size_t n = 3 + random() % 12, kinds = trial % 3 == 0 ? 10 : trial % 3 == 1 ? 4 : 7;
    std::vector<double> corners(3 * n);
    for (double& x : corners) x = odd[random() % kinds];
    const std::vector<uint32_t> t = Cut(corners);
    EXPECT_EQ(t.size(), 3 * (n - 2)) << trial;
    EXPECT_EQ(std::set<uint32_t>(t.begin(), t.end()).size(), n) << trial;
    EXPECT_EQ(t, Cut(corners));
  }
}

TEST(Polygon, SizeDoesNotMatter) {
  const std::vector<double> small = {0, 0, 0, 3, 0, 0, 3, 1, 0, 1, 1, 0, 1, 3, 0, 0, 3, 0};
  for (const double scale : {1e-300, 1e-30, 1e30, 1e300}) {
    std::vector<double> corners = small;
    for (double& x : corners) x *= scale;
    EXPECT_EQ(Cut(corners), Cut(small)) << scale;
  }
}

TEST(Polygon, CapsOfTenThousandCornersAreQuick) {
  Polygon star;
  std::vector<double> corners;
  for (int i = 0; i < 10000; ++i) {
    const double angle = i * 6.283185307179586 / 10000, r = i % 2 == 0 ? 1 : 0.5;
    star.push_back({std::llround(1e6 * r * std::cos(angle)), std::llround(1e6 * r * std::sin(angle))});
  }
  ExpectCut(star, Cut(Placed(star, {})), 1, "star");
}

// ---------------------------------------------------------------- polygons that share corners

void Add(PolygonMesh& mesh, const std::vector<uint32_t>& polygon) {
  mesh.corners.insert(mesh.corners.end(), polygon.begin(), polygon.end());
  mesh.ends.push_back(mesh.corners.size());
}

void AddPoint(PolygonMesh& mesh, double x, double y, double z) {
  mesh.positions.insert(mesh.positions.end(), {x, y, z});
}

// Every side of a triangle has exactly one partner, which runs the other way.
void ExpectClosed(const PolygonMesh& mesh, const std::string& what) {
  const std::vector<uint32_t> cut = cut_polygons(mesh);
  size_t expected = 0;
  for (size_t i = 0; i < mesh.polygons(); ++i) expected += mesh.polygon(i).size() - 2;
  EXPECT_EQ(cut.size(), 3 * expected) << what;
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  for (size_t f = 0; f < cut.size(); f += 3)
    for (size_t i = 0; i < 3; ++i) ++sides[{cut[f + i], cut[f + (i + 1) % 3]}];
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1) << what << ": " << side.first << " " << side.second;
    EXPECT_EQ(sides.count({side.second, side.first}), 1u) << what << ": " << side.first << " " << side.second;
  }
}

// A top and a bottom with all corners in common, which rise and fall.
TEST(PolygonMesh, TwoPolygonsWithAllCornersInCommon) {
  for (uint32_t n = 4; n <= 20; ++n)
    for (uint32_t first = 0; first < n; ++first) {
      PolygonMesh mesh;
      std::vector<uint32_t> top, bottom;
      for (uint32_t i = 0; i < n; ++i) {
        AddPoint(mesh, std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), i % 2 == 0 ? 0.2 : -0.2);
        top.push_back((first + i) % n);
        bottom.push_back(n - 1 - i);
      }
      Add(mesh, top);
      Add(mesh, bottom);
      ExpectClosed(mesh, "lens of " + std::to_string(n));
    }
}

// Kites round two poles: up to 40 polygons with common opposite corners and a common vertex.
TEST(PolygonMesh, ManyPolygonsAtAVertex) {
  for (uint32_t n = 3; n <= 20; ++n) {
    PolygonMesh mesh;
    for (uint32_t i = 0; i < 2 * n; ++i)
      AddPoint(mesh, std::cos(M_PI * i / n), std::sin(M_PI * i / n), i % 2 == 0 ? 0.1 : -0.1);
    AddPoint(mesh, 0, 0, 1);
    AddPoint(mesh, 0, 0, -1);
    for (uint32_t i = 0; i < 2 * n; i += 2) {
      Add(mesh, {2 * n, i, i + 1, (i + 2) % (2 * n)});
      Add(mesh, {2 * n + 1, (i + 3) % (2 * n), (i + 2) % (2 * n), i + 1});
    }
    ExpectClosed(mesh, "trapezohedron of " + std::to_string(n));
  }
}

// A stack of stars: a star of up to 20 corners, concave, on both ends of a ring of squares, and squares over its dents
// whose diagonals the stars would like to take.
TEST(PolygonMesh, DentedPolygonsAndTheSquaresInTheirDents) {
  for (uint32_t n = 3; n <= 10; ++n) {
    PolygonMesh mesh;
    for (const double z : {0.0, 1.0})
      for (uint32_t i = 0; i < 2 * n; ++i) {
        const double r = i % 2 == 0 ? 1 : 0.6;
        AddPoint(mesh, r * std::cos(M_PI * i / n), r * std::sin(M_PI * i / n), z);
      }
    std::vector<uint32_t> top, bottom;
    for (uint32_t i = 0; i < 2 * n; ++i) {
      top.push_back(2 * n + i);
      bottom.push_back(2 * n - 1 - i);
      const uint32_t j = (i + 1) % (2 * n);
      Add(mesh, {i, j, 2 * n + j, 2 * n + i});
    }
    Add(mesh, top);
    Add(mesh, bottom);
    ExpectClosed(mesh, "star of " + std::to_string(2 * n));
    // The same faces as triangles of area, all of one orientation.
    const std::vector<uint32_t> cut = cut_polygons(mesh);
    double volume = 0;
    for (size_t f = 0; f < cut.size(); f += 3) {
      const double *a = &mesh.positions[3 * cut[f]], *b = &mesh.positions[3 * cut[f + 1]],
                   *c = &mesh.positions[3 * cut[f + 2]];
      volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                 a[2] * (b[0] * c[1] - b[1] * c[0])) /
                6;
    }
    EXPECT_NEAR(volume, n * 0.6 * std::sin(M_PI / n), 1e-12);
  }
}

// A dented square that has one cut only, after one that would take the same diagonal: the dented one chooses first.
TEST(PolygonMesh, APolygonWithOneCutChoosesFirst) {
  PolygonMesh mesh;
  AddPoint(mesh, 0, 0, 0);
  AddPoint(mesh, 2, -1, 0.3);
  AddPoint(mesh, 1, 0, 0);
  AddPoint(mesh, 2, 1, 0.3);
  AddPoint(mesh, 0.5, -1, -1);
  AddPoint(mesh, 0.5, 1, -1);
  AddPoint(mesh, 0.5, 0, -3);
  Add(mesh, {0, 4, 2, 5});  // its shorter diagonal is 0 2
  Add(mesh, {0, 1, 2, 3});  // dented at 2
  const std::vector<uint32_t> cut = cut_polygons(mesh);
  std::set<std::pair<uint32_t, uint32_t>> edges[2];
  for (size_t f = 0; f < cut.size(); f += 3)
    for (size_t i = 0; i < 3; ++i) edges[f / 6].insert(std::minmax({cut[f + i], cut[f + (i + 1) % 3]}));
  EXPECT_EQ(edges[1].count({0, 2}), 1u);
  EXPECT_EQ(edges[0].count({0, 2}), 0u);
}

}  // namespace
}  // namespace polygon_test
}  // namespace tool
