// SPDX-License-Identifier: MIT
// Orientations against integers of any size, meeting triangles against a linear programme. Failures print the seed and
// the points.
#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle/big_int.h"
#include "oracle/lattice_points.h"
#include "support/share.h"

namespace predicates_test {
namespace {

using namespace lattice_points;
using big_int::orientation;
using support::Least;
using support::Share;
using tpa::Vec3;
using i128 = __int128;

TEST(Orientation, IntegersAgreeWithInt128) {
  Random random;
  for (int i = 0; i < Share(300000); ++i) {
    const long long n = i % 3 == 0 ? 2 : i % 3 == 1 ? 1000 : 1ll << 30;
    long long c[6];
    for (auto& v : c) v = random.within(n);
    if (i % 4 == 0) c[4] = c[0] + 3 * (c[2] - c[0]) + random.within(1), c[5] = c[1] + 3 * (c[3] - c[1]);
    const i128 d = i128(c[2] - c[0]) * (c[5] - c[1]) - i128(c[3] - c[1]) * (c[4] - c[0]);
    const int want = (d > 0) - (d < 0);
    ASSERT_EQ(want, tpa::orient2d(double(c[0]), double(c[1]), double(c[2]), double(c[3]), double(c[4]), double(c[5])))
        << "seed " << seed << " case " << i;
  }
}

TEST(Orientation, NearlyFlatIntegersAgreeInSpace) {
  Random random;
  for (int i = 0; i < Share(300000); ++i) {
    const long long n = i % 3 == 0 ? 2 : i % 3 == 1 ? 1000 : 1ll << 30;
    LatticePoint g[4];
    for (auto& v : g) v = {random.within(n), random.within(n), random.within(n)};
    if (i % 4 != 0) {  // d in the plane of abc, or one step off
      const long long s = random.within(3), t = random.within(3), off = random.within(1);
      g[3] = {g[0].x + s * (g[1].x - g[0].x) + t * (g[2].x - g[0].x),
              g[0].y + s * (g[1].y - g[0].y) + t * (g[2].y - g[0].y),
              g[0].z + s * (g[1].z - g[0].z) + t * (g[2].z - g[0].z) + off};
    }
    const auto cofactor = [&](auto f, auto h) {
      return i128(f(g[1]) - f(g[0])) * (h(g[2]) - h(g[0])) - i128(h(g[1]) - h(g[0])) * (f(g[2]) - f(g[0]));
    };
    const auto x = [](LatticePoint v) { return v.x; };
    const auto y = [](LatticePoint v) { return v.y; };
    const auto z = [](LatticePoint v) { return v.z; };
    const i128 d =
        cofactor(y, z) * (g[3].x - g[0].x) + cofactor(z, x) * (g[3].y - g[0].y) + cofactor(x, y) * (g[3].z - g[0].z);
    ASSERT_EQ((d > 0) - (d < 0), tpa::orient3d(vec(g[0]), vec(g[1]), vec(g[2]), vec(g[3])))
        << print({g[0], g[1], g[2], g[3]});
  }
}

TEST(Orientation, DoublesOfAllMagnitudesAgreeWithBigIntegers) {
  Random random;
  for (int i = 0; i < Share(40000); ++i) {
    double c[12];
    for (auto& v : c) {
      v = i % 2 ? random.any_magnitude() : random.unit();
      if (random.upto(9) == 0) v = 0;
    }
    if (i % 5 == 0) {  // nearly in line, nearly in a plane, far from the origin
      const double s = random.unit(), t = random.unit();
      for (int k = 0; k < 3; ++k)
        c[9 + k] = tpa::into_exact_range(c[k] + s * (c[3 + k] - c[k]) + t * (c[6 + k] - c[k]));
      for (int k = 0; k < 2; ++k) c[4 + k] = tpa::into_exact_range(c[k] + s * (c[2 + k] - c[k]));
      for (auto& v : c) v = std::abs(v) > 0x1p100 ? 1 : v;
    }
    if (i % 7 == 0) {  // extremes only
      for (auto& v : c)
        v = (random.upto(1) ? 1 : -1) * (random.upto(1) ? 0x1p-100 : 0x1p100) * (random.upto(3) ? 1 : 0);
    }
    const Vec3 p[4] = {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}, {c[9], c[10], c[11]}};
    ASSERT_EQ(orientation(c[0], c[1], c[2], c[3], c[4], c[5]), tpa::orient2d(c[0], c[1], c[2], c[3], c[4], c[5]))
        << "seed " << seed << " case " << i;
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), tpa::orient3d(p[0], p[1], p[2], p[3]))
        << "seed " << seed << " case " << i;
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), tpa::orient3d_exact(p[0], p[1], p[2], p[3])) << "seed " << seed;
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), -tpa::orient3d(p[1], p[0], p[2], p[3])) << "seed " << seed;
  }
}

