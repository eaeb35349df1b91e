// SPDX-License-Identifier: MIT
// arena: a context of the library with room for a mesh, and the mesh as it takes it.
#pragma once

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "meshes.h"
#include "topoadapt.h"

namespace bench {

// Large pages, of 2 MiB: where the system has them for the asking, as Linux mostly does.
enum class Pages { ordinary, large };

// Empty `context` where the library refuses; `issue` says why.
struct Arena {
  explicit Arena(const tpa_config& config, Pages pages = Pages::ordinary) : block(nullptr, std::free) {
    tpa_arena_size size;
    if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return;
    const size_t page = pages == Pages::large ? size_t{1} << 21 : 1, unit = std::max<size_t>(size.alignment, page);
    const size_t rounded = (size.bytes + unit - 1) / unit * unit;
    block.reset(std::aligned_alloc(unit, rounded));
#if defined(__linux__)
    if (pages == Pages::large) madvise(block.get(), rounded, MADV_HUGEPAGE);
#endif
    if (tpa_init(block.get(), size.bytes, &config, &context, &issue) != TPA_OK) context = nullptr;
    bytes = size.bytes;
  }
  std::unique_ptr<void, void (*)(void*)> block;
  size_t bytes = 0;
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
