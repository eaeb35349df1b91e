// SPDX-License-Identifier: MIT
// shapes: closed meshes for scenes, beside the sphere.
#pragma once

#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/scenes/points.h"

namespace tool {

inline size_t vertex_count(const TriangleMesh& m) { return m.positions.size() / 3; }
inline Point position_of(const TriangleMesh& m, size_t v) {
  return {m.positions[3 * v], m.positions[3 * v + 1], m.positions[3 * v + 2]};
}
inline void set_position(TriangleMesh& m, size_t v, const Point& p) {
  for (size_t i = 0; i < 3; ++i) m.positions[3 * v + i] = p[i];
}

// One mesh of both.
void append(TriangleMesh& mesh, const TriangleMesh& part);

// A ball of `rings` circles of latitude with `sectors` vertices each, and two poles: rings * sectors + 2 vertices.
TriangleMesh make_globe(const Point& center, double radius, int rings, int sectors);

// A ring round the z axis through `center`: around * across vertices.
TriangleMesh make_torus(const Point& center, double ring, double tube, int around, int across);

// A surface of revolution round the x axis: one circle for each point (x, radius) of the profile, and the two ends
// closed to (first x, 0) and (last x, 0). Precondition: radii are positive.
TriangleMesh make_spindle(const std::vector<std::array<double, 2>>& profile, int sides);

// Applies to every vertex.
template <class Map>
void transform(TriangleMesh& mesh, const Map& map) {
  for (size_t v = 0; v < vertex_count(mesh); ++v) set_position(mesh, v, map(position_of(mesh, v)));
}

// Sums of the area normals of the triangles round each vertex, made unit vectors.
std::vector<Point> vertex_normals(const double* positions, size_t vertices, const uint32_t* triangles, size_t corners);

}  // namespace tool
