// predicates: every answer against an oracle that shares no code with it.
// Orientations are evaluated in integers of any size (doubles are dyadic rationals). Meeting triangles are a
// linear programme over barycentric coordinates, solved by listing all basic solutions in rationals. The
// symbolic ray is moved literally, by an eps small enough for the lattice. Failures print the seed and the
// points.
#include "../src/predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>
#include <vector>

namespace {

using tpa::Vec3;
using i128 = __int128;

constexpr unsigned seed = 20250611;

// ---- integers of any size ----
struct BigInt {
  bool negative = false;
  std::vector<uint32_t> limb;  // little endian, no leading zeros
  BigInt() = default;
  BigInt(long long v) : negative(v < 0) {
    auto m = negative ? 0 - static_cast<unsigned long long>(v) : static_cast<unsigned long long>(v);
    for (; m; m >>= 32) limb.push_back(static_cast<uint32_t>(m));
  }
  int sign() const { return limb.empty() ? 0 : negative ? -1 : 1; }
  void trim() {
    while (!limb.empty() && limb.back() == 0) limb.pop_back();
  }
};
int compare_size(const BigInt& a, const BigInt& b) {
  if (a.limb.size() != b.limb.size()) return a.limb.size() < b.limb.size() ? -1 : 1;
  for (size_t i = a.limb.size(); i-- > 0;) {
    if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i] ? -1 : 1;
  }
  return 0;
}
BigInt add(const BigInt& a, const BigInt& b, bool b_negative) {
  BigInt r;
  const bool same = a.negative == b_negative;
  const bool a_first = compare_size(a, b) >= 0;
  const BigInt &big = a_first ? a : b, &small = a_first ? b : a;
  r.negative = a_first ? a.negative : b_negative;
  long long carry = 0;
  for (size_t i = 0; i < big.limb.size(); ++i) {
    const long long s = i < small.limb.size() ? small.limb[i] : 0;
    long long v = static_cast<long long>(big.limb[i]) + (same ? s : -s) + carry;
    carry = v >> 32;
    r.limb.push_back(static_cast<uint32_t>(v & 0xFFFFFFFFll));
  }
  if (carry > 0) r.limb.push_back(static_cast<uint32_t>(carry));
  r.trim();
  return r;
}
BigInt operator+(const BigInt& a, const BigInt& b) { return add(a, b, b.negative); }
BigInt operator-(const BigInt& a, const BigInt& b) { return add(a, b, !b.negative); }
BigInt operator*(const BigInt& a, const BigInt& b) {
  BigInt r;
  r.negative = a.negative != b.negative;
  r.limb.assign(a.limb.size() + b.limb.size(), 0);
  for (size_t i = 0; i < a.limb.size(); ++i) {
    uint64_t carry = 0;
    for (size_t j = 0; j < b.limb.size() || carry; ++j) {
      const uint64_t p = j < b.limb.size() ? uint64_t{a.limb[i]} * b.limb[j] : 0;
      const uint64_t v = p + r.limb[i + j] + carry;
      r.limb[i + j] = static_cast<uint32_t>(v);
      carry = v >> 32;
    }
  }
  r.trim();
  return r;
}
// 2^160 x, an integer for every coordinate in range.
BigInt scaled(double x) {
  int e = 0;
  const double m = std::frexp(x, &e);  // m 2^53 is an integer
  BigInt r(static_cast<long long>(std::ldexp(m, 53)));
  int shift = e - 53 + 160;
  for (; shift >= 30; shift -= 30) r = r * BigInt(1ll << 30);
  return r * BigInt(1ll << shift);
}

