// SPDX-License-Identifier: MIT
// mesh_building: vertices, triangles and quadrilaterals added to a mesh.
#pragma once

#include "support/sample_meshes.h"

namespace support {

inline void AddVertex(Mesh& m, const Point& p) { m.positions.insert(m.positions.end(), p.begin(), p.end()); }
inline void AddTriangle(Mesh& m, size_t a, size_t b, size_t c) {
  for (size_t v : {a, b, c}) m.triangles.push_back(static_cast<uint32_t>(v));
}
inline void AddQuad(Mesh& m, size_t a, size_t b, size_t c, size_t d) {
  AddTriangle(m, a, b, c);
  AddTriangle(m, a, c, d);
}

}  // namespace support
