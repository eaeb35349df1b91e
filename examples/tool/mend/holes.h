// SPDX-License-Identifier: MIT
// holes: the rims of an open mesh, their description, and their closing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/mend/fans.h"

namespace tool {

// The vertices of a rim in turn, so that triangles of a cover have sides from each to the next.
using Rim = std::vector<uint32_t>;

// Holes of the mesh, each vertex once in a rim: holes with a common corner are two. `parted` is the mesh after
// part_fans(), with this result. Order of the first side. O(n).
std::vector<Rim> rims_of(const TriangleMesh& mesh, const TriangleMesh& parted, const Parted& result);

struct Filled {
  size_t holes = 0, triangles = 0;
  size_t blocked = 0;  // holes short enough that no cover closes without meeting the mesh
};

// Closes holes of at most `most_edges` edges by covers of the least length of edges (exact.h) that meet nothing, in
// order. Slits, whose corners lie in a line, get covers without area, which meet no more than their rims do. Rims that
// stay are left in `rims`.
Filled fill_holes(TriangleMesh& mesh, std::vector<Rim>& rims, uint64_t most_edges);

// Two vertices of rims that lie near each other, without an edge between them.
struct NearPair {
  uint32_t one, other;
  double distance;
};
// For each vertex of a rim, the nearest one of another place within a hundredth of the mean edge of all rims.
std::vector<NearPair> near_pairs(const TriangleMesh& mesh, const std::vector<Rim>& rims);

}  // namespace tool
