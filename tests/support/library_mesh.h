// SPDX-License-Identifier: MIT
// The library's own half-edge mesh, alone, with a journal, or with NearFaces too, made from a test mesh, for tests of
// rooms behind the interface.
#pragma once

#include <cstdint>
#include <vector>

#include "detect/contact.h"
#include "detect/near_faces.h"
#include "mesh/journal.h"
#include "support/mesh_on_failure.h"
#include "support/support.h"

namespace support {

struct LibraryMesh {
  std::vector<tpa::Vec3> positions;
  std::vector<uint32_t> corners, opposite, vertex_edge;
  tpa::Mesh m;
  MeshOnFailure given;

  explicit LibraryMesh(const Mesh& mesh)
      : corners(mesh.triangles), opposite(mesh.triangles.size()), vertex_edge(VertexCount(mesh)), given("given", mesh) {
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
  LibraryMesh(const LibraryMesh&) = delete;  // m points into the vector
};

// In a transaction, with room for as many elements more as `spare` says.
struct EditedMesh : LibraryMesh {
  explicit EditedMesh(const Mesh& mesh, uint32_t spare = 0)
      : LibraryMesh(mesh), vertices(VertexCount(mesh)), faces(TriangleCount(mesh)) {
    const size_t v = vertices + spare, f = faces + spare;
    positions.resize(v), vertex_edge.resize(v), corners.resize(3 * f), opposite.resize(3 * f);
    positions_before.resize(v), vertices_before.resize(v), origins.resize(v);
    faces_before.resize(f), face_origins.resize(f);
    touched_vertices.resize(tpa::bit_set_words(v)), touched_faces.resize(tpa::bit_set_words(f));
    for (uint32_t i = 0; i < v; ++i) origins[i] = {{i, tpa::none}, 1};
    for (uint32_t i = 0; i < f; ++i) face_origins[i] = i;
    m.position = positions.data();
    m.vertex_edge = vertex_edge.data();
    m.corner = corners.data();
    m.opposite = opposite.data();
    m.vertex_origin = origins.data();
    m.face_origin = face_origins.data();
    m.vertex_capacity = static_cast<uint32_t>(v);
    m.face_capacity = static_cast<uint32_t>(f);
    e.mesh = m;
    e.journal.position = positions_before.data();
    e.journal.vertex = vertices_before.data();
    e.journal.face = faces_before.data();
    e.journal.vertices = tpa::open_bit_set(touched_vertices.data(), m.vertex_capacity);
    e.journal.faces = tpa::open_bit_set(touched_faces.data(), m.face_capacity);
    tpa::begin(e);
  }

  uint32_t vertices, faces;
  std::vector<tpa::Vec3> positions_before;
  std::vector<tpa::OldVertex> vertices_before;
  std::vector<tpa::OldFace> faces_before;
  std::vector<tpa::VertexOrigin> origins;
  std::vector<uint32_t> face_origins;
  std::vector<uint32_t> touched_vertices, touched_faces;
  tpa::Edit e;
};

// NearFaces with the memory of the face tree.
struct NearFacesWithMemory {
  NearFacesWithMemory(uint32_t vertices, uint32_t faces)
      : memory(tpa::face_tree_bytes(vertices, faces) / sizeof(Line) + 1),
        tree(tpa::open_face_tree(reinterpret_cast<uint8_t*>(memory.data()), vertices, faces)) {}
  NearFacesWithMemory(const NearFacesWithMemory&) = delete;  // g points into the vector
  void Arrange(const tpa::Mesh& m) {
    tpa::arrange(tree, m, {});
    tpa::watch(g, m, tree);
  }

  struct alignas(64) Line {
    char bytes[64];
  };
  std::vector<Line> memory;
  tpa::FaceTree tree;
  tpa::NearFaces g;
};

// Rooms for the tasks of a detection.
struct RoomsWithMemory {
  explicit RoomsWithMemory(uint32_t faces)
      : memory(tpa::task_rooms(faces) * tpa::TaskRooms::bytes / sizeof(NearFacesWithMemory::Line)),
        rooms{reinterpret_cast<uint8_t*>(memory.data()), tpa::task_rooms(faces)} {}
  RoomsWithMemory(const RoomsWithMemory&) = delete;  // rooms point into the vector

  std::vector<NearFacesWithMemory::Line> memory;
  tpa::TaskRooms rooms;
};

// A mesh with all faces entered in its NearFaces.
struct ArrangedMesh : EditedMesh, NearFacesWithMemory {
  explicit ArrangedMesh(const Mesh& mesh, uint32_t spare = 0)
      : EditedMesh(mesh, spare), NearFacesWithMemory(vertices + spare, faces + spare), marks(faces + spare) {
    Arrange(e.mesh);
  }

  std::vector<uint8_t> marks;
};

// Expects each living face in NearFaces with its present box, and nothing else.
inline void ExpectArranged(const tpa::NearFaces& g, const tpa::Mesh& m) {
  std::vector<int> met(m.face_count, 0);
  const tpa::Vec3 far{1e3, 1e3, 1e3};
  tpa::for_each_near(g, tpa::box_of(-1.0 * far, far, far), [&](uint32_t f) {
    ASSERT_LT(f, met.size());
    ++met[f];
  });
  for (uint32_t f = 0; f < m.face_count; ++f) {
    EXPECT_EQ(met[f], tpa::face_lives(m, f) ? 1 : 0) << f;
    if (!tpa::face_lives(m, f)) continue;
    const auto is_it = [&](uint32_t other) { return other == f; };
    for (uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const tpa::Vec3& p = tpa::corner_position(m, h);
      EXPECT_EQ(tpa::find_near(g, tpa::box_of(p, p, p), is_it, [](uint32_t) { return true; }), f);
    }
  }
}

}  // namespace support
