// SPDX-License-Identifier: MIT
// The header in a strict C++17 program: a tetrahedron is loaded and validated.
#include <topoadapt.h>

#include <cstdint>
#include <vector>

int main() {
  tpa_config config;
  tpa_arena_size size;
  tpa_issue issue;
  tpa_context* context = nullptr;
  if (tpa_config_init(&config, sizeof config) != TPA_OK) return 1;
  config.max_vertices = 16;
  if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return 1;
  std::vector<unsigned char> block(size.bytes);
  if (tpa_init(block.data(), size.bytes, &config, &context, &issue) != TPA_OK) return 1;

  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint16_t triangles[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  tpa_mesh_input mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.vertex_count = mesh.triangle_count = 4;
  mesh.position_type = TPA_FLOAT32;
  mesh.index_type = TPA_UINT16;
  mesh.positions = positions;
  mesh.triangles = triangles;
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return 1;
  tpa_validation validation{};
  validation.struct_size = sizeof validation;
  return tpa_validate(context, nullptr, &validation, &issue) == TPA_OK && validation.components == 1 ? 0 : 1;
}
