// SPDX-License-Identifier: MIT
// section_three: the vertex hash of the paper, cell by cell, without a hash.
#pragma once

#include <functional>

#include "oracle/mesh_oracle.h"

namespace support {

// "The vertices are gathered to connected components, where two vertices are connected if there is a mesh edge
// connecting them. Each two triangles adjacent to vertices of different components are intersected." A slot holds the
// vertices of one cell, as if no two cells had the same hash.
// `meet` tells whether two triangles do.
Pairs PairsBySectionThree(const Mesh& m, double l, const std::function<bool(uint32_t, uint32_t)>& meet);

}  // namespace support
