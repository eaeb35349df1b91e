// SPDX-License-Identifier: MIT
// polygon_mesh: a surface as its file has it, polygons of three and more corners, and the cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tool/io/mesh_io.h"

namespace tool {

struct PolygonMesh {
  std::vector<double> positions;  // x, y, z of each vertex
  std::vector<uint32_t> corners;  // of all polygons in turn
  std::vector<size_t> ends;       // of each polygon's corners, one beyond the last
  int64_t first_vertex = 0;       // number of the first vertex in the file
  bool is_soup = false;           // the format repeats positions in place of numbers of vertices (STL)

  size_t polygons() const { return ends.size(); }
  size_t begin_of(size_t polygon) const { return polygon == 0 ? 0 : ends[polygon - 1]; }
  std::span<const uint32_t> polygon(size_t i) const { return {corners.data() + begin_of(i), ends[i] - begin_of(i)}; }
};

// Adds a polygon. `corners` count from 0; a corner of more than three that repeats the one before counts once.
// `place`
// ("a.off: face 7") starts the message about a corner that is no vertex.
Status add_polygon(const std::string& place, const std::vector<int64_t>& corners, PolygonMesh& mesh);

// Adds polygons of whole numbers as corners, from 0; ends[i] is one beyond the last corner of polygon i. Without ends,
// triangles.
Status add_polygons(const std::string& place, const std::vector<double>& corners, const std::vector<double>& ends,
                    PolygonMesh& mesh);

// As the file has it, before any cleaning.
Status read_polygons(const std::string& path, PolygonMesh& mesh);

// Cuts all polygons (io/polygon.h). No diagonal joins two vertices that a side or an earlier diagonal joins, as far as
// the polygon has another cut without folds: a closed mesh stays one without edges of four triangles. Polygons with
// the fewest cuts choose first. Polygon i gives n - 2
// triangles, in turn. O(corners) expected, and O(n^3) for a polygon of n <= 64 corners that has to take another cut.
std::vector<uint32_t> cut_polygons(const PolygonMesh& mesh);

// Corners with equal coordinates become the vertex of the first of these (0 equals -0). Returns how many vertices are
// left without a corner by it. `may_join`: one entry for each vertex, or empty.
size_t weld_equal(PolygonMesh& mesh, const std::vector<uint8_t>& may_join);

// Takes out the vertices that no polygon has, and returns how many.
size_t drop_unused_vertices(PolygonMesh& mesh);

// What read_mesh() makes of the polygons of a file.
TriangleMesh triangles_of(PolygonMesh&& polygons);

}  // namespace tool