struct BigVec {
  BigInt x, y, z;
};
BigVec operator-(const BigVec& a, const BigVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
BigVec scaled(const Vec3& a) { return {scaled(a.x), scaled(a.y), scaled(a.z)}; }
BigInt det2(const BigInt& a, const BigInt& b, const BigInt& c, const BigInt& d) { return a * d - b * c; }
BigInt det3(const BigVec& u, const BigVec& v, const BigVec& w) {
  return u.x * det2(v.y, v.z, w.y, w.z) - u.y * det2(v.x, v.z, w.x, w.z) + u.z * det2(v.x, v.y, w.x, w.y);
}
int oracle2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const BigInt x = scaled(ax), y = scaled(ay);
  return det2(scaled(bx) - x, scaled(by) - y, scaled(cx) - x, scaled(cy) - y).sign();
}
int oracle3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const BigVec o = scaled(a);
  return det3(scaled(b) - o, scaled(c) - o, scaled(d) - o).sign();
}

// ---- points in common, as a linear programme ----
struct Grid {
  long long x, y, z;
};
Vec3 vec(Grid g) { return {static_cast<double>(g.x), static_cast<double>(g.y), static_cast<double>(g.z)}; }
struct CommonPoint {
  long long x, y, z, w;  // w > 0, the point is (x, y, z) / w
};

// Cramer-free elimination: solves the 5 rows for the chosen columns, true if they are independent and
// consistent.
bool solve(std::array<std::array<long long, 7>, 5> m, int columns, std::array<long long, 7>& x,
           long long& w) {
  long long previous = 1;  // Bareiss: all divisions are exact
  for (int c = 0; c < columns; ++c) {
    int pivot = c;
    while (pivot < 5 && m[size_t(pivot)][size_t(c)] == 0) ++pivot;
    if (pivot == 5) return false;
    std::swap(m[size_t(c)], m[size_t(pivot)]);
    for (int r = 0; r < 5; ++r) {
      if (r == c) continue;
      for (int k = 6; k >= 0; --k) {
        if (k == c) continue;
        auto& e = m[size_t(r)][size_t(k)];
        e = (e * m[size_t(c)][size_t(c)] - m[size_t(r)][size_t(c)] * m[size_t(c)][size_t(k)]) / previous;
      }
      m[size_t(r)][size_t(c)] = 0;
    }
    previous = m[size_t(c)][size_t(c)];
    for (int r = 0; r < c; ++r) m[size_t(r)][size_t(r)] = previous;
  }
  for (int r = columns; r < 5; ++r) {
    if (m[size_t(r)][6] != 0) return false;
  }
  w = previous;
  for (int c = 0; c < columns; ++c) x[size_t(c)] = m[size_t(c)][6];
  return true;
}

// Is there a corner of the common point set of hull(p) and hull(q), each of up to three points, that `wanted`
// takes?
bool common_corner(const std::vector<Grid>& p, const std::vector<Grid>& q,
                   const std::function<bool(CommonPoint)>& wanted) {
  const size_t n = p.size(), all = n + q.size();
  for (unsigned set = 1; set < 1u << all; ++set) {
    std::array<std::array<long long, 7>, 5> m{};
    std::vector<size_t> chosen;
    for (size_t i = 0; i < all; ++i) {
      if (!(set >> i & 1)) continue;
      const Grid g = i < n ? p[i] : q[i - n];
      const long long s = i < n ? 1 : -1;
      const size_t c = chosen.size();
      m[0][c] = s * g.x, m[1][c] = s * g.y, m[2][c] = s * g.z, m[3][c] = i < n, m[4][c] = i >= n;
      chosen.push_back(i);
    }
    m[3][6] = m[4][6] = 1;
    std::array<long long, 7> x{};
    long long w = 0;
    if (chosen.size() > 5 || !solve(m, static_cast<int>(chosen.size()), x, w)) continue;
    CommonPoint point{0, 0, 0, w < 0 ? -w : w};
    bool inside = true;
    for (size_t c = 0; c < chosen.size(); ++c) {
      const long long weight = w < 0 ? -x[c] : x[c];
      inside = inside && weight >= 0;
      if (chosen[c] >= n) continue;
      const Grid g = p[chosen[c]];
      point.x += weight * g.x, point.y += weight * g.y, point.z += weight * g.z;
    }
    if (inside && wanted(point)) return true;
  }
  return false;
}
bool anywhere(CommonPoint) { return true; }
bool is_at(CommonPoint p, Grid g) { return p.x == g.x * p.w && p.y == g.y * p.w && p.z == g.z * p.w; }
bool is_on_segment(CommonPoint p, Grid u, Grid v) {
  const long long a[3] = {p.x - u.x * p.w, p.y - u.y * p.w, p.z - u.z * p.w},
                  d[3] = {v.x - u.x, v.y - u.y, v.z - u.z};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (a[i] * d[j] != a[j] * d[i]) return false;
    if (d[i] == 0 && a[i] != 0) return false;
    if (a[i] * d[i] < 0 || (d[i] > 0 ? a[i] > d[i] * p.w : a[i] < d[i] * p.w)) return false;
  }
  return true;
}

