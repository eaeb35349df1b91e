// SPDX-License-Identifier: MIT
// region_topology: has a mesh the bodies, tunnels and voids of the region of winding number >= 1 of another one? By
// winding grids of two resolutions, and judged only where both say the same. Where the surfaces of the result differ
// from that, a third grid has to say it too, and to see a difference between both meshes.
#pragma once

#include <string>

#include "oracle/mesh_oracle.h"
#include "oracle/winding_grid.h"

namespace support {

struct TopologyVerdict {
  bool judged = false, right = true;
  bool touches = false;  // cells of the region that share an edge or a corner alone: joined or apart, both are right
  std::string reason;    // empty, or the difference
};

// `found` is the topology of the result. `cells` of the coarser grid along the longest side of the given mesh.
TopologyVerdict JudgeTopology(const Mesh& given, const Mesh& result, const Topology& found, int cells);

}  // namespace support
