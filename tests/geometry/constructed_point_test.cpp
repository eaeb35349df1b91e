// SPDX-License-Identifier: MIT
// Points where lines and planes meet, exactly and nearly, against fractions of integers of any size. A failure prints
// the seed and the number of the case.
#include "geometry/constructed_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "geometry/near_point.h"
#include "oracle/lattice_points.h"
#include "oracle/rational.h"
#include "support/share.h"

namespace constructed_point_test {
namespace {

using namespace big_int;
using lattice_points::Random;
using lattice_points::seed;
using support::Least;
using support::Share;
using tpa::ExactPlane;
using tpa::ExactPoint;
using tpa::NearPlane;
using tpa::NearPoint;
using tpa::Vec3;

// Points on a small grid, with many ties; anywhere; of mixed magnitudes; on a grid but for an ulp.
enum Kind { grid, anywhere, mixed, beside_grid, kinds };

Vec3 any_point(Random& random, int kind) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) {
    double& x = p[i];
    x = kind == anywhere ? random.unit() - 0.5 : static_cast<double>(random.upto(2));
    if (kind == mixed)
      x = random.upto(7) == 0 ? 0 : std::ldexp(random.unit() - 0.5, static_cast<int>(random.within(90)));
    if (kind == beside_grid && random.upto(1) != 0) x = std::nextafter(x + 1, random.upto(1) != 0 ? 9 : -9);
    x = tpa::into_exact_range(x);
  }
  return p;
}

struct KnownPlane {
  ExactPlane exact;
  NearPlane near;
  RationalPlane rational;
};
// Of a triangle with area.
KnownPlane any_plane(Random& random, int kind) {
  for (;;) {
    const Vec3 a = any_point(random, kind), b = any_point(random, kind), c = any_point(random, kind);
    KnownPlane out{tpa::exact_plane(a, b, c), tpa::near_plane(a, b, c), plane_through(a, b, c)};
    if (compare(out.rational.normal, {}) != 0) return out;
  }
}

struct KnownPoint {
  ExactPoint exact;
  NearPoint near;
  RationalPoint rational;
};

KnownPoint on_line(Random& random, int kind) {
  for (;;) {
    const Vec3 a = any_point(random, kind), b = any_point(random, kind);
    const KnownPlane plane = any_plane(random, kind);
    KnownPoint out;
    if (!line_meets_plane(a, b, plane.rational, out.rational)) continue;
    out.exact = tpa::line_through_plane(a, b, plane.exact);
    out.near = tpa::near_line_through_plane(a, b, plane.near);
    return out;
  }
}

KnownPoint of_planes(Random& random, int kind) {
  for (;;) {
    KnownPlane p[3];
    for (auto& plane : p) plane = any_plane(random, kind);
    if (random.upto(1) != 0) {
      const Vec3 a = any_point(random, kind), b = any_point(random, kind);
      const tpa::u32 axis = static_cast<tpa::u32>(random.upto(2));
      p[2] = {tpa::exact_plane_along(a, b, axis), tpa::near_plane_along(a, b, axis), plane_along(a, b, axis)};
    }
    KnownPoint out;
    if (!planes_meet(p[0].rational, p[1].rational, p[2].rational, out.rational)) continue;
    out.exact = tpa::common_point(p[0].exact, p[1].exact, p[2].exact);
    out.near = tpa::near_common_point(p[0].near, p[1].near, p[2].near);
    return out;
  }
}

KnownPoint any_known(Random& random, int kind) {
  const long long way = random.upto(4);
  if (way < 2) return on_line(random, kind);
  if (way < 4) return of_planes(random, kind);
  const Vec3 p = any_point(random, kind);
  return {tpa::exact_point(p), tpa::near_point(p), rational(p)};
}

template <tpa::u32 D>
Rational value(const tpa::Dyadic<D>& a) {
  if (a.size == 0) return Rational(BigInt(0));
  BigInt over, under;
  over.limb.assign(a.limb, a.limb + a.size);
  over.negative = a.sign < 0;
  // 2^(32 low), low above or below zero.
  (a.low < 0 ? under : over)
      .limb.insert((a.low < 0 ? under : over).limb.begin(), static_cast<size_t>(std::abs(a.low)), 0);
  under.limb.push_back(1);
  return {over, under};
}

