/* SPDX-License-Identifier: MIT */
/* A simulation that has so much time for each frame: a step that wants more work ends, nothing has changed, and the
 * frame makes do with half of the way. Another thread may also cancel a call, as here a user who closes the window.
 * docs/realtime.md tells how to find a budget. */
#include "balls.h"

/* Units of work for a frame: a unit takes 10 to 60 ns on a desktop processor. Measure yours, by exec.progress. */
#define UNITS_PER_FRAME 30000

/* Moves both balls towards each other. */
static tpa_status approach(tpa_context* context, double distance, tpa_issue* issue) {
  static double targets[2 * BALL_VERTICES][3];
  tpa_mesh_view view = {.struct_size = sizeof view};
  const tpa_move_input move = {
      .struct_size = sizeof move, .count = 2 * BALL_VERTICES, .position_type = TPA_FLOAT64, .positions = targets};
  tpa_view(context, &view);
  for (uint32_t v = 0; v < 2 * BALL_VERTICES; ++v) {
    for (uint32_t i = 0; i < 3; ++i) targets[v][i] = view.positions[3 * v + i];
    targets[v][0] += v < BALL_VERTICES ? distance : -distance;
  }
  return tpa_move(context, &move, issue);
}

/* A step within the budget, of the whole way or of a part. Returns the part, 0 if even little is too much. */
static double step_within(tpa_context* context, const tpa_exec* exec, double way, tpa_issue* issue) {
  for (double part = 1; part > 0.1; part /= 2) {
    if (approach(context, part * way, issue) != TPA_OK) return 0;
    if (tpa_step(context, exec, NULL, issue) != TPA_E_BUDGET) return issue->status == TPA_OK ? part : 0;
  }
  tpa_drop_targets(context);
  return 0;
}

int main(void) {
  tpa_config config;
  tpa_issue issue = {.status = TPA_OK};
  void* block;
  int32_t closing = 0;
  uint64_t units = 0, before = 0, after = 0;
  tpa_exec exec = {.struct_size = sizeof exec, .cancel = &closing, .progress = &units};
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 8 * BALL_VERTICES;
  make_ball(0, -1.3, 0, 1);
  make_ball(1, 1.3, 0.1, 1);
  tpa_context* context = make_context(&config, &block, &issue);
  const tpa_mesh_input mesh = balls(2);
  if (context == NULL || tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);

  /* What a frame costs without a bound. */
  if (approach(context, 0.05, &issue) != TPA_OK || tpa_step(context, &exec, NULL, &issue) != TPA_OK)
    return fail(&issue);
  printf("a frame costs %lu units\n", (unsigned long)units);

  exec.budget = UNITS_PER_FRAME;
  const double done = step_within(context, &exec, 0.4, &issue);
  printf("%.2f of the way, for %lu units of %lu\n", done, (unsigned long)units, (unsigned long)exec.budget);

  exec.budget = 1;
  tpa_digest(context, &before);
  if (step_within(context, &exec, 0.1, &issue) != 0 || issue.status != TPA_E_BUDGET) return fail(&issue);
  closing = 1; /* from any thread */
  exec.budget = 0;
  if (approach(context, 0.1, &issue) != TPA_OK || tpa_step(context, &exec, NULL, &issue) != TPA_E_CANCELLED) return 1;
  tpa_drop_targets(context);
  tpa_digest(context, &after);
  free(block);
  return done == 0.5 && before == after ? 0 : 1;
}
