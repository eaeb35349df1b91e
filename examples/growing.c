/* SPDX-License-Identifier: MIT */
/* A call that reaches a limit fails and changes nothing: a larger context takes everything over, and the call is made
 * again. Here two balls grow together in a context with next to no room, with the bits of a context that has plenty.
 * docs/limits.md helps to need no growth. */
#include "balls.h"

/* Twice the limit named by the issue, and at least enough. */
static void raise_limit(tpa_config* config, const tpa_issue* issue) {
  uint32_t* const limits[] = {NULL,
                              &config->max_vertices,
                              &config->max_triangles,
                              &config->max_contacts,
                              &config->max_cut_edges,
                              &config->max_events,
                              &config->max_components,
                              &config->max_pieces,
                              &config->max_substeps};
  const uint64_t twice = 2 * issue->available;
  *limits[issue->limit] = (uint32_t)(twice > issue->needed ? twice : issue->needed);
}

/* Moves *context into a larger block. */
static tpa_status grow(tpa_context** context, void** block, const tpa_config* config, tpa_issue* issue) {
  tpa_arena_size size;
  tpa_context* bigger;
  if (tpa_arena_query(config, &size, issue) != TPA_OK) return issue->status;
  void* larger = malloc(size.bytes);
  if (larger == NULL) return issue->status = TPA_E_ARENA;
  if (tpa_grow(*context, larger, size.bytes, config, &bigger, issue) != TPA_OK) {
    free(larger);
    return issue->status;
  }
  free(*block);
  *block = larger;
  *context = bigger;
  return TPA_OK;
}

/* Wants the balls nearer to each other. */
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

/* Two steps, the second with contacts. Returns the digest of the result, or 0 after a failure; counts the growths. */
static uint64_t merge(tpa_config config, uint32_t* growths) {
  tpa_issue issue = {.status = TPA_OK};
  uint64_t digest = 0;
  void* block;
  tpa_context* context = make_context(&config, &block, &issue);
  const tpa_mesh_input mesh = balls(2);
  if (context == NULL || tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue), free(block), 0;
  for (int step = 0; step < 2; ++step) {
    if (approach(context, 0.25, &issue) != TPA_OK) break;
    while (tpa_step(context, NULL, NULL, &issue) == TPA_E_LIMIT) {
      fail(&issue); /* prints the issue */
      raise_limit(&config, &issue);
      if (grow(&context, &block, &config, &issue) != TPA_OK) break;
      ++*growths;
    }
    if (issue.status != TPA_OK) break;
  }
  if (issue.status == TPA_OK)
    tpa_digest(context, &digest);
  else
    fail(&issue);
  free(block);
  return digest;
}

int main(void) {
  uint32_t growths = 0, none = 0;
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  make_ball(0, -1.3, 0, 1);
  make_ball(1, 1.3, 0.1, 1);
  config.max_vertices = 8 * BALL_VERTICES;
  const uint64_t with_plenty = merge(config, &none);
  config.max_vertices = 2 * BALL_VERTICES;
  config.max_triangles = 2 * BALL_TRIANGLES;
  config.max_contacts = config.max_events = 1;
  config.max_cut_edges = 3;
  const uint64_t with_little = merge(config, &growths);
  printf("grown %u times, digest %08x%08x, with room from the start %08x%08x\n", (unsigned)growths,
         (unsigned)(with_little >> 32), (unsigned)with_little, (unsigned)(with_plenty >> 32), (unsigned)with_plenty);
  return growths > 0 && none == 0 && with_little != 0 && with_little == with_plenty ? 0 : 1;
}