std::string print(const std::vector<Grid>& points) {
  std::ostringstream s;
  s << "seed " << seed << ":";
  for (Grid g : points) s << " (" << g.x << "," << g.y << "," << g.z << ")";
  return s.str();
}

struct Random {
  std::mt19937_64 engine{seed};
  long long upto(long long n) { return static_cast<long long>(engine() % static_cast<uint64_t>(n + 1)); }
  long long within(long long n) { return upto(2 * n) - n; }
  Grid grid(long long n) { return {upto(n), upto(n), upto(n)}; }
  double unit() { return static_cast<double>(engine() >> 11) * 0x1p-53; }
  double any_magnitude() {
    const double m = (1 + unit()) * std::ldexp(1.0, static_cast<int>(within(100)));
    return (engine() & 1) ? -std::min(m, 0x1p100) : std::min(m, 0x1p100);
  }
};

// An exact affine map per axis that leaves every answer as it is, but fills mantissas and magnitudes.
Vec3 stretched(Grid g, int kind) {
  const Vec3 v = vec(g);
  if (kind == 0) return v;
  if (kind == 1) return {3 + v.x * 0x1p-51, v.y * 0x1p-100, v.z * 0x1p97};
  return {-1 + v.x * 0x1p-52, 1 + v.y * 0x1p-51, 1e9 + v.z * 0x1p-22};
}

}  // namespace

TEST(Orientation, IntegersAgreeWithInt128) {
  Random random;
  for (int i = 0; i < 300000; ++i) {
    const long long n = i % 3 == 0 ? 2 : i % 3 == 1 ? 1000 : 1ll << 30;
    long long c[6];
    for (auto& v : c) v = random.within(n);
    if (i % 4 == 0) c[4] = c[0] + 3 * (c[2] - c[0]) + random.within(1), c[5] = c[1] + 3 * (c[3] - c[1]);
    const i128 d = i128(c[2] - c[0]) * (c[5] - c[1]) - i128(c[3] - c[1]) * (c[4] - c[0]);
    const int want = (d > 0) - (d < 0);
    ASSERT_EQ(want, tpa::orient2d(double(c[0]), double(c[1]), double(c[2]), double(c[3]), double(c[4]),
                                  double(c[5])))
        << "seed " << seed << " case " << i;
  }
}

TEST(Orientation, NearlyFlatIntegersAgreeInSpace) {
  Random random;
  for (int i = 0; i < 300000; ++i) {
    const long long n = i % 3 == 0 ? 2 : i % 3 == 1 ? 1000 : 1ll << 30;
    Grid g[4];
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
    const auto x = [](Grid v) { return v.x; };
    const auto y = [](Grid v) { return v.y; };
    const auto z = [](Grid v) { return v.z; };
    const i128 d = cofactor(y, z) * (g[3].x - g[0].x) + cofactor(z, x) * (g[3].y - g[0].y) +
                   cofactor(x, y) * (g[3].z - g[0].z);
    ASSERT_EQ((d > 0) - (d < 0), tpa::orient3d(vec(g[0]), vec(g[1]), vec(g[2]), vec(g[3])))
        << print({g[0], g[1], g[2], g[3]});
  }
}

