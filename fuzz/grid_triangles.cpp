// SPDX-License-Identifier: MIT
#include "grid_triangles.h"

#include <vector>

namespace fuzz {

namespace {

GridPoint Minus(const GridPoint& a, const GridPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
int64_t Dot(const GridPoint& a, const GridPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
GridPoint Cross(const GridPoint& a, const GridPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool IsZero(const GridPoint& a) { return a == GridPoint{0, 0, 0}; }

// over / under, with under > 0.
struct RationalPoint {
  GridPoint over;
  int64_t under = 1;
  // under * (p - a)
  GridPoint From(const GridPoint& a) const {
    return {over[0] - under * a[0], over[1] - under * a[1], over[2] - under * a[2]};
  }
};

bool IsOnSegment(const RationalPoint& p, const GridPoint& a, const GridPoint& b) {
  const GridPoint from_a = p.From(a), from_b = p.From(b), way = Minus(b, a);
  return IsZero(Cross(from_a, way)) && Dot(from_a, from_b) <= 0 && (!IsZero(way) || IsZero(from_a));
}

bool IsInTriangle(const RationalPoint& p, const GridTriangle& t) {
  const GridPoint normal = Cross(Minus(t.at[1], t.at[0]), Minus(t.at[2], t.at[0]));
  for (size_t i = 0; i < 3; ++i)
    if (IsOnSegment(p, t.at[i], t.at[(i + 1) % 3])) return true;
  if (IsZero(normal) || Dot(normal, p.From(t.at[0])) != 0) return false;
  for (size_t i = 0; i < 3; ++i)
    if (Dot(normal, Cross(Minus(t.at[(i + 1) % 3], t.at[i]), p.From(t.at[i]))) < 0) return false;
  return true;
}

// a + over / under * (b - a)
RationalPoint Along(const GridPoint& a, const GridPoint& b, int64_t over, int64_t under) {
  if (under < 0) over = -over, under = -under;
  RationalPoint p{{}, under};
  for (size_t k = 0; k < 3; ++k) p.over[k] = under * a[k] + over * (b[k] - a[k]);
  return p;
}

using Points = std::vector<RationalPoint>;

// The point where the line ab meets the plane of t, if there is just one.
void CrossPlane(const GridPoint& a, const GridPoint& b, const GridTriangle& t, Points& points) {
  const GridPoint normal = Cross(Minus(t.at[1], t.at[0]), Minus(t.at[2], t.at[0]));
  const int64_t under = Dot(normal, Minus(b, a));
  if (under != 0) points.push_back(Along(a, b, Dot(normal, Minus(t.at[0], a)), under));
}

// The point where the lines ab and cd meet, if there is just one.
void CrossLine(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d, Points& points) {
  const GridPoint normal = Cross(Minus(b, a), Minus(d, c));
  if (IsZero(normal) || Dot(normal, Minus(c, a)) != 0) return;
  const size_t axis = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2;
  points.push_back(Along(a, b, Cross(Minus(c, a), Minus(d, c))[axis], normal[axis]));
}

void CollectFrom(const GridTriangle& s, const GridTriangle& t, Points& points) {
  for (size_t i = 0; i < 3; ++i) {
    const GridPoint &a = s.at[i], &b = s.at[(i + 1) % 3];
    points.push_back({a});
    CrossPlane(a, b, t, points);
    for (size_t k = 0; k < 3; ++k) CrossLine(a, b, t.at[k], t.at[(k + 1) % 3], points);
  }
}

// With a common edge, corners in one place count as meeting.
bool HasEqualCorners(const GridTriangle& s, const GridTriangle& t) {
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k) {
      if (s.corner[i] != t.corner[k] && s.at[i] == t.at[k]) return true;
      if (i != k && (s.at[i] == s.at[k] || t.at[i] == t.at[k])) return true;
    }
  return false;
}

}  // namespace

bool GridTrianglesMeet(const GridTriangle& s, const GridTriangle& t) {
  std::vector<GridPoint> common;
  for (size_t i = 0; i < 3; ++i)
    for (uint32_t corner : t.corner)
      if (s.corner[i] == corner) common.push_back(s.at[i]);
  if (common.size() == 3 || (common.size() == 2 && HasEqualCorners(s, t))) return true;
  Points points;
  CollectFrom(s, t, points);
  CollectFrom(t, s, points);
  for (const RationalPoint& p : points) {
    if (!common.empty() && IsOnSegment(p, common.front(), common.back())) continue;
    if (IsInTriangle(p, s) && IsInTriangle(p, t)) return true;
  }
  return false;
}

}  // namespace fuzz
