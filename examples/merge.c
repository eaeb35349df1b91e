/* SPDX-License-Identifier: MIT */
/* Two balls move towards each other, step by step, and become one; prints a line for each step and each event. */
#include "balls.h"

/* Targets for all vertices: the left ball goes right, the right ball left. */
static tpa_status approach(tpa_context* context, double distance, tpa_issue* issue) {
  static double targets[2 * BALL_VERTICES][3];
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_move_input move = {.struct_size = sizeof move, .position_type = TPA_FLOAT64, .positions = targets};
  tpa_view(context, &view);
  move.count = view.vertex_count;
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    for (uint32_t i = 0; i < 3; ++i) targets[v][i] = view.positions[3 * v + i];
    targets[v][0] += v < BALL_VERTICES ? distance : -distance;
  }
  return tpa_move(context, &move, issue);
}

/* The changes of topology in the last step. */
static void print_events(const tpa_context* context) {
  static const char* const names[] = {"",      "handle",   "cap",        "removal", "rollback", "merge",
                                      "split", "genus up", "genus down", "",        "death"};
  const tpa_event* events;
  uint32_t count;
  tpa_events(context, &events, &count);
  for (uint32_t i = 0; i < count; ++i)
    printf("  %s: amount %u, component %d to %d, at (%.2f, %.2f, %.2f)\n", names[events[i].type],
           (unsigned)events[i].amount, (int)events[i].before, (int)events[i].after, events[i].position[0],
           events[i].position[1], events[i].position[2]);
}

int main(void) {
  tpa_issue issue = {.status = TPA_OK};
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 4 * BALL_VERTICES;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL) return fail(&issue);
  make_ball(0, -3, 0, 2);
  make_ball(1, 3, 0, 2);
  const tpa_mesh_input mesh = balls(2);
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);

  tpa_validation now = {.struct_size = sizeof now};
  for (int step = 1; step <= 20 && now.components != 1; ++step) {
    tpa_report report = {.struct_size = sizeof report};
    if (approach(context, 0.15, &issue) != TPA_OK || tpa_step(context, NULL, &report, &issue) != TPA_OK ||
        tpa_validate(context, NULL, &now, &issue) != TPA_OK)
      return fail(&issue);
    printf("step %2d: %3u contacts, %u components, genus %d, %u vertices, volume %.3f\n", step,
           (unsigned)report.contacts, (unsigned)now.components, (int)now.genus, (unsigned)report.vertices, now.volume);
    print_events(context);
  }
  free(block);
  return now.components == 1 && now.genus == 0 && now.self_intersections == 0 ? 0 : 1;
}