TEST(Orientation, DoublesOfAllMagnitudesAgreeWithBigIntegers) {
  Random random;
  for (int i = 0; i < 40000; ++i) {
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
    ASSERT_EQ(oracle2d(c[0], c[1], c[2], c[3], c[4], c[5]), tpa::orient2d(c[0], c[1], c[2], c[3], c[4], c[5]))
        << "seed " << seed << " case " << i;
    ASSERT_EQ(oracle3d(p[0], p[1], p[2], p[3]), tpa::orient3d(p[0], p[1], p[2], p[3]))
        << "seed " << seed << " case " << i;
    ASSERT_EQ(oracle3d(p[0], p[1], p[2], p[3]), tpa::orient3d_exact(p[0], p[1], p[2], p[3]))
        << "seed " << seed;
    ASSERT_EQ(oracle3d(p[0], p[1], p[2], p[3]), -tpa::orient3d(p[1], p[0], p[2], p[3])) << "seed " << seed;
  }
}

TEST(Triangles, MeetWhereTheLinearProgrammeSaysSo) {
  Random random;
  int met = 0;
  for (int i = 0; i < 50000; ++i) {
    std::vector<Grid> a(3), b(3);
    for (auto& g : a) g = random.grid(i % 2 ? 3 : 2);
    for (auto& g : b) g = random.grid(i % 2 ? 3 : 2);
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
    ASSERT_EQ(common_corner({a[0], a[1]}, b, anywhere),
              tpa::segment_meets_triangle(s[0], s[1], t[0], t[1], t[2]))
        << print({a[0], a[1], b[0], b[1], b[2]});
  }
  EXPECT_GT(met, 5000);
}

TEST(Triangles, MeetBeyondASharedVertex) {
  Random random;
  for (int i = 0; i < 50000; ++i) {
    const int n = i % 2 ? 3 : 2;
    const Grid v = random.grid(n), a1 = random.grid(n), b1 = random.grid(n);
    Grid a2 = random.grid(n), b2 = random.grid(n);
    if (i % 5 == 0) a2 = {2 * v.x - a1.x, 2 * v.y - a1.y, 2 * v.z - a1.z};
    if (i % 7 == 0) b2 = i % 3 ? b1 : v;
    const bool want = common_corner({v, a1, a2}, {v, b1, b2}, [&](CommonPoint p) { return !is_at(p, v); });
    ASSERT_EQ(want, tpa::triangles_meet_beyond_vertex(stretched(v, i % 3), stretched(a1, i % 3),
                                                      stretched(a2, i % 3), stretched(b1, i % 3),
                                                      stretched(b2, i % 3)))
        << print({v, a1, a2, b1, b2});
  }
}

TEST(Triangles, MeetBeyondASharedEdge) {
  Random random;
  for (int i = 0; i < 50000; ++i) {
    const int n = i % 2 ? 3 : 1;
    const Grid u = random.grid(n), oa = random.grid(n);
    Grid v = random.grid(n), ob = random.grid(n);
    if (i % 5 == 0) v = u;
    if (i % 4 == 0) ob = {u.x + oa.x - v.x, u.y + oa.y - v.y, u.z + oa.z - v.z};
    if (i % 9 == 0)
      v = {2 * u.x - oa.x, 2 * u.y - oa.y, 2 * u.z - oa.z},
      ob = {3 * u.x - 2 * oa.x, 3 * u.y - 2 * oa.y, 3 * u.z - 2 * oa.z};
    const bool want =
        common_corner({u, v, oa}, {v, u, ob}, [&](CommonPoint p) { return !is_on_segment(p, u, v); });
    ASSERT_EQ(want, tpa::triangles_meet_beyond_edge(stretched(u, i % 3), stretched(v, i % 3),
                                                    stretched(oa, i % 3), stretched(ob, i % 3)))
        << print({u, v, oa, ob});
  }
}

