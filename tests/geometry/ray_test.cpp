// SPDX-License-Identifier: MIT
// Rays past triangles and stars, against rays moved literally by an eps small enough for the lattice. Failures print
// the seed and the points.
#include "geometry/ray.h"

#include <gtest/gtest.h>

#include <array>

#include "geometry/predicates.h"
#include "oracle/big_int.h"
#include "oracle/lattice_points.h"
#include "support/share.h"

namespace ray_test {
namespace {

using namespace lattice_points;
using big_int::BigInt;
using big_int::BigVec;
using big_int::det2;
using big_int::det3;
using support::Least;
using support::Share;
using tpa::Vec3;

using Faces = std::vector<std::array<size_t, 3>>;
const Faces octahedron = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
const Faces tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

constexpr long long one = 1ll << 30;  // 1 / eps
BigVec big(LatticePoint g) { return {BigInt(g.x) * one * one, BigInt(g.y) * one * one, BigInt(g.z) * one * one}; }
BigVec moved(LatticePoint g) {
  const BigVec p = big(g);
  return {p.x, p.y + BigInt(one), p.z + BigInt(1)};
}
// How the ray q + t d, t > 0, passes through abc: +1 with the normal, -1 against the normal, 0 not at all. `degenerate`
// is set for a line through an edge or a corner, and for an abc that holds d.
int literal_crossing(const BigVec& q, const BigVec& d, const BigVec& a, const BigVec& b, const BigVec& c,
                     bool& degenerate) {
  const BigVec u = a - q, v = b - q, w = c - q;
  const int s[3] = {det3(d, u, v).sign(), det3(d, v, w).sign(), det3(d, w, u).sign()};
  const int volume = det3(u, v, w).sign();
  degenerate = degenerate || s[0] * s[1] * s[2] == 0;
  if (s[0] == 0 || s[0] != s[1] || s[0] != s[2]) return 0;
  return volume == s[0] ? s[0] : 0;
}
int literal_ray_crossing(LatticePoint p, LatticePoint a, LatticePoint b, LatticePoint c) {
  bool degenerate = false;
  return literal_crossing(moved(p), {1, 0, 0}, big(a), big(b), big(c), degenerate);
}

TEST(Winding, RaysCountTheSameInAllDirections) {
  Random random;
  int inside = 0, tried = 0;
  for (int i = 0; i < Share(8000); ++i) {
    std::vector<LatticePoint> v(6);
    for (auto& g : v) g = random.point(i % 2 ? 6 : 3);
    const LatticePoint p = random.point(i % 2 ? 6 : 3);
    int kind = i % 3, got = 0, other = 0;
    bool on_mesh = false, degenerate = false;
    const BigVec d = {BigInt(random.within(1 << 20)), BigInt(random.within(1 << 20)), BigInt(random.within(1 << 20))};
    for (auto f : octahedron) {
      const LatticePoint a = v[f[0]], b = v[f[1]], c = v[f[2]];
      if ((on_mesh = common_corner({p}, {a, b, c}, anywhere))) break;
      const int crossing =
          tpa::ray_crossing(stretched(p, kind), stretched(a, kind), stretched(b, kind), stretched(c, kind));
      ASSERT_EQ(literal_ray_crossing(p, a, b, c), crossing) << print({p, a, b, c});
      got += crossing;
      bool flat = false;
      other += literal_crossing(big(p), d, big(a), big(b), big(c), flat);
      const BigVec u = big(b) - big(a), w = big(c) - big(a);
      const bool no_area = det2(u.x, u.y, w.x, w.y).sign() == 0 && det2(u.y, u.z, w.y, w.z).sign() == 0 &&
                           det2(u.z, u.x, w.z, w.x).sign() == 0;
      degenerate = degenerate || (flat && !no_area);
    }
    if (on_mesh || degenerate) continue;
    ++tried;
    inside += got != 0;
    ASSERT_EQ(other, got) << print(v) << print({p});
  }
  EXPECT_GT(tried, Least(2000));
  EXPECT_GT(inside, Least(25));
}

// Height of a fan triangle's plane above the point p + (eps, eps^2), as a fraction with positive denominator.
struct Height {
  BigInt over, under;
  int side;
};
// The topmost triangle of the fan over the literally moved point; 2 if two of opposite sides tie.
int literal_top(LatticePoint p, const std::vector<LatticePoint>& link) {
  Height top{0, 1, 0};
  for (size_t i = 0; i < link.size(); ++i) {
    const BigVec q = moved(p), a = big(p) - q, b = big(link[i]) - q, c = big(link[(i + 1) % link.size()]) - q;
    const BigInt wa = det2(b.y, b.z, c.y, c.z), wb = det2(c.y, c.z, a.y, a.z), wc = det2(a.y, a.z, b.y, b.z);
    const int s = wa.sign();
    if (s == 0 || wb.sign() != s || wc.sign() != s) continue;
    Height h{wa * a.x + wb * b.x + wc * c.x, wa + wb + wc, s};
    if (s < 0) h.over = BigInt(0) - h.over, h.under = BigInt(0) - h.under;
    const int above = top.side == 0 ? 1 : (h.over * top.under - top.over * h.under).sign();
    if (above > 0) top = h;
    if (above == 0 && top.side != h.side) top.side = 2;
  }
  return top.side;
}

TEST(Winding, TheTopmostTriangleOfAStarDecides) {
  Random random;
  int answers[3] = {0, 0, 0};
  for (int i = 0; i < Share(30000); ++i) {
    const int n = i % 2 ? 4 : 2;
    const LatticePoint p = random.point(n);
    std::vector<LatticePoint> link(static_cast<size_t>(3 + random.upto(4)));
    for (auto& g : link) g = random.point(n);
    const int want = literal_top(p, link);
    if (want == 2) continue;  // coplanar triangles of opposite sides: the fan meets itself
    ++answers[want + 1];
    std::vector<Vec3> points;
    for (LatticePoint g : link) points.push_back(stretched(g, i % 3));
    ASSERT_EQ(want, tpa::ray_leaves_star(stretched(p, i % 3), points.data(), static_cast<tpa::u32>(points.size())))
        << print({p}) << print(link);
  }
  for (int count : answers) EXPECT_GT(count, Least(1000));
}

// Two half planes along x, given by their directions in the yz plane: the outside lies counter-clockwise from `first`
// to `second`, and the point just beyond the angle 0.
TEST(Winding, FlatStarsHaveTheirOutsideBetweenTheirHalfPlanes) {
  Random random;
  const auto angle = [](LatticePoint d) {
    const double a = std::atan2(double(d.z), double(d.y));
    return a <= 0 ? a + 6.283185307179586 : a;
  };
  int answers[2] = {0, 0};
  for (int i = 0; i < Share(20000); ++i) {
    const LatticePoint p = random.point(3), first = {0, random.within(3), random.within(3)};
    const LatticePoint second =
        i % 3 == 0 ? LatticePoint{0, -first.y, -first.z} : LatticePoint{0, random.within(3), random.within(3)};
    if ((first.y == 0 && first.z == 0) || (second.y == 0 && second.z == 0)) continue;
    const bool in_line = first.y * second.z == first.z * second.y;
    if (in_line && first.y * second.y + first.z * second.z > 0) continue;  // folded flat
    // From ahead of p over the first half plane to behind it, and back over the second.
    std::vector<LatticePoint> link;
    const auto add = [&](long long x, LatticePoint d, long long by) {
      link.push_back({p.x + x, p.y + by * d.y, p.z + by * d.z});
    };
    add(3, first, 0);
    for (long long x = 2; x > -2; x -= 1 + random.upto(1)) add(x, first, 1 + random.upto(1));
    add(-2, first, 0);
    for (long long x = -1; x < 2; x += 1 + random.upto(1)) add(x, second, 1 + random.upto(1));
    const auto n = static_cast<long long>(link.size());
    std::rotate(link.begin(), link.begin() + random.upto(n - 1), link.end());
    const auto side = [&](auto of) {
      std::vector<Vec3> points;
      for (LatticePoint g : link) points.push_back(stretched(g, i % 3));
      return of(stretched(p, i % 3), points.data(), static_cast<tpa::u32>(n));
    };
    const int want = angle(first) > angle(second) ? 1 : -1;
    ASSERT_EQ(want, side(tpa::side_beside_triangle)) << i << print({p, first, second});
    ASSERT_EQ(0, side(tpa::ray_leaves_star)) << i << print({p, first, second});
    ++answers[want > 0 ? 1 : 0];
  }
  for (int count : answers) EXPECT_GT(count, Least(3000));
}

bool has_area(LatticePoint p, LatticePoint u, LatticePoint w) {
  const LatticePoint a = {u.x - p.x, u.y - p.y, u.z - p.z}, b = {w.x - p.x, w.y - p.y, w.z - p.z};
  return a.y * b.z != a.z * b.y || a.z * b.x != a.x * b.z || a.x * b.y != a.y * b.x;
}

// Do all triangles of the fan have an area, and is nothing shared but p and the edges of neighbours?
bool is_unfolded(LatticePoint p, const std::vector<LatticePoint>& link) {
  const size_t n = link.size();
  for (size_t i = 0; i < n; ++i) {
    if (!has_area(p, link[i], link[(i + 1) % n])) return false;
    for (size_t k = i + 1; k < n; ++k) {
      const auto beyond = [&](CommonPoint c) {
        return !is_at(c, p) && !(k == i + 1 && is_on_segment(c, p, link[k])) &&
               !((k + 1) % n == i && is_on_segment(c, p, link[i]));
      };
      if (common_corner({p, link[i], link[(i + 1) % n]}, {p, link[k], link[(k + 1) % n]}, beyond)) return false;
    }
  }
  return true;
}

// The side of the fan, with triangles extended without end, of a point a little along the ray from the moved point. The
// way from there to a random point of some triangle first meets a triangle of the fan; its side facing the way is the
// answer. 0 if the way meets an edge.
int literal_side(Random& random, LatticePoint p, const std::vector<LatticePoint>& link) {
  const size_t n = link.size();
  const BigVec start = moved(p);
  const BigVec q = {start.x + BigInt(one) * (1 << 20), start.y, start.z}, r = q - big(p);
  const auto spoke = [&](size_t i) { return big(link[i % n]) - big(p); };
  const auto along = [](const BigVec& u, const BigInt& a, const BigVec& w, const BigInt& b, const BigVec& minus) {
    return BigVec{u.x * a + w.x * b - minus.x, u.y * a + w.y * b - minus.y, u.z * a + w.z * b - minus.z};
  };
  const size_t at = static_cast<size_t>(random.upto(static_cast<long long>(n) - 1));
  const BigInt of_first(1 + random.upto(1000)), of_second(1 + random.upto(1000));
  const BigVec d = along(spoke(at), of_first, spoke(at + 1), of_second, r);
  const BigVec none{BigInt(0), BigInt(0), BigInt(0)}, back = none - d;
  BigInt over(0), under(1);
  int side = 0;
  for (size_t i = 0; i < n; ++i) {
    // a u + b w - t d = r
    const BigVec u = spoke(i), w = spoke(i + 1);
    const BigInt all = det3(u, w, back), a = det3(r, w, back), b = det3(u, r, back), t = det3(u, w, r);
    const int s = all.sign();
    if (s == 0 || a.sign() * b.sign() == 0) return 0;
    if (a.sign() != s || b.sign() != s || t.sign() != s) continue;
    const BigInt sign(s);
    if (side != 0 && (t * sign * under - over * (all * sign)).sign() >= 0) continue;
    over = t * sign;
    under = all * sign;
    side = s;
  }
  return side;
}

// Stars on a lattice, mostly with triangles in lattice planes. A triangle beside the ray is right also in stars with a
// topmost triangle.
TEST(Winding, EveryStarTellsItsSide) {
  Random random;
  int above = 0, by_triangle = 0, by_corner = 0, outside = 0;
  for (int i = 0; i < Share(60000); ++i) {
    const LatticePoint p = {2, 2, i % 2 ? 2 : 1};
    std::vector<LatticePoint> link(static_cast<size_t>(3 + random.upto(3)));
    for (auto& g : link) g = {random.upto(4), random.upto(4), random.upto(2)};
    if (!is_unfolded(p, link)) continue;
    std::vector<Vec3> points;
    for (LatticePoint g : link) points.push_back(stretched(g, i % 3));
    const auto side_by = [&](auto of) {
      return of(stretched(p, i % 3), points.data(), static_cast<tpa::u32>(points.size()));
    };
    int want = 0;
    for (int k = 0; k < 50 && want == 0; ++k) want = literal_side(random, p, link);
    ASSERT_NE(want, 0) << i << print({p}) << print(link);
    const int top = side_by(tpa::ray_leaves_star), beside = side_by(tpa::side_beside_triangle);
    if (top != 0) {
      ASSERT_EQ(want, top) << i << print({p}) << print(link);
    }
    if (beside != 0) {
      ASSERT_EQ(want, beside) << i << print({p}) << print(link);
    }
    if (top == 0 && beside == 0) {
      ASSERT_EQ(want, side_by(tpa::side_beside_corner)) << i << print({p}) << print(link);
    }
    ++(top != 0 ? above : beside != 0 ? by_triangle : by_corner);
    outside += want > 0 ? 1 : 0;
  }
  EXPECT_GT(above, Least(5000));
  EXPECT_GT(by_triangle, Least(2000));
  EXPECT_GT(by_corner, Least(10000));
  EXPECT_GT(outside, Least(10000));
  EXPECT_GT(above + by_triangle + by_corner - outside, Least(10000));
}

TEST(Winding, RaysStayInsideConvexCornersOnlyWhereTheyOpenUpward) {
  Random random;
  int outward = 0, inward = 0;
  for (int i = 0; i < Share(20000); ++i) {
    Vec3 v[4];
    for (auto& p : v) p = {random.unit(), random.unit(), random.unit()};
    if (tpa::orient3d(v[0], v[1], v[2], v[3]) < 0) std::swap(v[0], v[1]);
    for (size_t k = 0; k < 4; ++k) {
      std::vector<Vec3> link;  // the faces at k in order: each ends where the next begins
      size_t first = 4, at = 4;
      do {
        for (auto f : tetrahedron) {
          for (size_t r = 0; r < 3; ++r) {
            if (f[r] != k || (at != 4 && f[(r + 1) % 3] != at)) continue;
            if (at == 4) first = f[(r + 1) % 3];
            link.push_back(v[f[(r + 1) % 3]]);
            at = f[(r + 2) % 3];
            goto found;
          }
        }
      found:;
      } while (at != first);
      const int side = tpa::ray_leaves_star(v[k], link.data(), static_cast<tpa::u32>(link.size()));
      bool upward = true;  // does the solid hold the points just above the corner?
      for (size_t r = 0; r < link.size(); ++r) {
        const Vec3 &u = link[r], &w = link[(r + 1) % link.size()];
        upward = upward && big_int::orientation(v[k].y, v[k].z, u.y, u.z, w.y, w.z) < 0;
      }
      ASSERT_TRUE(upward ? side == -1 : side >= 0) << "seed " << seed << " case " << i;
      (upward ? inward : outward) += side != 0;
    }
  }
  EXPECT_GT(outward, Least(10000));
  EXPECT_GT(inward, Least(100));
}

}  // namespace
}  // namespace ray_test
