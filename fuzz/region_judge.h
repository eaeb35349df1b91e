// SPDX-License-Identifier: MIT
// region_judge: does the result of a call bound the region of winding number >= 1 of a mesh, but for the volumes that
// the report tells? By winding numbers at points and by columns, without code of the library, and with no number of the
// report as a tolerance.
#pragma once

#include <cstdint>
#include <string>

#include "tool/io/mesh_io.h"
#include "topoadapt.h"

namespace fuzz {

// Empty, or the fault. `aimed` is the mesh with all vertices at their targets, `moved` the mesh with the region asked
// for: vertices rolled back are at their old places. Without flat triangles. Adds the points looked at to `judged`.
std::string RegionFault(const tool::TriangleMesh& aimed, const tool::TriangleMesh& moved,
                        const tool::TriangleMesh& result, const tpa_report& report, uint64_t& judged);

}  // namespace fuzz
