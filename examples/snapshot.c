/* SPDX-License-Identifier: MIT */
/* A byte copy of the block is a snapshot. Here a step is taken back because a ball jumped across another, and made
 * again in shorter steps. The result is saved as bytes that any machine understands, and restored elsewhere.
 * report.approach tells that a jump was possible. A context holds no pointers, so memcpy rewinds it, for the same build
 * of the library. */
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

/* The state of a context in *size bytes, for a file or another machine; NULL after a failure. */
static void* save(const tpa_context* context, size_t* size, tpa_issue* issue) {
  if (tpa_save(context, NULL, 0, size, issue) != TPA_OK) return NULL;
  void* data = malloc(*size);
  if (data != NULL && tpa_save(context, data, *size, size, issue) == TPA_OK) return data;
  free(data);
  return NULL;
}

/* Is the digest of the data restored into a larger context the given one? */
static int goes_on_elsewhere(tpa_config config, const void* data, size_t size, uint64_t expected, tpa_issue* issue) {
  void* block;
  uint64_t digest = 0;
  config.max_vertices *= 2;
  tpa_context* context = make_context(&config, &block, issue);
  if (context != NULL && tpa_restore(context, data, size, issue) == TPA_OK) tpa_digest(context, &digest);
  free(block);
  printf("%u bytes, digest %08x%08x\n", (unsigned)size, (unsigned)(digest >> 32), (unsigned)digest);
  return digest == expected;
}

int main(void) {
  const double way = 12; /* from one side of the other ball to the other side */
  tpa_issue issue = {.status = TPA_OK};
  tpa_report report = {.struct_size = sizeof report};
  tpa_arena_size size;
  tpa_config config;
  uint64_t before, digest;
  size_t saved_size;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 8 * BALL_VERTICES;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL || tpa_arena_query(&config, &size, &issue) != TPA_OK) return fail(&issue);
  make_ball(0, -3, 0, 2);
  make_ball(1, 3, 0, 2);
  const tpa_mesh_input mesh = balls(2);
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);

  void* snapshot = malloc(size.bytes);
  if (snapshot == NULL) return 1;
  memcpy(snapshot, context, size.bytes); /* the context lies at the start of the block */
  tpa_digest(context, &before);
  if (push(context, way, &report, &issue) != TPA_OK) return fail(&issue);
  if (report.approach > THINNEST) {
    const int parts = (int)ceil(report.approach / THINNEST);
    memcpy(context, snapshot, size.bytes); /* rewind */
    tpa_digest(context, &digest);
    if (digest != before) return 1;
    for (int part = 0; part < parts && report.groups == 0; ++part)
      if (push(context, way / parts, &report, &issue) != TPA_OK) return fail(&issue);
  }
  tpa_digest(context, &digest);
  void* saved = save(context, &saved_size, &issue);
  if (saved == NULL) return fail(&issue);
  const int same = goes_on_elsewhere(config, saved, saved_size, digest, &issue);
  free(saved);
  free(snapshot);
  free(block);
  return report.groups > 0 && same ? 0 : 1;
}
