// SPDX-License-Identifier: MIT
#include "oracle/lattice_points.h"

#include <array>
#include <sstream>

namespace lattice_points {

Coordinates vec(LatticePoint g) {
  return {static_cast<double>(g.x), static_cast<double>(g.y), static_cast<double>(g.z)};
}

Coordinates stretched(LatticePoint g, int kind) {
  const Coordinates v = vec(g);
  if (kind == 0) return v;
  if (kind == 1) return {3 + v.x * 0x1p-51, v.y * 0x1p-100, v.z * 0x1p97};
  return {-1 + v.x * 0x1p-52, 1 + v.y * 0x1p-51, 1e9 + v.z * 0x1p-22};
}

std::string print(const std::vector<LatticePoint>& points) {
  std::ostringstream s;
  s << "seed " << seed << ":";
  for (LatticePoint g : points) s << " (" << g.x << "," << g.y << "," << g.z << ")";
  return s.str();
}

namespace {

// Cramer-free elimination: solves the 5 rows for the chosen columns, true if they are independent and
// consistent.
bool solve(std::array<std::array<long long, 7>, 5> m, int columns, std::array<long long, 7>& x, long long& w) {
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

}  // namespace

bool common_corner(const std::vector<LatticePoint>& p, const std::vector<LatticePoint>& q,
                   const std::function<bool(CommonPoint)>& wanted) {
  const size_t n = p.size(), all = n + q.size();
  for (unsigned set = 1; set < 1u << all; ++set) {
    std::array<std::array<long long, 7>, 5> m{};
    std::vector<size_t> chosen;
    for (size_t i = 0; i < all; ++i) {
      if (!(set >> i & 1)) continue;
      const LatticePoint g = i < n ? p[i] : q[i - n];
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
      const LatticePoint g = p[chosen[c]];
      point.x += weight * g.x, point.y += weight * g.y, point.z += weight * g.z;
    }
    if (inside && wanted(point)) return true;
  }
  return false;
}

bool anywhere(CommonPoint) { return true; }
bool is_at(CommonPoint p, LatticePoint g) { return p.x == g.x * p.w && p.y == g.y * p.w && p.z == g.z * p.w; }
bool is_on_segment(CommonPoint p, LatticePoint u, LatticePoint v) {
  const long long a[3] = {p.x - u.x * p.w, p.y - u.y * p.w, p.z - u.z * p.w}, d[3] = {v.x - u.x, v.y - u.y, v.z - u.z};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (a[i] * d[j] != a[j] * d[i]) return false;
    if (d[i] == 0 && a[i] != 0) return false;
    if (a[i] * d[i] < 0 || (d[i] > 0 ? a[i] > d[i] * p.w : a[i] < d[i] * p.w)) return false;
  }
  return true;
}

}  // namespace lattice_points