// ---- rays ----
namespace {

using Faces = std::vector<std::array<size_t, 3>>;
const Faces octahedron = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                          {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
const Faces tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

constexpr long long one = 1ll << 30;  // 1 / eps
BigVec big(Grid g) { return {BigInt(g.x) * one * one, BigInt(g.y) * one * one, BigInt(g.z) * one * one}; }
BigVec moved(Grid g) {
  const BigVec p = big(g);
  return {p.x, p.y + BigInt(one), p.z + BigInt(1)};
}
// Where the line q + t d passes through abc: +1 towards the normal's side at t > 0, -1 against it, 0 not at
// all. `weight` are the volumes that the line forms with bc, ca and ab. Nothing may be degenerate, unless abc
// holds d.
int literal_crossing(const BigVec& q, const BigVec& d, const BigVec& a, const BigVec& b, const BigVec& c,
                     bool& degenerate) {
  const BigVec u = a - q, v = b - q, w = c - q;
  const int s[3] = {det3(d, u, v).sign(), det3(d, v, w).sign(), det3(d, w, u).sign()};
  const int volume = det3(u, v, w).sign();
  degenerate = degenerate || s[0] * s[1] * s[2] == 0;
  if (s[0] == 0 || s[0] != s[1] || s[0] != s[2]) return 0;
  return volume == s[0] ? s[0] : 0;
}
int literal_ray_crossing(Grid p, Grid a, Grid b, Grid c) {
  bool degenerate = false;
  return literal_crossing(moved(p), {1, 0, 0}, big(a), big(b), big(c), degenerate);
}

}  // namespace

TEST(Winding, RaysCountTheSameInAllDirections) {
  Random random;
  int inside = 0, tried = 0;
  for (int i = 0; i < 8000; ++i) {
    std::vector<Grid> v(6);
    for (auto& g : v) g = random.grid(i % 2 ? 6 : 3);
    const Grid p = random.grid(i % 2 ? 6 : 3);
    int kind = i % 3, got = 0, other = 0;
    bool on_mesh = false, degenerate = false;
    const BigVec d = {BigInt(random.within(1 << 20)), BigInt(random.within(1 << 20)),
                      BigInt(random.within(1 << 20))};
    for (auto f : octahedron) {
      const Grid a = v[f[0]], b = v[f[1]], c = v[f[2]];
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
  EXPECT_GT(tried, 2000);
  EXPECT_GT(inside, 25);
}

namespace {

// Height above the point p + (eps, eps^2) of the fan triangle's plane, as a fraction with positive
// denominator.
struct Height {
  BigInt over, under;
  int side;
};
// The topmost triangle of the fan over the literally moved point; 2 if two of opposite sides tie.
int literal_top(Grid p, const std::vector<Grid>& link) {
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

}  // namespace

TEST(Winding, TheTopmostSheetOfAStarDecides) {
  Random random;
  int answers[3] = {0, 0, 0};
  for (int i = 0; i < 30000; ++i) {
    const int n = i % 2 ? 4 : 2;
    const Grid p = random.grid(n);
    std::vector<Grid> link(static_cast<size_t>(3 + random.upto(4)));
    for (auto& g : link) g = random.grid(n);
    const int want = literal_top(p, link);
    if (want == 2) continue;  // coplanar sheets of opposite sides: the fan meets itself
    ++answers[want + 1];
    std::vector<Vec3> points;
    for (Grid g : link) points.push_back(stretched(g, i % 3));
    ASSERT_EQ(want,
              tpa::ray_leaves_star(stretched(p, i % 3), points.data(), static_cast<tpa::u32>(points.size())))
        << print({p}) << print(link);
  }
  for (int count : answers) EXPECT_GT(count, 1000);
}

// Two half planes along x, given by their directions in the yz plane, angle by angle: the outside is what is passed
// from `first` counter-clockwise to `second`, and the point lies just beyond the angle 0.
TEST(Winding, FlatStarsHaveTheirOutsideBetweenTheirHalfPlanes) {
  Random random;
  const auto angle = [](Grid d) {
    const double a = std::atan2(double(d.z), double(d.y));
    return a <= 0 ? a + 6.283185307179586 : a;
  };
  int answers[3] = {0, 0, 0};
  for (int i = 0; i < 20000; ++i) {
    const Grid p = random.grid(3), first = {0, random.within(3), random.within(3)};
    const Grid second = i % 3 == 0 ? Grid{0, -first.y, -first.z} : Grid{0, random.within(3), random.within(3)};
    if ((first.y == 0 && first.z == 0) || (second.y == 0 && second.z == 0)) continue;
    const bool in_line = first.y * second.z == first.z * second.y;
    if (in_line && first.y * second.y + first.z * second.z > 0) continue;  // folded flat
    // From ahead of p over the first half plane to behind it, and back over the second.
    std::vector<Grid> link;
    const auto add = [&](long long x, Grid d, long long by) { link.push_back({p.x + x, p.y + by * d.y, p.z + by * d.z}); };
    add(3, first, 0);
    for (long long x = 2; x > -2; x -= 1 + random.upto(1)) add(x, first, 1 + random.upto(1));
    add(-2, first, 0);
    for (long long x = -1; x < 2; x += 1 + random.upto(1)) add(x, second, 1 + random.upto(1));
    const auto n = static_cast<long long>(link.size());
    std::rotate(link.begin(), link.begin() + random.upto(n - 1), link.end());
    const auto side = [&](auto of) {
      std::vector<Vec3> points;
      for (Grid g : link) points.push_back(stretched(g, i % 3));
      return of(stretched(p, i % 3), points.data(), static_cast<tpa::u32>(n));
    };
    const int want = angle(first) > angle(second) ? 1 : -1;
    ASSERT_EQ(want, side(tpa::side_of_flat_star)) << i << print({p, first, second});
    ASSERT_EQ(0, side(tpa::ray_leaves_star)) << i << print({p, first, second});
    ++answers[want + 1];
    Grid& bent = link[static_cast<size_t>(random.upto(n - 1))];
    bent.y += first.z * (bent.x + 7), bent.z -= first.y * (bent.x + 7);  // off both half planes, or beside the line
    if (side(tpa::side_of_flat_star) == 0) ++answers[1];
  }
  for (int count : answers) EXPECT_GT(count, 3000);
}

TEST(Winding, RaysStayInsideConvexCornersOnlyWhereTheyOpenUpward) {
  Random random;
  int outward = 0, inward = 0;
  for (int i = 0; i < 20000; ++i) {
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
        upward = upward && oracle2d(v[k].y, v[k].z, u.y, u.z, w.y, w.z) < 0;
      }
      ASSERT_TRUE(upward ? side == -1 : side >= 0) << "seed " << seed << " case " << i;
      (upward ? inward : outward) += side != 0;
    }
  }
  EXPECT_GT(outward, 10000);
  EXPECT_GT(inward, 100);
}

// ---- stars ----
namespace {

bool star_meets_itself(const Vec3& p, const std::vector<Vec3>& link) {
  const size_t n = link.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 1; j < n; ++j) {
      const Vec3 &a1 = link[i], &a2 = link[(i + 1) % n], &b1 = link[j], &b2 = link[(j + 1) % n];
      if ((i + 1) % n == j && tpa::triangles_meet_beyond_edge(p, a2, a1, b2)) return true;
      if ((j + 1) % n == i && tpa::triangles_meet_beyond_edge(p, b2, b1, a2)) return true;
      if ((i + 1) % n != j && (j + 1) % n != i && tpa::triangles_meet_beyond_vertex(p, a1, a2, b1, b2))
        return true;
    }
  }
  return false;
}
// A star of n corners that goes `rounds` times round p, raised and shaken by `rough`, turned at random.
std::vector<Vec3> star(Random& random, const Vec3& p, size_t n, int rounds, double rough) {
  const double t = 6.283185307179586, a = t * random.unit(), b = t * random.unit(),
               slope = random.unit() - 0.5;
  std::vector<Vec3> link;
  for (size_t i = 0; i < n; ++i) {
    const double angle = t * rounds * (double(i) + rough * (random.unit() - 0.5)) / double(n);
    const double r = 1 + rough * (random.unit() - 0.5);
    const double x = r * std::cos(angle), y = r * std::sin(angle),
                 z = slope * r + rough * (random.unit() - 0.5);
    const double y2 = y * std::cos(a) - z * std::sin(a), z2 = y * std::sin(a) + z * std::cos(a);
    link.push_back(p + Vec3{x * std::cos(b) - z2 * std::sin(b), y2, x * std::sin(b) + z2 * std::cos(b)});
  }
  return link;
}

}  // namespace

