// SPDX-License-Identifier: MIT
#include "oracle/mesh_oracle.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "oracle/exact.h"
#include "tool/result.h"

namespace support {

// ---------------------------------------------------------------- triangles

namespace {

struct Triangle {
  Point p[3];
};

Triangle TriangleOf(const Mesh& m, uint32_t f) {
  return {{PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
           PositionOf(m, m.triangles[3 * f + 2])}};
}

// Two axes: the triangle's shadow on their plane has an area.
std::pair<size_t, size_t> FlatAxes(const Triangle& t) {
  for (size_t i = 0; i < 3; ++i)
    if (Turn(t.p[0], t.p[1], t.p[2], i, (i + 1) % 3) != 0) return {i, (i + 1) % 3};
  return {0, 1};
}

bool SegmentsMeetFlat(const Point& p, const Point& q, const Point& a, const Point& b, size_t x, size_t y) {
  const int s1 = Turn(p, q, a, x, y), s2 = Turn(p, q, b, x, y), s3 = Turn(a, b, p, x, y), s4 = Turn(a, b, q, x, y);
  if (s1 * s2 > 0 || s3 * s4 > 0) return false;
  if (s1 != 0 || s2 != 0 || s3 != 0 || s4 != 0) return true;
  for (size_t i : {x, y})
    if (std::max(p[i], q[i]) < std::min(a[i], b[i]) || std::max(a[i], b[i]) < std::min(p[i], q[i])) return false;
  return true;
}

bool InsideFlat(const Point& p, const Triangle& t, size_t x, size_t y) {
  bool left = false, right = false;
  for (size_t i = 0; i < 3; ++i) {
    const int s = Turn(t.p[i], t.p[(i + 1) % 3], p, x, y);
    left = left || s > 0;
    right = right || s < 0;
  }
  return !(left && right);
}

bool SegmentMeets(const Point& p, const Point& q, const Triangle& t) {
  const int sp = Side(t.p[0], t.p[1], t.p[2], p), sq = Side(t.p[0], t.p[1], t.p[2], q);
  if (sp * sq > 0) return false;
  if (sp != 0 || sq != 0) {
    bool left = false, right = false;
    for (size_t i = 0; i < 3; ++i) {
      const int s = Side(p, q, t.p[i], t.p[(i + 1) % 3]);
      left = left || s > 0;
      right = right || s < 0;
    }
    return !(left && right);
  }
  const auto [x, y] = FlatAxes(t);
  if (InsideFlat(p, t, x, y) || InsideFlat(q, t, x, y)) return true;
  for (size_t i = 0; i < 3; ++i)
    if (SegmentsMeetFlat(p, q, t.p[i], t.p[(i + 1) % 3], x, y)) return true;
  return false;
}

// The box of a triangle.
struct Extent {
  Point low, high;
};

Extent ExtentOf(const Triangle& t) {
  Extent e{t.p[0], t.p[0]};
  for (size_t c = 1; c < 3; ++c)
    for (size_t i = 0; i < 3; ++i) {
      e.low[i] = std::min(e.low[i], t.p[c][i]);
      e.high[i] = std::max(e.high[i], t.p[c][i]);
    }
  return e;
}

bool AreApart(const Extent& s, const Extent& t) {
  for (size_t i = 0; i < 3; ++i)
    if (s.high[i] < t.low[i] || t.high[i] < s.low[i]) return true;
  return false;
}

}  // namespace

bool TrianglesMeet(const Mesh& m, uint32_t f, uint32_t g) {
  const Triangle s = TriangleOf(m, f), t = TriangleOf(m, g);
  size_t shared = 0, in_s = 0, in_t = 0, alone_s = 0, alone_t = 0;  // corners; sums tell the corner left over
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k)
      if (m.triangles[3 * f + i] == m.triangles[3 * g + k]) {
        ++shared;
        in_s = i;
        in_t = k;
        alone_s += i;
        alone_t += k;
      }
  switch (shared) {
    case 0:
      for (size_t i = 0; i < 3; ++i)
        if (SegmentMeets(s.p[i], s.p[(i + 1) % 3], t) || SegmentMeets(t.p[i], t.p[(i + 1) % 3], s)) return true;
      return false;
    case 1:
      // Common points beyond the vertex reach from the vertex to the opposite side of one triangle.
      return SegmentMeets(s.p[(in_s + 1) % 3], s.p[(in_s + 2) % 3], t) ||
             SegmentMeets(t.p[(in_t + 1) % 3], t.p[(in_t + 2) % 3], s);
    case 2: {
      const size_t i = 3 - alone_s, k = 3 - alone_t;
      const Point &a = s.p[(i + 1) % 3], &b = s.p[(i + 2) % 3], &c = s.p[i], &d = t.p[k];
      if (Side(a, b, c, d) != 0) return false;
      const auto [x, y] = FlatAxes(s);
      return Turn(a, b, c, x, y) * Turn(a, b, d, x, y) >= 0;
    }
    default: return true;
  }
}

