/* SPDX-License-Identifier: MIT */
/* Untangles a mesh: three overlapping balls are loaded and become the surface of their union. A step would refuse the
 * mesh (TPA_E_TANGLED); tpa_adapt resolves it once, and steps may follow. report.unresolved counts the pairs left; 0 is
 * the rule. */
#include "balls.h"

static void print(const char* when, const tpa_validation* v) {
  printf("%s: %u components, genus %d, %llu pairs of triangles meet\n", when, (unsigned)v->components, (int)v->genus,
         (unsigned long long)v->self_intersections);
}

int main(void) {
  tpa_issue issue = {.status = TPA_OK};
  tpa_validation before = {.struct_size = sizeof before}, after = before;
  tpa_report report = {.struct_size = sizeof report};
  tpa_config config;
  void* block;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 6 * BALL_VERTICES; /* twice the mesh: room for cut edges */
  tpa_context* context = make_context(&config, &block, &issue);
  if (context == NULL) return fail(&issue);
  make_ball(0, -1.5, 0, 2);
  make_ball(1, 1.5, 0, 2);
  make_ball(2, 0, 2.5, 2);
  const tpa_mesh_input mesh = balls(3);
  if (tpa_load(context, &mesh, &issue) != TPA_OK || tpa_validate(context, NULL, &before, &issue) != TPA_OK ||
      tpa_adapt(context, NULL, &report, &issue) != TPA_OK || tpa_validate(context, NULL, &after, &issue) != TPA_OK)
    return fail(&issue);
  print("before", &before);
  print("after", &after);
  if (report.unresolved > 0) printf("%u pairs could not be resolved\n", (unsigned)report.unresolved);
  free(block);
  return before.self_intersections > 0 && report.unresolved == 0 && after.components == 1 && after.genus == 0 ? 0 : 1;
}
