// The library's own half-edge mesh, made from a mesh of the tests, for tests of rooms behind the interface.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh.h"
#include "support.h"

namespace support {

struct LibraryMesh {
  std::vector<tpa::Vec3> positions;
  std::vector<uint32_t> corners, opposite, vertex_edge;
  tpa::Mesh m;

  explicit LibraryMesh(const Mesh& mesh)
      : corners(mesh.triangles), opposite(mesh.triangles.size()), vertex_edge(VertexCount(mesh)) {
    for (size_t v = 0; v < VertexCount(mesh); ++v)
      positions.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
    m.position = positions.data();
    m.corner = corners.data();
    m.opposite = opposite.data();
    m.vertex_edge = vertex_edge.data();
    m.vertex_count = VertexCount(mesh);
    m.face_count = TriangleCount(mesh);
    std::vector<uint32_t> heads(m.vertex_count + 1), edges(3 * m.face_count);
    EXPECT_EQ(tpa::connect(m, heads.data(), edges.data()).kind, 0);
  }
  LibraryMesh(const LibraryMesh&) = delete;  // m points into it
};

}  // namespace support
