/* SPDX-License-Identifier: MIT */
/* Limits from a trial: the same run in a roomy context, whose peaks become the limits of a small one with equal bits.
 */
#include "balls.h"

/* The limits, and the tables whose peaks count them. */
static void read_peaks(const tpa_context* context, tpa_config* config) {
  const struct {
    const char* table;
    uint32_t* limit;
  } limits[] = {{"position", &config->max_vertices},      {"corner", &config->max_triangles},
                {"contact_pairs", &config->max_contacts}, {"cuts", &config->max_cut_edges},
                {"events", &config->max_events},          {"components", &config->max_components},
                {"scratch", &config->max_pieces}};
  tpa_memory_table tables[64];
  uint32_t count = 0;
  tpa_memory_stats(context, tables, 64, &count);
  for (size_t i = 0; i < sizeof limits / sizeof *limits; ++i) *limits[i].limit = 1;
  config->max_cut_edges = 3; /* the least allowed */
  for (uint32_t t = 0; t < count && t < 64; ++t)
    for (size_t i = 0; i < sizeof limits / sizeof *limits; ++i)
      if (strcmp(tables[t].name, limits[i].table) == 0 && tables[t].peak > *limits[i].limit)
        *limits[i].limit = (uint32_t)tables[t].peak;
}

/* Brings the balls together, a step at a time. */
static tpa_status merge(tpa_context* context, tpa_issue* issue) {
  static double targets[8 * BALL_VERTICES][3];
  tpa_move_input move = {.struct_size = sizeof move, .position_type = TPA_FLOAT64, .positions = targets};
  const tpa_mesh_input mesh = balls(2);
  tpa_status status = tpa_load(context, &mesh, issue);
  for (int step = 0; step < 12 && status == TPA_OK; ++step) {
    tpa_mesh_view view = {.struct_size = sizeof view};
    tpa_view(context, &view);
    move.count = view.vertex_count;
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
      for (uint32_t i = 0; i < 3; ++i) targets[v][i] = view.positions[3 * v + i];
      targets[v][0] += view.positions[3 * v] < 0 ? 0.05 : -0.05;
    }
    status = tpa_move(context, &move, issue);
    if (status == TPA_OK) status = tpa_step(context, NULL, NULL, issue);
  }
  return status;
}

/* Runs in a block for the config. Returns the digest, 0 after a failure; *peaks receives the limits that were needed.
 */
static uint64_t run(const tpa_config* config, tpa_config* peaks, size_t* bytes) {
  tpa_issue issue = {.status = TPA_OK};
  tpa_arena_size size;
  uint64_t digest = 0;
  void* block;
  tpa_context* context = make_context(config, &block, &issue);
  if (context == NULL || merge(context, &issue) != TPA_OK) return fail(&issue), free(block), 0;
  tpa_arena_query(config, &size, &issue);
  *bytes = size.bytes;
  tpa_digest(context, &digest);
  read_peaks(context, peaks);
  free(block);
  return digest;
}

int main(void) {
  tpa_config roomy, tight, again;
  size_t before = 0, after = 0;
  tpa_config_init(&roomy, sizeof roomy);
  roomy.max_vertices = 8 * BALL_VERTICES;
  tight = again = roomy;
  make_ball(0, -1.3, 0, 1);
  make_ball(1, 1.3, 0.1, 1);
  const uint64_t first = run(&roomy, &tight, &before), second = run(&tight, &again, &after);
  printf("vertices %u, triangles %u, contacts %u, cut edges %u, events %u, components %u, pieces %u\n",
         (unsigned)tight.max_vertices, (unsigned)tight.max_triangles, (unsigned)tight.max_contacts,
         (unsigned)tight.max_cut_edges, (unsigned)tight.max_events, (unsigned)tight.max_components,
         (unsigned)tight.max_pieces);
  printf("%u kB instead of %u, %s bits\n", (unsigned)(after / 1000), (unsigned)(before / 1000),
         first == second ? "the same" : "other");
  return first != 0 && first == second && 2 * after < before ? 0 : 1;
}
