// SPDX-License-Identifier: MIT
#include "region_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "oracle/region_columns.h"
#include "oracle/triangle_distance.h"
#include "support/sample_meshes.h"
#include "tool/result.h"

namespace fuzz {

namespace {

using namespace support;

constexpr int points = 64, columns = 400, columns_in_doubt = 40000;
constexpr double margin = 1e-4;  // of the size of the mesh, for points beside report.region_reach

using Corners = std::array<Point, 3>;

Corners CornersOf(const Mesh& m, size_t f) {
  return {PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
          PositionOf(m, m.triangles[3 * f + 2])};
}

// Triangles by their positions, the least corner first.
std::multiset<Corners> TrianglesOf(const Mesh& m) {
  std::multiset<Corners> triangles;
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    Corners c = CornersOf(m, f);
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    triangles.insert(c);
  }
  return triangles;
}

// Triangles of one of the meshes only.
std::vector<Corners> ChangedTriangles(const Mesh& a, const Mesh& b) {
  const std::multiset<Corners> of_a = TrianglesOf(a), of_b = TrianglesOf(b);
  std::vector<Corners> changed;
  std::set_symmetric_difference(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(changed));
  return changed;
}

bool IsNear(const Point& p, const std::vector<Corners>& triangles, double distance) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const Corners& c) {
    const Point corners[3] = {c[0], c[1], c[2]};
    return SquaredDistanceToTriangle(p, corners) <= distance * distance;
  });
}

// Rounding tells nothing of points so near the surface.
bool IsUpon(const Point& p, const Mesh& m, double distance) {
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    const Corners c = CornersOf(m, f);
    const Point corners[3] = {c[0], c[1], c[2]};
    if (SquaredDistanceToTriangle(p, corners) <= distance * distance) return true;
  }
  return false;
}

// The sum of solid angles in full turns (van Oosterom and Strackee 1983).
double WindingNumber(const Mesh& m, const Point& p) {
  double turns = 0;
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    Corners r = CornersOf(m, f);
    for (Point& c : r) c = Difference(c, p);
    const double n[3] = {Length(r[0]), Length(r[1]), Length(r[2])};
    const double below = n[0] * n[1] * n[2] + Dot(r[0], r[1]) * n[2] + Dot(r[1], r[2]) * n[0] + Dot(r[2], r[0]) * n[1];
    turns += std::atan2(Dot(r[0], Cross(r[1], r[2])), below) / (2 * pi);
  }
  return turns;
}

struct Box {
  Point low, high;
};

Box BoxOf(const Mesh& m) {
  Box box{PositionOf(m, 0), PositionOf(m, 0)};
  for (size_t i = 0; i < m.positions.size(); ++i) {
    box.low[i % 3] = std::min(box.low[i % 3], m.positions[i]);
    box.high[i % 3] = std::max(box.high[i % 3], m.positions[i]);
  }
  return box;
}

std::string PointFault(const Mesh& moved, const Mesh& result, const Box& box, double reach, uint64_t& judged) {
  const std::vector<Corners> changed = ChangedTriangles(moved, result);
  Random random(1);
  const double upon = 1e-7 * Distance(box.low, box.high);
  for (int i = 0; i < points; ++i) {
    Point p;
    for (size_t c = 0; c < 3; ++c) p[c] = Uniform(random, box.low[c], box.high[c]);
    if (IsNear(p, changed, reach) || IsUpon(p, moved, upon) || IsUpon(p, result, upon)) continue;
    const double before = WindingNumber(moved, p), after = WindingNumber(result, p);
    const double whole_before = std::round(before), whole_after = std::round(after);
    if (std::fabs(before - whole_before) + std::fabs(after - whole_after) > 1e-6) continue;  // upon the surface
    ++judged;
    if (whole_after != (whole_before >= 1 ? 1 : 0))
      return tool::text_of("winding number ", whole_after, " instead of ", whole_before, " at ", p[0], " ", p[1], " ",
                           p[2]);
  }
  return "";
}

struct Volumes {
  double sum = 0, absolute = 0;
};

// About the point `center`, since small bodies far from the origin would be lost in rounding.
Volumes VolumesOf(const Mesh& m, const Point& center) {
  Volumes v;
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    Corners c = CornersOf(m, f);
    for (Point& p : c) p = Difference(p, center);
    const double part = Dot(c[0], Cross(c[1], c[2])) / 6;
    v.sum += part;
    v.absolute += std::fabs(part);
  }
  return v;
}

std::string VolumeFault(const Mesh& moved, const Mesh& result, const Box& box, const tpa_report& r) {
  if (!(r.region_lost >= 0) || !(r.region_gained >= 0) || !(r.region_reach >= 0)) return "a volume or reach below 0";
  const Volumes own = VolumesOf(result, box.low);
  const double size = Distance(box.low, box.high);
  const double rounding = 1e-9 * (own.absolute + r.region_lost + r.region_gained) + 1e-14 * size * size * size;
  const bool is_measured = r.region_before != 0 || r.region_after != 0;
  if (is_measured && std::fabs(r.region_after - own.sum) > rounding)
    return tool::text_of("region_after ", r.region_after, " instead of ", own.sum);
  if (is_measured && std::fabs(r.region_before - r.region_lost + r.region_gained - r.region_after) > rounding)
    return "region_before, lost, gained and after do not add up";
  const double told = r.region_gained - r.region_lost;
  const Point sides = Difference(box.high, box.low);
  std::string fault;
  // Few columns are quick, and seldom far off; a fault is one by many columns, too.
  for (int count : {columns, columns_in_doubt}) {
    const RegionDifference d = CompareRegions(moved, result, count, 1);
    const double change = d.gained - d.lost;
    const double doubt = 0.02 * std::max(d.truth, d.result) + 0.5 * (r.region_lost + r.region_gained) +
                         1e-4 * sides[0] * sides[1] * sides[2] +  // of columns, and of estimates
                         1e-12 * size * size * size;              // of rounding, in flat bodies
    if (std::fabs(change - told) <= doubt) return "";
    fault = tool::text_of("region of ", d.truth, " changed by ", change, ", by ", told, " as reported");
  }
  return fault;
}

}  // namespace

std::string RegionFault(const Mesh& moved, const Mesh& result, const tpa_report& report, uint64_t& judged) {
  if (moved.triangles.empty()) return result.triangles.empty() ? "" : "a body out of nothing";
  const Box box = BoxOf(moved);
  std::string fault = VolumeFault(moved, result, box, report);
  const double reach = report.region_reach + margin * Distance(box.low, box.high);
  if (fault.empty()) fault = PointFault(moved, result, box, reach, judged);
  return fault;
}

}  // namespace fuzz
