/* SPDX-License-Identifier: MIT */
/* A long move in sub-steps. The first ball jumps over the second: a single step sees nothing, tpa_advance sees both
 * meet. All sub-steps are one commit, so velocities follow the vertices through the maps of the whole call.
 * config.max_substeps takes the memory for it. */
#include "balls.h"

#define THINNEST 1.0 /* no part of the bodies is thinner in places of contact */

/* Targets for the first ball, a way along x. */
static tpa_status aim(tpa_context* context, double distance, tpa_issue* issue) {
  static double targets[BALL_VERTICES][3];
  tpa_mesh_view view = {.struct_size = sizeof view};
  const tpa_move_input move = {
      .struct_size = sizeof move, .count = BALL_VERTICES, .position_type = TPA_FLOAT64, .positions = targets};
  tpa_view(context, &view);
  memcpy(targets, view.positions, sizeof targets);
  for (uint32_t v = 0; v < BALL_VERTICES; ++v) targets[v][0] += distance;
  return tpa_move(context, &move, issue);
}

static tpa_status load(tpa_context* context, tpa_issue* issue) {
  make_ball(0, -3, 0, 2);
  make_ball(1, 3, 0, 2);
  const tpa_mesh_input mesh = balls(2);
  return tpa_load(context, &mesh, issue);
}

int main(void) {
  const double way = 7; /* into the other ball */
  static float speed[2 * BALL_VERTICES], carried[8 * BALL_VERTICES];
  tpa_issue issue = {.status = TPA_OK};
  tpa_report step = {.struct_size = sizeof step}, report = {.struct_size = sizeof report};
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 8 * BALL_VERTICES;
  config.max_substeps = 100;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL) return fail(&issue);

  if (load(context, &issue) != TPA_OK || aim(context, 12, &issue) != TPA_OK) return fail(&issue);
  if (tpa_step(context, NULL, &step, &issue) != TPA_OK) return fail(&issue);
  printf("a step of 12: approach %.2f, %u contacts\n", step.approach, (unsigned)step.contacts);

  if (load(context, &issue) != TPA_OK) return fail(&issue);
  if (aim(context, way, &issue) != TPA_OK) return fail(&issue);
  if (tpa_advance(context, THINNEST, NULL, &report, &issue) != TPA_OK) return fail(&issue);
  for (uint32_t v = 0; v < 2 * BALL_VERTICES; ++v) speed[v] = v < BALL_VERTICES ? (float)way : 0;
  tpa_carry_vertices(context, speed, 1, carried); /* through all sub-steps */
  printf("%u sub-steps: approach %.2f, %u contacts, %u vertices\n", (unsigned)report.substeps, report.approach,
         (unsigned)report.contacts, (unsigned)report.vertices);
  free(block);
  return step.contacts == 0 && report.contacts > 0 && report.approach < THINNEST ? 0 : 1;
}
