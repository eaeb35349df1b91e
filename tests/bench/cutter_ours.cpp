// SPDX-License-Identifier: MIT
#include "cutters.h"
#include "stepping.h"

namespace bench {

// Limits that do not bind.
std::optional<Cut> CutWithLibrary(const Mesh& mesh) {
  tpa_config config = ConfigFor(mesh);
  config.max_vertices = 16 * VertexCount(mesh) + 1024;
  config.max_contacts = 64 * TriangleCount(mesh);
  config.max_passes = 64;
  const Arena arena(config);
  const tpa_mesh_input input = InputOf(mesh);
  tpa_report report{};
  report.struct_size = sizeof report;
  const double start = Now();
  if (tpa_load(arena.context, &input, nullptr) != TPA_OK) return std::nullopt;
  if (tpa_adapt(arena.context, nullptr, &report, nullptr) != TPA_OK || report.unresolved > 0) return std::nullopt;
  Cut cut{Now() - start, {}};
  const tpa_mesh_view view = ViewOf(arena.context);
  cut.mesh.positions.assign(view.positions, view.positions + 3 * size_t{view.vertex_count});
  cut.mesh.triangles.assign(view.triangles, view.triangles + 3 * size_t{view.triangle_count});
  return cut;
}

}  // namespace bench
