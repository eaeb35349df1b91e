/* SPDX-License-Identifier: MIT */
/* Two octahedra: the upper moves down into the lower, and both become one. */
#include <stdio.h>
#include <stdlib.h>
#include <topoadapt.h>

static const float at[12][3] = {{3, 0, 0}, {0, 3, 0}, {-3, 0, 0}, {0, -3, 0}, {0, 0, 3},  {0, 0, -3},
                                {3, 0, 7}, {0, 3, 7}, {-3, 0, 7}, {0, -3, 7}, {0, 0, 10}, {0, 0, 4}};
static const uint16_t triangles[16][3] = {{0, 1, 4},  {1, 2, 4},  {2, 3, 4},  {3, 0, 4},  {1, 0, 5},  {2, 1, 5},
                                          {3, 2, 5},  {0, 3, 5},  {6, 7, 10}, {7, 8, 10}, {8, 9, 10}, {9, 6, 10},
                                          {7, 6, 11}, {8, 7, 11}, {9, 8, 11}, {6, 9, 11}};
static const uint32_t upper[6] = {6, 7, 8, 9, 10, 11};
static const float to[6][3] = {{3, 0, 5}, {0, 3, 5}, {-3, 0, 5}, {0, -3, 5}, {0, 0, 8}, {0, 0, 2}};

int main(void) {
  tpa_mesh_input mesh = {sizeof mesh, 12, 16, TPA_FLOAT32, TPA_UINT16, 0, 0, at, triangles};
  tpa_move_input move = {sizeof move, 6, TPA_FLOAT32, 0, to, upper};
  tpa_report report = {.struct_size = sizeof report};
  tpa_config config;
  tpa_arena_size size;
  tpa_context* context;
  tpa_issue issue;

  tpa_config_init(&config, sizeof config);
  config.max_vertices = 100;
  if (tpa_arena_query(&config, &size, &issue) != TPA_OK) return 1;
  void* memory = malloc(size.bytes); /* all memory of the library */
  if (memory == NULL) return 1;
  if (tpa_init(memory, size.bytes, &config, &context, &issue) != TPA_OK || tpa_load(context, &mesh, &issue) != TPA_OK ||
      tpa_move(context, &move, &issue) != TPA_OK || tpa_step(context, NULL, &report, &issue) != TPA_OK)
    return fprintf(stderr, "%s\n", tpa_status_string(issue.status)), 1;
  printf("%u contacts, volume %.4f, %u vertices kept back\n", (unsigned)report.contacts, report.region_after,
         (unsigned)report.rolled_back_vertices);
  printf("%u vertices, %u triangles\n", (unsigned)report.vertices, (unsigned)report.triangles);
  free(memory);
  return 0;
}
