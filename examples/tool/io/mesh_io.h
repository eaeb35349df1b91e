// SPDX-License-Identifier: MIT
// mesh_io: triangle meshes from and to files, the format told by the file's name: Wavefront .obj, Geomview
// .off, Stanford .ply, stereolithography .stl, VTK's .vtp and GIfTI's .gii; to files also VTK's .vtk. Text and binary
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

struct PolygonMesh;

// Polygons are cut into triangles (polygon.h), convex or not. Corners of .stl with equal coordinates become one vertex,
// in the order of first appearance; nothing else is cleaned. On failure `mesh` is left empty.
Status read_mesh(const std::string& path, TriangleMesh& mesh);

// .ply binary with coordinates as doubles (all bits kept), .obj and .off text with 17 digits (all bits kept),
// .vtp with base64 and .vtk binary with coordinates as doubles, .stl and .gii with coordinates rounded to floats.
// GIfTI's world is RAS: a mesh in LPS is turned.
Status write_mesh(const std::string& path, const TriangleMesh& mesh);

// Fails if write_mesh would surely fail, whatever the mesh: format or folder unknown, no right to write. Writes
// nothing.
Status check_mesh_output(const std::string& path);

// One pair per format, on the bytes of a file. `path` is for messages.
Status parse_obj(const std::string& path, std::string_view text, PolygonMesh& mesh);
Status parse_off(const std::string& path, std::string_view text, PolygonMesh& mesh);
Status parse_ply(const std::string& path, std::string_view bytes, PolygonMesh& mesh);
Status parse_stl(const std::string& path, std::string_view bytes, PolygonMesh& mesh);
Status parse_vtp(const std::string& path, std::string_view bytes, PolygonMesh& mesh);
Status parse_gifti(const std::string& path, std::string_view bytes, PolygonMesh& mesh);
Status format_obj(const TriangleMesh& mesh, std::string& bytes);
Status format_off(const TriangleMesh& mesh, std::string& bytes);
Status format_ply(const TriangleMesh& mesh, std::string& bytes);
Status format_stl(const TriangleMesh& mesh, std::string& bytes);
Status format_vtp(const TriangleMesh& mesh, std::string& bytes);
Status format_vtk(const TriangleMesh& mesh, std::string& bytes);
Status format_gifti(const TriangleMesh& mesh, std::string& bytes);

// "SPACE=RAS", as 3D Slicer looks for in comments and titles; empty for an unnamed space.
std::string space_mark(Space space);

}  // namespace tool
