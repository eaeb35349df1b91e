// SPDX-License-Identifier: MIT
#include "region_judge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/region_report.h"
#include "oracle/triangle_distance.h"
#include "support/sample_meshes.h"
#include "tool/result.h"

namespace fuzz {

namespace {

using namespace support;

constexpr int points = 64;
constexpr double ledger_share = 0.01;  // P3: of the volumes of components that meet
constexpr double most_edges = 2;       // from triangles in contact, in longest edges of the triangles that change

using Corners = TriangleCorners;

Corners CornersOf(const Mesh& m, size_t f) {
  return {PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
          PositionOf(m, m.triangles[3 * f + 2])};
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

// Points at which the region has changed lie near triangles in contact, by a distance that the judge measures itself.
std::string PointFault(const Mesh& moved, const Mesh& result, const Box& box, const std::vector<Corners>& contacts,
                       double reach, uint64_t& judged) {
  Random random(1);
  const double upon = 1e-7 * Distance(box.low, box.high);
  for (int i = 0; i < points; ++i) {
    Point p;
    for (size_t c = 0; c < 3; ++c) p[c] = Uniform(random, box.low[c], box.high[c]);
    if (IsUpon(p, moved, upon) || IsUpon(p, result, upon)) continue;
    const double before = WindingNumber(moved, p), after = WindingNumber(result, p);
    const double whole_before = std::round(before), whole_after = std::round(after);
    if (std::fabs(before - whole_before) + std::fabs(after - whole_after) > 1e-6) continue;  // upon the surface
    ++judged;
    if (whole_after == (whole_before >= 1 ? 1 : 0)) continue;
    const bool is_result = whole_after == 0 || whole_after == 1;
    if (!is_result || !IsNear(p, contacts, reach))
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

std::string VolumeFault(const Mesh& result, const Box& box, const tpa_report& r) {
  if (!(r.region_lost >= 0) || !(r.region_gained >= 0) || !(r.region_reach >= 0)) return "a volume or reach below 0";
  const Volumes own = VolumesOf(result, box.low);
  const double size = Distance(box.low, box.high);
  const double rounding = 1e-9 * (own.absolute + r.region_lost + r.region_gained) + 1e-14 * size * size * size;
  const bool is_measured = r.region_before != 0 || r.region_after != 0;
  if (is_measured && std::fabs(r.region_after - own.sum) > rounding)
    return tool::text_of("region_after ", r.region_after, " instead of ", own.sum);
  if (is_measured && std::fabs(r.region_before - r.region_lost + r.region_gained - r.region_after) > rounding)
    return "region_before, lost, gained and after do not add up";
  return "";
}

// Told volumes are never less than those by columns. More than twice as much is possible where moves are taken back,
// within the ledger of the components (docs/evaluation.md, "Open faults").
std::string ReportFault(const ReportVerdict& v, const tpa_report& r, double volumes) {
  if (v.volume_less) return "volumes told too small: " + v.text;
  const bool is_bound = r.region_lost + r.region_gained <= ledger_share * volumes;
  return v.volume_twice && !is_bound ? "volumes told more than twice: " + v.text : "";
}

}  // namespace

std::string RegionFault(const Mesh& aimed, const Mesh& moved, const Mesh& result, const tpa_report& report,
                        uint64_t& judged) {
  if (moved.triangles.empty()) return result.triangles.empty() ? "" : "a body out of nothing";
  const Box box = BoxOf(moved);
  std::string fault = VolumeFault(result, box, report);
  if (!fault.empty()) return fault;
  std::vector<Corners> contacts = TrianglesInContact(aimed);
  if (aimed.positions != moved.positions)
    for (const Corners& c : TrianglesInContact(moved)) contacts.push_back(c);
  const ReportVerdict verdict = JudgeReport(moved, result, contacts, report, 1);
  fault = ReportFault(verdict, report, VolumesOf(moved, box.low).absolute);
  if (fault.empty()) fault = PointFault(moved, result, box, contacts, most_edges * verdict.longest_edge, judged);
  return fault;
}

}  // namespace fuzz