TEST(Stars, ProvenOnesDoNotMeetThemselves) {
  Random random;
  int proven = 0, folded = 0;
  for (int i = 0; i < 100000; ++i) {
    const size_t n = static_cast<size_t>(3 + random.upto(6));
    Vec3 p = {random.unit(), random.unit(), random.unit()};
    std::vector<Vec3> link;
    if (i % 3 == 0) {  // lattice, often flat
      p = vec(random.grid(4));
      for (size_t k = 0; k < n; ++k) link.push_back(vec(random.grid(4)));
      if (i % 2) p.z = 2;
      for (auto& l : link) l.z = i % 2 ? 2 : l.z;
    } else {
      link = star(random, p, n, i % 5 == 0 ? 2 : 1, i % 3 == 1 ? 0.5 : 3.0);
    }
    const bool meets = star_meets_itself(p, link);
    const bool unfolded = tpa::star_is_unfolded(p, link.data(), static_cast<tpa::u32>(n));
    proven += unfolded;
    folded += meets;
    ASSERT_FALSE(unfolded && meets) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(proven, 10000);
  EXPECT_GT(folded, 10000);
}

TEST(Stars, SmoothOnesAreProven) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const size_t n = static_cast<size_t>(3 + random.upto(61));
    const Vec3 p = {10 * random.unit(), random.unit(), -random.unit()};
    const auto link = star(random, p, n, 1, n < 8 ? 0.2 : 0.02);
    ASSERT_TRUE(tpa::star_is_unfolded(p, link.data(), static_cast<tpa::u32>(n)))
        << "seed " << seed << " case " << i;
    if (n < 5) continue;  // two rounds of fewer corners are one round the other way
    const auto twice = star(random, p, n, 2, 0.02);
    ASSERT_FALSE(tpa::star_is_unfolded(p, twice.data(), static_cast<tpa::u32>(n)))
        << "seed " << seed << " case " << i;
  }
}

TEST(Stars, RegularGridsAreProven) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 p = {1, 1, 1};
    const int step[6][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}};
    std::vector<Vec3> link(6, p);
    for (size_t i = 0; i < 6; ++i) {
      link[i][(axis + 1) % 3] += step[i][0];
      link[i][(axis + 2) % 3] += step[i][1];
    }
    EXPECT_TRUE(tpa::star_is_unfolded(p, link.data(), 6));
    std::swap(link[1], link[2]);
    EXPECT_FALSE(tpa::star_is_unfolded(p, link.data(), 6));
    EXPECT_FALSE(tpa::star_is_unfolded(p, link.data(), 2));
  }
}
