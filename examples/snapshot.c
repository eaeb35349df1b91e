/* A byte copy of the block is a snapshot: a step is tried, taken back, and made again with the same bits. */
#include <string.h>

#include "balls.h"

/* The left ball goes right by `distance`, in one step. */
static tpa_status push(tpa_context* context, double distance, tpa_issue* issue) {
  static double targets[BALL_VERTICES][3];
  const tpa_move_input move = {
      .struct_size = sizeof move, .count = BALL_VERTICES, .position_type = TPA_FLOAT64, .positions = targets};
  for (uint32_t v = 0; v < BALL_VERTICES; ++v) {
    for (uint32_t i = 0; i < 3; ++i) targets[v][i] = positions[v][i];
    targets[v][0] += distance;
  }
  const tpa_status status = tpa_move(context, &move, issue);
  return status != TPA_OK ? status : tpa_step(context, NULL, NULL, issue);
}

static int same(const tpa_mesh_view* mesh, const double* p, uint32_t vertices) {
  return mesh->vertex_count == vertices && memcmp(mesh->positions, p, 3 * sizeof(double) * vertices) == 0;
}

int main(void) {
  static double kept[4 * BALL_VERTICES][3];
  tpa_issue issue = {.status = TPA_OK};
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_arena_size size;
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 4 * BALL_VERTICES;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL || tpa_arena_query(&config, &size, &issue) != TPA_OK) return fail(&issue);
  make_ball(0, -2.2, 0, 2);
  make_ball(1, 2.2, 0, 2);
  const tpa_mesh_input mesh = balls(2);
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);

  void* snapshot = malloc(size.bytes);
  if (snapshot == NULL) return 1;
  memcpy(snapshot, context, size.bytes); /* the context is the block's first byte */

  if (push(context, 0.6, &issue) != TPA_OK) return fail(&issue);
  tpa_view(context, &view);
  const uint32_t vertices = view.vertex_count;
  memcpy(kept, view.positions, 3 * sizeof(double) * vertices);
  printf("merged: %u vertices\n", (unsigned)vertices);

  memcpy(context, snapshot, size.bytes); /* rewind */
  tpa_view(context, &view);
  const int rewound = same(&view, positions[0], mesh.vertex_count);
  printf("rewound: %u vertices, %s\n", (unsigned)view.vertex_count, rewound ? "as loaded" : "not as loaded");

  if (push(context, 0.6, &issue) != TPA_OK) return fail(&issue);
  tpa_view(context, &view);
  const int again = same(&view, kept[0], vertices);
  printf("merged again: %u vertices, %s\n", (unsigned)view.vertex_count, again ? "the same bits" : "other bits");
  free(snapshot);
  free(block);
  return rewound && again && vertices != mesh.vertex_count ? 0 : 1;
}
