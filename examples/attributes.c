/* SPDX-License-Identifier: MIT */
/* Attributes follow the mesh through a solver's steps: a velocity for each vertex, a material for each triangle. Two
 * balls fly towards each other and merge; new vertices get velocities between those of their parents.
 * Arrays get the numbering of the new mesh after every commit: after the step, and after the remeshing. New surface, of
 * handles and caps, has no origin. docs/attributes.md tells more. */
#include "balls.h"

#define MOST_VERTICES (4 * BALL_VERTICES)
#define MOST_TRIANGLES (2 * MOST_VERTICES + 1024) /* as the library's default */
#define NEW_SURFACE 2

static float velocity[MOST_VERTICES], old_velocity[MOST_VERTICES]; /* along x, in lengths per second */
static uint8_t material[MOST_TRIANGLES], old_material[MOST_TRIANGLES];

/* After each commit, before the next: the arrays get the numbering of the new mesh. */
static void follow(const tpa_context* context) {
  tpa_triangle_map_view faces = {.struct_size = sizeof faces};
  tpa_triangle_map(context, &faces);
  memcpy(old_velocity, velocity, sizeof velocity);
  memcpy(old_material, material, sizeof material);
  tpa_carry_vertices(context, old_velocity, 1, velocity);
  for (uint32_t f = 0; f < faces.new_count; ++f)
    material[f] = faces.origins[f] == TPA_NONE ? NEW_SURFACE : old_material[faces.origins[f]];
}

/* One step of the solver: moves every vertex by velocity * dt, then evens out the edges. */
static tpa_status advance(tpa_context* context, double dt, tpa_issue* issue) {
  static double targets[MOST_VERTICES][3];
  const tpa_remesh_options even = {
      .struct_size = sizeof even, .iterations = 1, .target_length = 0.5, .relaxation = 0.3};
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_move_input move = {.struct_size = sizeof move, .position_type = TPA_FLOAT64, .positions = targets};
  tpa_status status = tpa_view(context, &view);
  move.count = view.vertex_count;
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    for (uint32_t i = 0; i < 3; ++i) targets[v][i] = view.positions[3 * v + i];
    targets[v][0] += velocity[v] * dt;
  }
  if (status == TPA_OK) status = tpa_move(context, &move, issue);
  if (status == TPA_OK) status = tpa_step(context, NULL, NULL, issue);
  if (status != TPA_OK) return status;
  follow(context);
  status = tpa_remesh(context, &even, NULL, NULL, issue);
  if (status == TPA_OK) follow(context);
  return status;
}

int main(void) {
  tpa_issue issue = {.status = TPA_OK};
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = MOST_VERTICES;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL) return fail(&issue);
  make_ball(0, -2.3, 0, 2);
  make_ball(1, 2.3, 0, 2);
  for (uint32_t v = 0; v < 2 * BALL_VERTICES; ++v) velocity[v] = v < BALL_VERTICES ? 1 : -1;
  for (uint32_t f = 0; f < 2 * BALL_TRIANGLES; ++f) material[f] = f < BALL_TRIANGLES ? 0 : 1;
  const tpa_mesh_input mesh = balls(2);
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);
  for (int step = 0; step < 5; ++step)
    if (advance(context, 0.1, &issue) != TPA_OK) return fail(&issue);

  uint32_t count[3] = {0, 0, 0}, between = 0;
  tpa_view(context, &view);
  for (uint32_t f = 0; f < view.triangle_count; ++f) ++count[material[f]];
  for (uint32_t v = 0; v < view.vertex_count; ++v) between += velocity[v] > -1 && velocity[v] < 1;
  printf("%u triangles of the left ball, %u of the right, %u new; %u vertices of mixed velocity\n", (unsigned)count[0],
         (unsigned)count[1], (unsigned)count[NEW_SURFACE], (unsigned)between);
  free(block);
  return count[0] > 0 && count[1] > 0 && count[NEW_SURFACE] > 0 ? 0 : 1;
}
