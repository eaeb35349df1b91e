// SPDX-License-Identifier: MIT
// region_judge: does the result of a call bound the region of winding number >= 1 of a mesh, as the report says? By
// winding numbers at points and by columns, without code of the library.
#pragma once

#include <cstdint>
#include <string>

#include "tool/io/mesh_io.h"
#include "topoadapt.h"

namespace fuzz {

// Empty, or the fault. `moved` is the mesh with that region. Adds the points far enough from changes to `judged`.
std::string RegionFault(const tool::TriangleMesh& moved, const tool::TriangleMesh& result, const tpa_report& report,
                        uint64_t& judged);

}  // namespace fuzz