TEST(Triangles, MeetWhereTheLinearProgrammeSaysSo) {
  Random random;
  int met = 0;
  for (int i = 0; i < Share(50000); ++i) {
    std::vector<LatticePoint> a(3), b(3);
    for (auto& g : a) g = random.point(i % 2 ? 3 : 2);
    for (auto& g : b) g = random.point(i % 2 ? 3 : 2);
    if (i % 5 == 0) a[2] = a[0];
    if (i % 7 == 0) b[1] = b[2];
    if (i % 11 == 0) {  // all in one plane
      for (auto& g : a) g.z = g.x;
      for (auto& g : b) g.z = g.x;
    }
    if (i % 13 == 0) a[1] = {(a[0].x + a[2].x) / 2, (a[0].y + a[2].y) / 2, (a[0].z + a[2].z) / 2};
    const bool want = common_corner(a, b, anywhere);
    met += want;
    const Vec3 s[3] = {stretched(a[0], i % 3), stretched(a[1], i % 3), stretched(a[2], i % 3)};
    const Vec3 t[3] = {stretched(b[0], i % 3), stretched(b[1], i % 3), stretched(b[2], i % 3)};
    ASSERT_EQ(want, tpa::triangles_meet(s, t)) << print({a[0], a[1], a[2], b[0], b[1], b[2]});
    ASSERT_EQ(common_corner({a[0], a[1]}, b, anywhere), tpa::segment_meets_triangle(s[0], s[1], t[0], t[1], t[2]))
        << print({a[0], a[1], b[0], b[1], b[2]});
  }
  EXPECT_GT(met, Least(5000));
}

// Random points, with the last in the plane of the first three but for a few units in the last place: on the third
// point's side of the edge between the first two, or on the other side.
void NearlyFlat(Random& random, bool same_side, Vec3 (&p)[4]) {
  for (Vec3& v : p) v = {random.unit(), random.unit(), random.unit()};
  const double s = random.unit(), t = same_side ? random.unit() : -random.unit();
  for (int k = 0; k < 3; ++k) {
    p[3][k] = p[0][k] + s * (p[1][k] - p[0][k]) + t * (p[2][k] - p[0][k]);
    for (long long ulps = random.upto(3); ulps > 0; --ulps) p[3][k] = std::nextafter(p[3][k], random.upto(1) ? 9 : -9);
  }
}

// The certain ones of six sides, also for a corner that is off the other plane by no more than rounding.
TEST(Triangles, TellTheSidesOfCorners) {
  Random random;
  int certain = 0, open = 0;
  for (int i = 0; i < Share(30000); ++i) {
    Vec3 s[3], t[3];
    for (int k = 0; k < 3; ++k) s[k] = stretched(random.point(3), i % 3), t[k] = stretched(random.point(3), i % 3);
    if (i % 5 == 0) t[i % 3] = s[random.upto(2)];
    if (i % 2 == 0) {
      Vec3 flat[4];
      NearlyFlat(random, true, flat);
      for (int k = 0; k < 3; ++k) (i % 4 == 0 ? s : t)[k] = flat[k];
      (i % 4 == 0 ? t : s)[i / 4 % 3] = flat[3];
    }
    const auto expect = [&](const tpa::CertainSides& sides, const Vec3* plane, const Vec3* corner) {
      for (int k = 0; k < 3; ++k) {
        const int above = static_cast<int>(sides.above >> k & 1), below = static_cast<int>(sides.below >> k & 1);
        const int side = orientation(plane[0], plane[1], plane[2], corner[k]);
        (above + below == 0 && side != 0 ? open : certain) += 1;
        EXPECT_LE(above + below, 1);
        if (above + below == 1) {
          EXPECT_EQ(above - below, side);
        }
      }
    };
    const tpa::FacingSides sides = tpa::facing_sides(s, t);
    expect(sides.of_b, s, t);
    expect(sides.of_a, t, s);
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(certain, Least(100000));
  EXPECT_GT(open, Least(1000));
}

TEST(Triangles, MeetBeyondASharedVertex) {
  Random random;
  for (int i = 0; i < Share(50000); ++i) {
    const int n = i % 2 ? 3 : 2;
    const LatticePoint v = random.point(n), a1 = random.point(n), b1 = random.point(n);
    LatticePoint a2 = random.point(n), b2 = random.point(n);
    if (i % 5 == 0) a2 = {2 * v.x - a1.x, 2 * v.y - a1.y, 2 * v.z - a1.z};
    if (i % 7 == 0) b2 = i % 3 ? b1 : v;
    const bool want = common_corner({v, a1, a2}, {v, b1, b2}, [&](CommonPoint p) { return !is_at(p, v); });
    ASSERT_EQ(want, tpa::triangles_meet_beyond_vertex(stretched(v, i % 3), stretched(a1, i % 3), stretched(a2, i % 3),
                                                      stretched(b1, i % 3), stretched(b2, i % 3)))
        << print({v, a1, a2, b1, b2});
  }
}

TEST(Triangles, MeetBeyondASharedEdge) {
  Random random;
  for (int i = 0; i < Share(50000); ++i) {
    const int n = i % 2 ? 3 : 1;
    const LatticePoint u = random.point(n), oa = random.point(n);
    LatticePoint v = random.point(n), ob = random.point(n);
    if (i % 5 == 0) v = u;
    if (i % 4 == 0) ob = {u.x + oa.x - v.x, u.y + oa.y - v.y, u.z + oa.z - v.z};
    if (i % 9 == 0)
      v = {2 * u.x - oa.x, 2 * u.y - oa.y, 2 * u.z - oa.z},
      ob = {3 * u.x - 2 * oa.x, 3 * u.y - 2 * oa.y, 3 * u.z - 2 * oa.z};
    const bool in_one_place = u == v || oa == u || oa == v || ob == u || ob == v || oa == ob;
    const bool want =
        in_one_place || common_corner({u, v, oa}, {v, u, ob}, [&](CommonPoint p) { return !is_on_segment(p, u, v); });
    ASSERT_EQ(want, tpa::triangles_meet_beyond_edge(stretched(u, i % 3), stretched(v, i % 3), stretched(oa, i % 3),
                                                    stretched(ob, i % 3)))
        << print({u, v, oa, ob});
  }
}

}  // namespace
}  // namespace predicates_test
