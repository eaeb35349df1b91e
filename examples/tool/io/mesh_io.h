// SPDX-License-Identifier: MIT
// mesh_io: triangle meshes from and to files, the format told by the file's name: Wavefront .obj, Geomview
// .off, Stanford .ply, stereolithography .stl; to files also VTK's .vtp and .vtk and GIfTI's .gii. Text and binary
// forms are told apart by content. Coordinates are passed on as they are, NaN included: the library judges them, and
// names the vertex.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tool/io/affine.h"
#include "tool/result.h"

namespace tool {

struct TriangleMesh {
  std::vector<double> positions;     // x, y, z of each vertex
  std::vector<uint32_t> triangles;   // three vertices each
  Space space = Space::unnamed;      // named in files as 3D Slicer reads it ("SPACE=RAS"), but for .off
  std::vector<int32_t> labels = {};  // of each triangle, or none; only written, to .vtp, .vtk, .ply and .obj
};

// Polygons are cut into triangles (polygon.h), convex or not. On failure `mesh` is left empty.
Status read_mesh(const std::string& path, TriangleMesh& mesh);

// .ply binary with coordinates as doubles (all bits kept), .obj and .off text with 17 digits (all bits kept),
// .vtp with base64 and .vtk binary with coordinates as doubles, .stl and .gii with coordinates rounded to floats.
// GIfTI's world is RAS: a mesh in LPS is turned.
Status write_mesh(const std::string& path, const TriangleMesh& mesh);

// Fails if write_mesh would surely fail, whatever the mesh: format or folder unknown, no right to write. Writes
// nothing.
Status check_mesh_output(const std::string& path);

// One pair per format, on the bytes of a file. `path` is for messages.
Status parse_obj(const std::string& path, std::string_view text, TriangleMesh& mesh);
Status parse_off(const std::string& path, std::string_view text, TriangleMesh& mesh);
Status parse_ply(const std::string& path, std::string_view bytes, TriangleMesh& mesh);
Status parse_stl(const std::string& path, std::string_view bytes, TriangleMesh& mesh);
Status format_obj(const TriangleMesh& mesh, std::string& bytes);
Status format_off(const TriangleMesh& mesh, std::string& bytes);
Status format_ply(const TriangleMesh& mesh, std::string& bytes);
Status format_stl(const TriangleMesh& mesh, std::string& bytes);
Status format_vtp(const TriangleMesh& mesh, std::string& bytes);
Status format_vtk(const TriangleMesh& mesh, std::string& bytes);
Status format_gifti(const TriangleMesh& mesh, std::string& bytes);

// "SPACE=RAS", as 3D Slicer looks for in comments and titles; empty for an unnamed space.
std::string space_mark(Space space);

// Adds a polygon in triangles. `corners` count from 0; a corner of more than three that repeats the one before counts
// once. `place` ("a.off: face 7") starts the message about a corner that is no vertex. `first_index` is the number of
// the first vertex in the format.
Status add_polygon(const std::string& place, const std::vector<int64_t>& corners, int64_t first_index,
                   TriangleMesh& mesh);

}  // namespace tool
