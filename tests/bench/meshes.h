// SPDX-License-Identifier: MIT
// meshes: what detection is measured on. All are generated from fixed seeds; one and the same on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/io/mesh_io.h"

namespace bench {

using Mesh = tool::TriangleMesh;

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

inline uint32_t VertexCount(const Mesh& m) { return static_cast<uint32_t>(m.positions.size() / 3); }
inline uint32_t TriangleCount(const Mesh& m) { return static_cast<uint32_t>(m.triangles.size() / 3); }

// Icosahedron, each triangle cut into four `levels` times: 10 * 4^levels + 2 vertices.
Mesh Icosphere(int levels, double radius, double x);
// Two of them that run through each other.
Mesh TwoSpheres(int levels);
// `shells` icospheres round one centre, half an edge length apart.
Mesh NestedShells(int levels, int shells);
// A tube round a (2, 3) torus knot.
Mesh Knot(int along, int around);
Mesh Torus(int along, int around);
// Every coordinate moved by up to `share` of the mean edge length.
Mesh Noisy(Mesh m, double share, uint64_t seed);
// A sphere of latitudes and longitudes whose edges grow from pole to pole, the longest 1000 times the shortest.
Mesh Graded(int around);
// Vertices numbered at random; triangles too, if `triangles`.
Mesh Shuffled(const Mesh& m, bool triangles, uint64_t seed);

// Spheres are named by the vertices that each of the two has, the others by those that they have in all. Vertices in
// all are at most `most`.
std::vector<NamedMesh> StandardMeshes(uint32_t most);

}  // namespace bench
