/* SPDX-License-Identifier: MIT */
/* A call that reaches a limit fails and changes nothing: a context with a larger limit takes the mesh over, and the
 * call is made again. Here a ball is remeshed with shorter and shorter edges. */
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
                              &config->max_pieces};
  const uint64_t twice = 2 * issue->available;
  *limits[issue->limit] = (uint32_t)(twice > issue->needed ? twice : issue->needed);
}

/* Moves the mesh of *context into a larger context, without targets and maps. */
static tpa_status grow(tpa_context** context, void** block, const tpa_config* config, tpa_issue* issue) {
  void* larger_block;
  tpa_context* larger = make_context(config, &larger_block, issue);
  tpa_mesh_view view = {.struct_size = sizeof view};
  if (larger == NULL) return issue->status != TPA_OK ? issue->status : TPA_E_ARENA;
  tpa_view(*context, &view);
  const tpa_mesh_input mesh = {.struct_size = sizeof mesh,
                               .vertex_count = view.vertex_count,
                               .triangle_count = view.triangle_count,
                               .position_type = TPA_FLOAT64,
                               .index_type = TPA_UINT32,
                               .positions = view.positions,
                               .triangles = view.triangles};
  const tpa_status status = tpa_load(larger, &mesh, issue);
  free(*block);
  *block = larger_block;
  *context = larger;
  return status;
}

int main(void) {
  tpa_issue issue = {.status = TPA_OK};
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = BALL_VERTICES;
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL) return fail(&issue);
  make_ball(0, 0, 0, 1);
  const tpa_mesh_input mesh = balls(1);
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);
  for (double length = 0.2; length > 0.04; length *= 0.5) {
    const tpa_remesh_options options = {
        .struct_size = sizeof options, .iterations = 5, .target_length = length, .relaxation = 0.5};
    tpa_report report = {.struct_size = sizeof report};
    while (tpa_remesh(context, &options, NULL, &report, &issue) == TPA_E_LIMIT) {
      fail(&issue); /* prints the issue */
      raise_limit(&config, &issue);
      if (grow(&context, &block, &config, &issue) != TPA_OK) return fail(&issue);
    }
    if (issue.status != TPA_OK) return fail(&issue);
    printf("edges of %.2f: %u vertices of at most %u\n", length, (unsigned)report.vertices,
           (unsigned)config.max_vertices);
  }
  free(block);
  return config.max_vertices > BALL_VERTICES ? 0 : 1;
}
