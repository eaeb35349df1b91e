// SPDX-License-Identifier: MIT
// Points of an arrangement, made in several ways, against fractions of integers of any size. A failure prints the seed
// and the number of the case.
#include "arrangement/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "arrangement/known_lines.h"
#include "oracle/lattice_points.h"
#include "oracle/rational.h"
#include "support/share.h"

namespace points_test {
namespace {

using namespace big_int;
using lattice_points::Random;
using lattice_points::seed;
using support::Least;
using support::Share;
using tpa::PlaneRef;
using tpa::u32;
using tpa::Vec3;

constexpr u32 capacity = 512;

// Triangles with area between points; no surface.
struct Soup {
  std::vector<Vec3> position;
  std::vector<u32> corner;
  std::vector<tpa::ArrangementPoint> list;
  std::vector<u32> slots, origin_slots, opposite;
  tpa::Mesh mesh;
  tpa::ArrangementPoints points{};
  std::vector<RationalPoint> known;  // per point in the list

  Soup(Random& random, std::vector<Vec3> vertices, u32 faces)
      : position(std::move(vertices)),
        list(capacity),
        slots(tpa::point_hash_slots(capacity)),
        origin_slots(tpa::point_hash_slots(capacity)) {
    while (corner.size() < size_t{3} * faces) {
      u32 v[3];
      for (u32& c : v) c = static_cast<u32>(random.upto(static_cast<long long>(position.size()) - 1));
      const RationalPlane plane = plane_through(position[v[0]], position[v[1]], position[v[2]]);
      if (compare(plane.normal, {}) != 0) corner.insert(corner.end(), v, v + 3);
    }
    mesh.position = position.data();
    mesh.corner = corner.data();
    for (u32 h = 0; h < corner.size(); ++h) opposite.push_back(h);  // no face has a neighbour
    mesh.opposite = opposite.data();
    mesh.vertex_count = static_cast<u32>(position.size());
    mesh.face_count = faces;
    points.mesh = &mesh;
    points.list = {list.data(), capacity, 0};
    points.by_position = {slots.data(), static_cast<u32>(slots.size())};
    points.by_origin = {origin_slots.data(), static_cast<u32>(origin_slots.size())};
    clear(points);
  }
  Soup(const Soup&) = delete;  // mesh points into the vectors

  const Vec3& At(u32 h) const { return position[corner[h]]; }
  RationalPlane PlaneOf(PlaneRef p) const {
    if (p.axis == tpa::of_face) return plane_through(At(3 * p.id), At(3 * p.id + 1), At(3 * p.id + 2));
    return plane_along(At(p.id), At(tpa::next_edge(p.id)), p.axis);
  }
  PlaneRef AnyPlane(Random& random) const {
    const auto f = static_cast<u32>(random.upto(mesh.face_count - 1));
    if (random.upto(2) != 0) return tpa::plane_of_face(f);
    return {3 * f + static_cast<u32>(random.upto(2)), static_cast<u32>(random.upto(2))};
  }
  // An edge in the plane with the point on its line, if that holds for the edge that chance takes.
  u32 EdgeAt(Random& random, PlaneRef p, const RationalPoint& at) const {
    const u32 h = p.axis == tpa::of_face ? 3 * p.id + static_cast<u32>(random.upto(2)) : p.id;
    const RationalPoint a = rational(At(h)), b = rational(At(tpa::next_edge(h)));
    for (size_t axis = 0; axis < 3; ++axis)
      if (turn(axis, a, b, at) != 0) return tpa::none;
    return h;
  }
  // Adds a point of any kind, where it is unique and within the range, and notes its coordinates.
  void Add(Random& random) {
    const long long way = random.upto(9);
    RationalPoint at;
    u32 number = tpa::none;
    if (way == 0) {
      const auto v = static_cast<u32>(random.upto(mesh.vertex_count - 1));
      at = rational(position[v]);
      number = add_vertex_point(points, v);
    } else if (way < 6) {
      const auto h = static_cast<u32>(random.upto(3ll * mesh.face_count - 1));
      const PlaneRef p = AnyPlane(random);
      if (!line_meets_plane(At(h), At(tpa::next_edge(h)), PlaneOf(p), at) || !IsNear(at)) return;
      const u32 met = EdgeAt(random, p, at);
      on_two_edges += met != tpa::none;
      number = add_edge_crossing(points, h, p, met);
    } else {
      const PlaneRef p = AnyPlane(random), q = AnyPlane(random), r = AnyPlane(random);
      if (!planes_meet(PlaneOf(p), PlaneOf(q), PlaneOf(r), at) || !IsNear(at)) return;
      number = add_plane_crossing(points, p, q, r);
    }
    Note(at, number);
  }
  static bool IsNear(const RationalPoint& at) {
    return std::all_of(at.begin(), at.end(), [](const Rational& x) {
      return compare(x, Rational(0x1p90)) < 0 && compare(x, Rational(-0x1p90)) > 0;
    });
  }
  // A new point comes last; an old one is the equal one.
  void Note(const RationalPoint& at, u32 number) {
    const auto [found, is_new] = numbers.emplace(at, static_cast<u32>(known.size()));
    if (is_new) known.push_back(at);
    EXPECT_EQ(number, found->second);
    EXPECT_EQ(points.list.size, known.size());
    repeated += !is_new;
  }

