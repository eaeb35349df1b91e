// arena: a context of the library with room for a mesh, and the mesh as it takes it.
#pragma once

#include <cstdlib>
#include <memory>

#include "meshes.h"
#include "topoadapt.h"

namespace bench {

// Empty `context` where the library refuses; `issue` says why.
struct Arena {
  explicit Arena(const tpa_config& config) : block(nullptr, std::free) {
    tpa_arena_size size;
    if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return;
    block.reset(
        std::aligned_alloc(size.alignment, (size.bytes + size.alignment - 1) / size.alignment * size.alignment));
    if (tpa_init(block.get(), size.bytes, &config, &context, &issue) != TPA_OK) context = nullptr;
  }
  std::unique_ptr<void, void (*)(void*)> block;
  tpa_context* context = nullptr;
  tpa_issue issue{};
};

inline tpa_config ConfigFor(const Mesh& mesh) {
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = VertexCount(mesh);
  return config;
}

inline tpa_mesh_input InputOf(const Mesh& mesh) {
  tpa_mesh_input input{};
  input.struct_size = sizeof input;
  input.vertex_count = VertexCount(mesh);
  input.triangle_count = TriangleCount(mesh);
  input.position_type = TPA_FLOAT64;
  input.index_type = TPA_UINT32;
  input.positions = mesh.positions.data();
  input.triangles = mesh.triangles.data();
  return input;
}

}  // namespace bench
