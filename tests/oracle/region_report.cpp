// SPDX-License-Identifier: MIT
#include "oracle/region_report.h"

#include <algorithm>
#include <set>

#include "oracle/mesh_oracle.h"
#include "tool/result.h"

namespace support {

namespace {

constexpr int columns = 1000, columns_in_doubt = 10000;
constexpr double rounding = 1e-9;  // of the volumes measured along, and of lengths of the mesh
constexpr double deviations = 3;

TriangleCorners CornersOf(const Mesh& m, size_t f) {
  return {PositionOf(m, m.triangles[3 * f]), PositionOf(m, m.triangles[3 * f + 1]),
          PositionOf(m, m.triangles[3 * f + 2])};
}

std::multiset<TriangleCorners> TrianglesOf(const Mesh& m) {
  std::multiset<TriangleCorners> triangles;
  for (size_t f = 0; f < m.triangles.size() / 3; ++f) {
    TriangleCorners c = CornersOf(m, f);
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    triangles.insert(c);
  }
  return triangles;
}

double LongestChangedEdge(const Mesh& a, const Mesh& b) {
  const std::multiset<TriangleCorners> of_a = TrianglesOf(a), of_b = TrianglesOf(b);
  std::vector<TriangleCorners> changed;
  std::set_symmetric_difference(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(changed));
  double longest = 0;
  for (const TriangleCorners& c : changed)
    for (size_t i = 0; i < 3; ++i) longest = std::max(longest, Distance(c[i], c[(i + 1) % 3]));
  return longest;
}

double SizeOf(const Mesh& m) {
  double size = 0;
  for (const double x : m.positions) size = std::max(size, std::abs(x));
  return size;
}

// One standard deviation of both sums bounds that of each.
void Weigh(const tpa_report& r, double size, bool any_contact, ReportVerdict& v) {
  const RegionDifference& d = v.measured;
  const double error = deviations * d.error + rounding * (d.truth + d.result) + 1e-12 * size * size * size;
  v.lost_error = v.gained_error = error;
  v.volume_less = r.region_lost < d.lost - error || r.region_gained < d.gained - error;
  v.volume_twice = r.region_lost + r.region_gained > 2 * (d.lost + d.gained + error);
  // Samples never lie farther than the farthest point, and one lies as near to this point as a cell is large.
  v.reach_less = any_contact && r.region_reach < d.reach - rounding * size;
  v.reach_twice = r.region_reach > 2 * (d.reach + d.cell + rounding * size);
  v.text = tool::text_of("lost ", d.lost, " told ", r.region_lost, ", gained ", d.gained, " told ", r.region_gained,
                         ", each +- ", error, "; reach ", d.reach, " told ", r.region_reach, ", cells of ", d.cell,
                         ", edges of ", v.longest_edge);
}

}  // namespace

std::vector<TriangleCorners> TrianglesInContact(const Mesh& m) {
  std::set<uint32_t> faces;
  for (const auto& [f, g] : AllMeetingPairs(m)) faces.insert({f, g});
  std::vector<TriangleCorners> triangles;
  for (const uint32_t f : faces) triangles.push_back(CornersOf(m, f));
  return triangles;
}

ReportVerdict JudgeReport(const Mesh& given, const Mesh& result, const std::vector<TriangleCorners>& contacts,
                          const tpa_report& report, uint64_t seed) {
  ReportVerdict v;
  v.longest_edge = LongestChangedEdge(given, result);
  const double size = std::max(SizeOf(given), SizeOf(result));
  for (const int count : {columns, columns_in_doubt}) {
    v.measured = CompareChanges(given, result, count, seed, contacts);
    Weigh(report, size, !contacts.empty(), v);
    if (!v.volume_less && !v.volume_twice) break;
  }
  return v;
}

}  // namespace support
