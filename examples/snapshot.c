/* SPDX-License-Identifier: MIT */
/* A byte copy of the block is a snapshot. Here a step is taken back because a ball jumped across another, and made
 * again in shorter steps. */
#include "balls.h"

#define THINNEST 1.0 /* no part of the bodies is thinner in places of contact */

/* Moves the first ball along x, in a single step. */
static tpa_status push(tpa_context* context, double distance, tpa_report* report, tpa_issue* issue) {
  static double targets[BALL_VERTICES][3];
  tpa_mesh_view view = {.struct_size = sizeof view};
  const tpa_move_input move = {
      .struct_size = sizeof move, .count = BALL_VERTICES, .position_type = TPA_FLOAT64, .positions = targets};
  tpa_view(context, &view);
  for (uint32_t v = 0; v < BALL_VERTICES; ++v) {
    for (uint32_t i = 0; i < 3; ++i) targets[v][i] = view.positions[3 * v + i];
    targets[v][0] += distance;
  }
  const tpa_status status = tpa_move(context, &move, issue);
  if (status != TPA_OK || tpa_step(context, NULL, report, issue) != TPA_OK) return issue->status;
  printf("a step of %.2f: approach %.2f, %u contacts, %u handles\n", distance, report->approach,
         (unsigned)report->contacts, (unsigned)report->handles[0]);
  return TPA_OK;
}

int main(void) {
  const double way = 12; /* from one side of the other ball to the other side */
  tpa_issue issue = {.status = TPA_OK};
  tpa_report report = {.struct_size = sizeof report};
  tpa_arena_size size;
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 4 * BALL_VERTICES;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL || tpa_arena_query(&config, &size, &issue) != TPA_OK) return fail(&issue);
  make_ball(0, -3, 0, 2);
  make_ball(1, 3, 0, 2);
  const tpa_mesh_input mesh = balls(2);
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);

  void* snapshot = malloc(size.bytes);
  if (snapshot == NULL) return 1;
  memcpy(snapshot, context, size.bytes); /* the context lies at the start of the block */
  if (push(context, way, &report, &issue) != TPA_OK) return fail(&issue);
  if (report.approach > THINNEST) {
    const int parts = (int)ceil(report.approach / THINNEST);
    memcpy(context, snapshot, size.bytes); /* rewind */
    for (int part = 0; part < parts && report.handles[0] == 0; ++part)
      if (push(context, way / parts, &report, &issue) != TPA_OK) return fail(&issue);
  }
  free(snapshot);
  free(block);
  return report.handles[0] == 1 ? 0 : 1;
}