TEST(ExactPlanes, HoldTheirPoints) {
  Random random;
  for (int i = 0; i < Share(4000); ++i) {
    const Vec3 a = any_point(random, i % kinds), b = any_point(random, i % kinds), c = any_point(random, i % kinds);
    const ExactPlane plane = tpa::exact_plane(a, b, c);
    const RationalPlane wanted = plane_through(a, b, c);
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(compare(value(plane.normal[k]), wanted.normal[k]), 0);
    EXPECT_TRUE(plane.at == a);
    const size_t axis = static_cast<size_t>(i / kinds % 3);
    const ExactPlane upright = tpa::exact_plane_along(a, b, static_cast<tpa::u32>(axis));
    const RationalPoint normal{value(upright.normal[0]), value(upright.normal[1]), value(upright.normal[2])};
    EXPECT_EQ(normal[axis].sign(), 0);
    EXPECT_TRUE(upright.at == a);
    EXPECT_EQ(compare(dot(normal, rational(a)), dot(normal, rational(b))), 0);
    const RationalPoint upright_normal = plane_along(a, b, axis).normal;
    EXPECT_EQ(compare(normal, {}) == 0, compare(upright_normal, {}) == 0);
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
}

// A coordinate rounded to nearest is no further off than its neighbours.
void expect_nearest(const Rational& x, double got) {
  const auto gap = [&](double y) {
    const Rational d = x - Rational(y);
    return d.sign() < 0 ? Rational(BigInt(0)) - d : d;
  };
  const auto zero_below_range = [](double y) { return std::abs(y) < tpa::smallest_magnitude ? 0.0 : y; };
  if (got == 0) {
    EXPECT_LT(compare(gap(0), Rational(tpa::smallest_magnitude)), 0);
    return;
  }
  EXPECT_TRUE(tpa::in_exact_range(got));
  const double lower = zero_below_range(std::nextafter(got, -0x1p101));
  const double upper = zero_below_range(std::nextafter(got, 0x1p101));
  EXPECT_LE(compare(gap(got), gap(lower)), 0);
  EXPECT_LE(compare(gap(got), gap(upper)), 0);
}

TEST(ConstructedPoints, AreWhereLinesAndPlanesMeet) {
  Random random;
  int far = 0, rounded_nearly = 0;
  for (int i = 0; i < Share(3000); ++i) {
    const KnownPoint p = any_known(random, i % kinds);
    ASSERT_NE(sign_of(p.exact.w), 0) << "seed " << seed << " case " << i;
    const Rational w = value(p.exact.w);
    bool is_near = true;
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(compare(value(p.exact.x[k]), p.rational[k] * w), 0);
      for (const double end : {-0x1p100, 0x1p100}) is_near = is_near && compare(p.rational[k], Rational(end)) * end < 0;
    }
    far += !is_near;
    if (is_near) {
      tpa::u32 exact = 0;
      const Vec3 at = rounded(p.exact, exact);
      for (int k = 0; k < 3; ++k) {
        const Rational& x = p.rational[static_cast<size_t>(k)];
        expect_nearest(x, at[k]);
        EXPECT_EQ((exact >> k & 1) != 0, compare(x, Rational(at[k])) == 0);
      }
      Vec3 nearly;
      tpa::u32 nearly_exact = 0;
      if (tpa::round_nearly(p.near, nearly, nearly_exact)) {
        EXPECT_EQ(std::memcmp(&nearly, &at, sizeof at), 0);
        EXPECT_EQ(nearly_exact, exact);
        ++rounded_nearly;
      }
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_LT(far, 1000);
  EXPECT_GT(rounded_nearly, Least(1200));
}

// Three planes meet beside a corner of two of them, by less than any double: the difference underflows on the way.
TEST(ConstructedPoints, OffByLessThanADoubleAreNotEqual) {
  const double e = 0x1p-100, d = e + 0x1p-152, far = 0x1p100;
  const Vec3 corner{e, e, e};
  const Vec3 triangles[3][3] = {
      {corner, {d, far, e}, {e, e, far}}, {corner, {d, e, far}, {far, d, e}}, {{d, e, e}, {far, d, e}, {d, far, d}}};
  ExactPlane exact[3];
  NearPlane near[3];
  for (int i = 0; i < 3; ++i) {
    const auto& [a, b, c] = triangles[i];
    exact[i] = tpa::exact_plane(a, b, c);
    near[i] = tpa::near_plane(a, b, c);
  }
  const ExactPoint point = tpa::common_point(exact[0], exact[1], exact[2]);
  const NearPoint nearly = tpa::near_common_point(near[0], near[1], near[2]);
  tpa::u32 exact_bits = 0, near_bits = 0;
  const Vec3 at = tpa::rounded(point, exact_bits);
  EXPECT_EQ(at.x, e);
  for (tpa::u32 axis = 0; axis < 3; ++axis) {
    const int sign = tpa::near_compare_along(axis, nearly, tpa::near_point(corner));
    EXPECT_TRUE(sign == 2 || sign == tpa::compare_along(axis, point, tpa::exact_point(corner))) << axis;
  }
  EXPECT_NE(tpa::compare_along(0, point, tpa::exact_point(corner)), 0);
  Vec3 near_at;
  EXPECT_TRUE(!tpa::round_nearly(nearly, near_at, near_bits) || near_bits == exact_bits);
}

TEST(ConstructedPoints, CompareAsFractions) {
  Random random;
  int ties = 0, same = 0, flat = 0, turned = 0, decided = 0;
  // Right, or in doubt.
  const auto expect_nearly = [&](int got, int wanted) {
    EXPECT_TRUE(got == wanted || got == 2) << got << " for " << wanted;
    decided += got != 2;
  };
  for (int i = 0; i < Share(600); ++i) {
    const int kind = i % kinds;
    std::vector<KnownPoint> points;
    for (int k = 0; k < 3; ++k) points.push_back(any_known(random, kind));
    points.push_back(points[0]);
    for (const KnownPoint& p : points)
      for (const KnownPoint& q : points) {
        for (size_t axis = 0; axis < 3; ++axis) {
          const int order = compare(p.rational[axis], q.rational[axis]);
          EXPECT_EQ(tpa::compare_along(static_cast<tpa::u32>(axis), p.exact, q.exact), order);
          expect_nearly(tpa::near_compare_along(static_cast<tpa::u32>(axis), p.near, q.near), order);
          ties += order == 0 && &p != &q;
        }
        const bool equal = compare(p.rational, q.rational) == 0;
        EXPECT_EQ(tpa::equal(p.exact, q.exact), equal);
        same += equal && &p != &q;
      }
    for (size_t axis = 0; axis < 3; ++axis)
      for (size_t k = 0; k < 2; ++k) {
        const KnownPoint &p = points[k], &q = points[k + 1], &r = points[(k + 2) % 4];
        const int wanted = turn(axis, p.rational, q.rational, r.rational);
        EXPECT_EQ(tpa::flat_orient(static_cast<tpa::u32>(axis), p.exact, q.exact, r.exact), wanted);
        EXPECT_EQ(tpa::flat_orient(static_cast<tpa::u32>(axis), q.exact, p.exact, r.exact), -wanted);
        expect_nearly(tpa::near_flat_orient(static_cast<tpa::u32>(axis), p.near, q.near, r.near), wanted);
        (wanted == 0 ? flat : turned) += 1;
      }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(ties, Least(2000));
  EXPECT_GT(same, Least(1200));
  EXPECT_GT(flat, Least(100));
  EXPECT_GT(turned, Least(2000));
  EXPECT_GT(decided, Least(15000));
}

TEST(ExactPlanes, CompareNormalsAndHeights) {
  Random random;
  int parallel = 0, square = 0, level = 0, heights = 0;
  for (int i = 0; i < Share(4000); ++i) {
    const int kind = i % kinds;
    const KnownPlane a = any_plane(random, kind), b = any_plane(random, kind);
    const RationalPoint normal = cross(a.rational.normal, b.rational.normal);
    const int toward = dot(a.rational.normal, b.rational.normal).sign();
    EXPECT_EQ(tpa::dot_sign(a.exact, b.exact), toward);
    square += toward == 0;
    parallel += compare(normal, {}) == 0;
    const Vec3 p = any_point(random, kind);
    for (size_t axis = 0; axis < 3; ++axis) {
      const tpa::u32 along = static_cast<tpa::u32>(axis);
      EXPECT_EQ(tpa::cross_sign(along, a.exact, b.exact), normal[axis].sign());
      if (a.rational.normal[axis].sign() == 0 || b.rational.normal[axis].sign() == 0) continue;
      const auto height = [&](const RationalPlane& plane) {
        Rational rest = plane.level;
        for (size_t k = 0; k < 3; ++k)
          if (k != axis) rest = rest - plane.normal[k] * rational(p)[k];
        return rest / plane.normal[axis];
      };
      const int order = compare(height(a.rational), height(b.rational));
      EXPECT_EQ(tpa::compare_heights(along, p, a.exact, b.exact), order);
      level += order == 0;
      ++heights;
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(parallel, Least(25));
  EXPECT_GT(square, Least(100));
  EXPECT_GT(level, Least(100));
  EXPECT_GT(heights, Least(4000));
}

}  // namespace
}  // namespace constructed_point_test