Pairs AllMeetingPairs(const Mesh& m) {
  const uint32_t n = TriangleCount(m);
  std::vector<Extent> extents;
  for (uint32_t f = 0; f < n; ++f) extents.push_back(ExtentOf(TriangleOf(m, f)));
  // Each with each, except for triangles apart along x.
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t f, uint32_t g) { return extents[f].low[0] < extents[g].low[0]; });
  Pairs pairs;
  for (uint32_t i = 0; i < n; ++i) {
    const Extent& mine = extents[order[i]];
    for (uint32_t k = i + 1; k < n && extents[order[k]].low[0] <= mine.high[0]; ++k) {
      const auto [f, g] = std::minmax(order[i], order[k]);
      if (!AreApart(mine, extents[order[k]]) && TrianglesMeet(m, f, g)) pairs.emplace_back(f, g);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// ---------------------------------------------------------------- topology

int64_t Topology::Genus() const {
  int64_t sum = 0;
  for (const Component& c : components) sum += c.genus;
  return sum;
}

double Topology::Volume() const {
  double sum = 0;
  for (const Component& c : components) sum += c.volume;
  return sum;
}

std::vector<int64_t> Topology::Genera() const {
  std::vector<int64_t> genera;
  for (const Component& c : components) genera.push_back(c.genus);
  std::sort(genera.begin(), genera.end());
  return genera;
}

namespace {

// The first defect of the mesh as a closed oriented manifold; empty without defects.
std::string DefectOf(const Mesh& m) {
  std::vector<std::map<uint32_t, uint32_t>> following(VertexCount(m));  // of each star: the link's directed edges
  for (size_t f = 0; f < TriangleCount(m); ++f)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = m.triangles[3 * f + i], b = m.triangles[3 * f + (i + 1) % 3],
                     c = m.triangles[3 * f + (i + 2) % 3];
      if (a >= VertexCount(m)) return "index " + std::to_string(a);
      if (a == b) return "vertex twice in triangle " + std::to_string(f);
      if (!following[a].emplace(b, c).second)
        return "edge " + std::to_string(a) + " " + std::to_string(b) + " twice in one direction";
    }
  for (size_t v = 0; v < following.size(); ++v) {
    if (following[v].empty()) return "isolated vertex " + std::to_string(v);
    const uint32_t start = following[v].begin()->first;
    size_t steps = 0;
    uint32_t at = start;
    do {
      const auto next = following[v].find(at);
      if (next == following[v].end()) return "open link of vertex " + std::to_string(v);
      at = next->second;
      ++steps;
    } while (at != start && steps <= following[v].size());
    if (steps != following[v].size()) return "more than one fan at vertex " + std::to_string(v);
  }
  return "";
}

}  // namespace

Topology TopologyOf(const Mesh& m) {
  Topology out;
  out.defect = DefectOf(m);
  if (!out.defect.empty()) return out;
  std::vector<uint32_t> root(VertexCount(m));
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (size_t f = 0; f < m.triangles.size(); f += 3)
    for (size_t i = 1; i < 3; ++i) {
      const uint32_t a = find(m.triangles[f]), b = find(m.triangles[f + i]);
      root[std::max(a, b)] = std::min(a, b);
    }
  std::map<uint32_t, Component> by_root;
  for (uint32_t v = 0; v < VertexCount(m); ++v) {
    Component& c = by_root[find(v)];
    if (c.vertices++ == 0) c.smallest_vertex = v;
  }
  for (uint32_t f = 0; f < TriangleCount(m); ++f) {
    Component& c = by_root[find(m.triangles[3 * f])];
    ++c.triangles;
    const Triangle t = TriangleOf(m, f);
    c.volume += Dot(t.p[0], Cross(t.p[1], t.p[2])) / 6;
  }
  for (auto& [unused, c] : by_root) {
    const int64_t vertices = c.vertices, triangles = c.triangles;
    c.genus = (2 - (vertices - 3 * triangles / 2 + triangles)) / 2;
    out.components.push_back(c);
  }
  return out;
}

double SolidAngle(const Mesh& m, size_t triangle, const Point& p) {
  Point r[3];
  double n[3];
  for (size_t i = 0; i < 3; ++i) {
    r[i] = Difference(PositionOf(m, m.triangles[3 * triangle + i]), p);
    n[i] = Length(r[i]);
  }
  const double below = n[0] * n[1] * n[2] + Dot(r[0], r[1]) * n[2] + Dot(r[1], r[2]) * n[0] + Dot(r[2], r[0]) * n[1];
  return std::atan2(Dot(r[0], Cross(r[1], r[2])), below) / (2 * pi);
}

std::string FaultOf(const Mesh& m) {
  const Topology t = TopologyOf(m);
  if (!t.defect.empty()) return t.defect;
  const Pairs pairs = AllMeetingPairs(m);
  if (pairs.empty()) return "";
  return tool::text_of(pairs.size(), " self-intersections, the first of triangles ", pairs[0].first, " and ",
                       pairs[0].second);
}

testing::AssertionResult IsSound(const Mesh& m, const std::string& name) {
  const std::string fault = FaultOf(m);
  if (fault.empty()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << fault << "; " << Written(m, name);
}

}  // namespace support
