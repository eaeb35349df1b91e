/* Attributes follow the mesh through a merge: a colour for each vertex, a material for each triangle, and which ball a
 * vertex came from, by which it knows where to go. */
#include "balls.h"

#define MOST_VERTICES (4 * BALL_VERTICES)
#define MOST_TRIANGLES (2 * MOST_VERTICES + 1024)
#define NEW_SURFACE 2

static float colour[MOST_VERTICES], next_colour[MOST_VERTICES];
static uint8_t material[MOST_TRIANGLES], next_material[MOST_TRIANGLES];

/* After each commit, before the next: from the arrays of the mesh as it was to those of the mesh as it is. */
static void follow(const tpa_context* context) {
  tpa_vertex_map_view vertices = {.struct_size = sizeof vertices};
  tpa_triangle_map_view faces = {.struct_size = sizeof faces};
  tpa_vertex_map(context, &vertices);
  tpa_triangle_map(context, &faces);
  for (uint32_t v = 0; v < vertices.new_count; ++v) {
    const tpa_vertex_origin* o = &vertices.origins[v];
    next_colour[v] = colour[o->parents[0]];
    if (o->parents[1] != TPA_NONE)
      next_colour[v] = o->weight * next_colour[v] + (1 - o->weight) * colour[o->parents[1]];
  }
  for (uint32_t f = 0; f < faces.new_count; ++f)
    next_material[f] = faces.origins[f] == TPA_NONE ? NEW_SURFACE : material[faces.origins[f]];
  for (uint32_t v = 0; v < vertices.new_count; ++v) colour[v] = next_colour[v];
  for (uint32_t f = 0; f < faces.new_count; ++f) material[f] = next_material[f];
}

int main(void) {
  static double targets[MOST_VERTICES][3];
  tpa_issue issue = {.status = TPA_OK};
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = MOST_VERTICES;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL) return fail(&issue);
  make_ball(0, -2.1, 0, 2);
  make_ball(1, 2.1, 0, 2);
  for (uint32_t v = BALL_VERTICES; v < 2 * BALL_VERTICES; ++v) colour[v] = 1;
  for (uint32_t f = BALL_TRIANGLES; f < 2 * BALL_TRIANGLES; ++f) material[f] = 1;
  const tpa_mesh_input mesh = balls(2);
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);
  for (int step = 0; step < 3; ++step) {
    tpa_move_input move = {.struct_size = sizeof move, .position_type = TPA_FLOAT64, .positions = targets};
    tpa_view(context, &view);
    move.count = view.vertex_count;
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
      for (uint32_t i = 0; i < 3; ++i) targets[v][i] = view.positions[3 * v + i];
      targets[v][0] += colour[v] < 0.5f ? 0.08 : -0.08;
    }
    if (tpa_move(context, &move, &issue) != TPA_OK || tpa_step(context, NULL, NULL, &issue) != TPA_OK)
      return fail(&issue);
    follow(context);
  }
  uint32_t left = 0, right = 0, made = 0;
  tpa_view(context, &view);
  for (uint32_t f = 0; f < view.triangle_count; ++f) {
    left += material[f] == 0;
    right += material[f] == 1;
    made += material[f] == NEW_SURFACE;
  }
  printf("%u triangles of the left ball, %u of the right, %u new\n", (unsigned)left, (unsigned)right, (unsigned)made);
  free(block);
  return left > 0 && right > 0 && made > 0 ? 0 : 1;
}
