// SPDX-License-Identifier: MIT
// region_report: do region_lost, region_gained and region_reach of a report tell what became of the region? Columns
// through the triangles that only one of the meshes has measure volumes and reach; the reach is measured from all
// triangles in contact, found pair by pair. No number of the report is a tolerance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oracle/region_columns.h"
#include "support/sample_meshes.h"
#include "topoadapt.h"

namespace support {

struct ReportVerdict {
  RegionDifference measured;
  double lost_error = 0, gained_error = 0;         // volumes: three standard deviations, and rounding
  double longest_edge = 0;                         // of the triangles that only one of the meshes has
  bool volume_less = false, volume_twice = false;  // told less than measured, or more than twice as much
  bool reach_less = false, reach_twice = false;
  std::string text;  // both sides in numbers
};

std::vector<TriangleCorners> TrianglesInContact(const Mesh& m);

// `given`: the mesh with the region asked for, vertices rolled back at their old places; `contacts`: of the mesh at its
// targets and of `given`. The judge looks with ten times as many columns before it says that a volume is at fault.
ReportVerdict JudgeReport(const Mesh& given, const Mesh& result, const std::vector<TriangleCorners>& contacts,
                          const tpa_report& report, uint64_t seed);

}  // namespace support