  std::map<RationalPoint, u32, Less> numbers;
  int repeated = 0, on_two_edges = 0;
};

std::vector<Vec3> grid(double step, double shift) {
  std::vector<Vec3> out;
  for (int i = 0; i < 27; ++i) out.push_back({i % 3 * step + shift, i / 3 % 3 * step - shift, i / 9 * step});
  return out;
}
std::vector<Vec3> scattered(Random& random, int kind) {
  std::vector<Vec3> out;
  for (int i = 0; i < 12; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const double scale = kind == 0 ? 1 : std::ldexp(1.0, static_cast<int>(random.within(80)));
      p[k] = scale * (random.unit() - 0.5);
      if (kind == 2) p[k] = 1 + 0x1p-52 * static_cast<double>(random.upto(40));  // few ulps apart
    }
    out.push_back(p);
  }
  return out;
}

std::vector<Vec3> near_line(Random& random) {
  std::vector<Vec3> out;
  const Vec3 way{random.unit(), random.unit(), random.unit()};
  while (out.size() < 12) out.push_back((random.unit() - 0.5) * way);
  return out;
}

TEST(ArrangementPoints, AreOneWhateverMakesThem) {
  Random random;
  int repeated = 0, distinct = 0, crowded = 0, on_two_edges = 0;
  for (int i = 0; i < Share(60); ++i) {
    Soup soup(random,
              i % 4 == 0   ? grid(1, 0)
              : i % 4 == 1 ? grid(0x1p-54, 0.375)
                           : scattered(random, i % 4 == 2 ? 0 : 2),
              8);
    for (int k = 0; k < 100; ++k) soup.Add(random);
    repeated += soup.repeated;
    on_two_edges += soup.on_two_edges;
    distinct += static_cast<int>(soup.known.size());
    for (u32 p = 1; p < soup.points.list.size; ++p)
      for (u32 q = 0; q < p; ++q) crowded += soup.list[p].at == soup.list[q].at;
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(repeated, Least(1000));
  EXPECT_GT(distinct, Least(2000));
  EXPECT_GT(on_two_edges, Least(200));
  EXPECT_GT(crowded, Least(100)) << "different points with equal coordinates after rounding";
}

TEST(ArrangementPoints, AreOneForBothZeros) {
  Random random;
  std::vector<Vec3> vertices = grid(1, 0);
  vertices.push_back({-0.0, -0.0, -0.0});
  vertices.push_back({1.0, -0.0, 2.0});
  Soup soup(random, vertices, 8);
  for (u32 v = 0; v < 29; ++v) EXPECT_EQ(add_vertex_point(soup.points, v), v < 27 ? v : v == 27 ? 0u : 19u);
}

TEST(ArrangementPoints, RunOutWithoutHarm) {
  Random random;
  Soup soup(random, grid(1, 0), 8);
  soup.points.list.capacity = 2;
  EXPECT_EQ(add_vertex_point(soup.points, 0), 0u);
  EXPECT_EQ(add_vertex_point(soup.points, 1), 1u);
  EXPECT_EQ(add_vertex_point(soup.points, 2), tpa::none);
  EXPECT_EQ(add_vertex_point(soup.points, 1), 1u);
  soup.points.list.capacity = 3;
  EXPECT_EQ(add_vertex_point(soup.points, 2), 2u);
}

// Ties between points of a grid; points of one edge, in line but for rounding; and rounded points beside them.
TEST(ArrangementPoints, TurnAndCompareAsFractions) {
  Random random;
  int flat = 0, turned = 0, ties = 0, thin = 0;
  for (int i = 0; i < Share(100); ++i) {
    const int kind = i % 4;
    Soup soup(random, kind == 0 ? grid(1, 0) : scattered(random, kind - 1), 8);
    for (int k = 0; k < 40; ++k) soup.Add(random);
    // Points of one line.
    const auto first = static_cast<u32>(soup.known.size());
    for (u32 f = 0; f < soup.mesh.face_count; ++f) {
      RationalPoint at;
      const u32 h = static_cast<u32>(i) % 24;
      if (line_meets_plane(soup.At(h), soup.At(tpa::next_edge(h)), soup.PlaneOf(tpa::plane_of_face(f)), at) &&
          Soup::IsNear(at))
        soup.Note(at, add_edge_crossing(soup.points, h, tpa::plane_of_face(f)));
    }
    const auto count = static_cast<long long>(soup.known.size());
    for (int k = 0; k < 60; ++k) {
      u32 p[3];
      for (u32& v : p)
        v = static_cast<u32>(k % 2 == 0 && first + 3 < count ? first + random.upto(count - first - 1)
                                                             : random.upto(count - 1));
      for (u32 axis = 0; axis < 3; ++axis) {
        const int wanted = turn(axis, soup.known[p[0]], soup.known[p[1]], soup.known[p[2]]);
        EXPECT_EQ(tpa::turn(soup.points, axis, p[0], p[1], p[2]), wanted);
        (wanted == 0 ? flat : turned) += 1;
        const int order = compare(soup.known[p[0]][axis], soup.known[p[1]][axis]);
        EXPECT_EQ(tpa::compare_along(soup.points, axis, p[0], p[1]), order);
        ties += order == 0 && p[0] != p[1];
        const Vec3& beside = soup.list[p[2]].at;
        const int rounded = turn(axis, soup.known[p[0]], soup.known[p[1]], rational(beside));
        EXPECT_EQ(tpa::turn(soup.points, axis, p[0], p[1], beside), rounded);
        thin += rounded != wanted;
      }
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(flat, Least(1000));
  EXPECT_GT(turned, Least(5000));
  EXPECT_GT(ties, Least(500));
  EXPECT_GT(thin, Least(100));
}

// Normals of triangles and of planes along an axis: nearly parallel where vertices are near a line.
TEST(ArrangementPoints, NormalsTellASignOrNone) {
  Random random;
  int told = 0, none = 0;
  const auto expect = [&](int filtered, int wanted) {
    EXPECT_TRUE(filtered == 2 || filtered == wanted) << filtered << " for " << wanted;
    ++(filtered == 2 ? none : told);
  };
  for (int i = 0; i < Share(50); ++i) {
    Soup soup(random, i % 2 == 0 ? near_line(random) : scattered(random, i % 4 / 2), 8);
    for (int k = 0; k < 30; ++k) {
      const PlaneRef p = soup.AnyPlane(random), q = soup.AnyPlane(random);
      const RationalPoint a = soup.PlaneOf(p).normal, b = soup.PlaneOf(q).normal, across = cross(a, b);
      const auto u = rounded_normal(soup.mesh, p), v = rounded_normal(soup.mesh, q);
      for (u32 axis = 0; axis < 3; ++axis) expect(tpa::filtered_cross(axis, u, v), across[axis].sign());
      expect(tpa::filtered_dot(u, v), dot(a, b).sign());
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(told, Least(500));
  EXPECT_GT(none, Least(500));
}

bool lies_in(const RationalPlane& plane, const RationalPoint& p) {
  return compare(dot(plane.normal, p), plane.level) == 0;
}

TEST(ArrangementPoints, LieWhereTheirOriginsSay) {
  Random random;
  int in_plane = 0, on_line = 0;
  for (int i = 0; i < Share(60); ++i) {
    const int kind = i % 3;
    Soup soup(random, kind == 0 ? grid(1, 0) : scattered(random, kind - 1), 4);
    for (int k = 0; k < 200; ++k) soup.Add(random);
    const auto count = static_cast<long long>(soup.known.size());
    for (int k = 0; k < 600; ++k) {
      u32 p[3];
      for (u32& v : p) v = static_cast<u32>(random.upto(count - 1));
      const tpa::ArrangementPoint &x = soup.list[p[0]], &y = soup.list[p[1]], &z = soup.list[p[2]];
      const PlaneRef plane = soup.AnyPlane(random);
      if (comes_from_plane(soup.mesh, x, plane)) {
        ++in_plane;
        EXPECT_TRUE(lies_in(soup.PlaneOf(plane), soup.known[p[0]]));
      }
      const bool are_vertices = x.kind == tpa::PointKind::vertex && y.kind == x.kind && z.kind == x.kind;
      if (are_vertices || p[0] == p[1] || p[1] == p[2] || p[2] == p[0] || !come_from_line(soup.mesh, x, y, z)) continue;
      ++on_line;
      for (u32 axis = 0; axis < 3; ++axis)
        EXPECT_EQ(turn(axis, soup.known[p[0]], soup.known[p[1]], soup.known[p[2]]), 0);
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(in_plane, Least(2000));
  EXPECT_GT(on_line, Least(100));
}

}  // namespace
}  // namespace points_test
