/* SPDX-License-Identifier: MIT */
/* The header from C: this file compiles as C99, C11 and C++20 without extensions, and as a program carries a mesh
 * through load, move and step. */
#include <stdio.h>
#include <string.h>

#include "topoadapt.h"

/* Promises to callers: statuses are pinned, structures are as when the caller was compiled. */
typedef char status_is_32_bits[sizeof(tpa_status) == 4 ? 1 : -1];
typedef char tangled_is_pinned[TPA_E_TANGLED == -9 ? 1 : -1];
typedef char contact_is_two_words[sizeof(tpa_contact) == 8 ? 1 : -1];

#define FAIL(what) (fprintf(stderr, "line %d: %s\n", __LINE__, what), 1)

/* Two octahedra side by side. */
static double positions[2 * 6 * 3];
static uint32_t triangles[2 * 8 * 3];

static void fill(void) {
  static const double corner[6][3] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  static const uint32_t face[8][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                                      {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  uint32_t part, i, k;
  for (part = 0; part < 2; ++part) {
    for (i = 0; i < 6; ++i)
      for (k = 0; k < 3; ++k) positions[3 * (6 * part + i) + k] = corner[i][k] + (k == 0 ? 3.0 * part : 0.0);
    for (i = 0; i < 8; ++i)
      for (k = 0; k < 3; ++k) triangles[3 * (8 * part + i) + k] = face[i][k] + 6 * part;
  }
}

static int run(void* memory, size_t size, const tpa_config* config) {
  tpa_context* context = NULL;
  tpa_mesh_input mesh;
  tpa_move_input move;
  tpa_mesh_view view;
  tpa_report report;
  tpa_issue issue;
  const double away[3] = {-2, 0, 0};
  const uint32_t vertex = 2;

  if (tpa_init(memory, size, config, &context, &issue) != TPA_OK) return FAIL(tpa_status_string(issue.status));
  memset(&mesh, 0, sizeof mesh);
  mesh.struct_size = sizeof mesh;
  mesh.vertex_count = 12;
  mesh.triangle_count = 16;
  mesh.position_type = TPA_FLOAT64;
  mesh.index_type = TPA_UINT32;
  mesh.positions = positions;
  mesh.triangles = triangles;
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return FAIL(tpa_status_string(issue.status));

  memset(&move, 0, sizeof move);
  move.struct_size = sizeof move;
  move.count = 1;
  move.position_type = TPA_FLOAT64;
  move.positions = away;
  move.vertices = &vertex;
  if (tpa_move(context, &move, &issue) != TPA_OK) return FAIL(tpa_status_string(issue.status));
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  if (tpa_step(context, NULL, &report, &issue) != TPA_OK) return FAIL(tpa_status_string(issue.status));
  if (report.vertices != 12 || report.contacts != 0) return FAIL("report");

  memset(&view, 0, sizeof view);
  view.struct_size = sizeof view;
  if (tpa_view(context, &view) != TPA_OK) return FAIL("view");
  if (view.vertex_count != 12 || view.positions[3 * 2] != -2) return FAIL("the vertex did not move");
  return 0;
}

int main(void) {
  static union {
    char bytes[1 << 22];
    double align;
  } block;
  tpa_config config;
  tpa_arena_size size;
  tpa_issue issue;
  char* memory = block.bytes;

  if (tpa_version() != (TPA_VERSION_MAJOR << 16 | TPA_VERSION_MINOR << 8 | TPA_VERSION_PATCH)) return FAIL("version");
  fill();
  if (tpa_config_init(&config, sizeof config) != TPA_OK) return FAIL("config");
  config.max_vertices = 64;
  if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return FAIL(tpa_status_string(issue.status));
  while ((uintptr_t)memory % size.alignment != 0) ++memory;
  if (size.bytes > sizeof block.bytes - (size_t)(memory - block.bytes)) return FAIL("block too small");
  return run(memory, size.bytes, &config);
}
