/* SPDX-License-Identifier: MIT */
#include "user_of_0_1.h"

#include <stdlib.h>
#include <string.h>

#include "header_0_1.h"

const uint32_t sizes_of_0_1[structs_of_0_1] = {sizeof(tpa_config),
                                               sizeof(tpa_mesh_input),
                                               sizeof(tpa_mesh_view),
                                               sizeof(tpa_mesh_output),
                                               sizeof(tpa_validation),
                                               sizeof(tpa_move_input),
                                               sizeof(tpa_exec),
                                               sizeof(tpa_contacts),
                                               sizeof(tpa_report),
                                               sizeof(tpa_remesh_options),
                                               sizeof(tpa_smooth_options),
                                               sizeof(tpa_vertex_map_view),
                                               sizeof(tpa_triangle_map_view),
                                               sizeof(tpa_handle_info)};

/* Structures lie in front of bytes that are neither zero nor to be written. */
enum { guard_bytes = 256, guard_value = 0xA5, most_structs = 32 };
static struct {
  unsigned char* begin;
  size_t size;
} guards[most_structs];
static int guard_count;

static void* guarded(size_t size) {
  unsigned char* s = malloc(size + guard_bytes);
  const uint32_t struct_size = (uint32_t)size;
  memset(s, 0, size);
  memcpy(s, &struct_size, sizeof struct_size);
  memset(s + size, guard_value, guard_bytes);
  guards[guard_count].begin = s;
  guards[guard_count++].size = size;
  return s;
}
static int guards_stand(void) {
  int i;
  size_t k;
  for (i = 0; i < guard_count; ++i)
    for (k = 0; k < guard_bytes; ++k)
      if (guards[i].begin[guards[i].size + k] != guard_value) return 0;
  return 1;
}

static double positions[2 * 6 * 3];
static uint32_t triangles[2 * 8 * 3];

static void fill(void) {
  static const double corner[6][3] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  static const uint32_t face[8][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                                      {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  uint32_t part, i, k;
  for (part = 0; part < 2; ++part) {
    for (i = 0; i < 6; ++i)
      for (k = 0; k < 3; ++k) positions[3 * (6 * part + i) + k] = corner[i][k] + (k == 0 ? 3.0 * part : 0.125 * part);
    for (i = 0; i < 8; ++i)
      for (k = 0; k < 3; ++k) triangles[3 * (8 * part + i) + k] = face[i][k] + 6 * part;
  }
}

static void serially(void* user, uint32_t count, void (*task)(void* data, uint32_t index), void* data) {
  uint32_t i;
  (void)user;
  for (i = 0; i < count; ++i) task(data, i);
}

#define TRY(call)                                \
  do {                                           \
    if ((call) != TPA_OK) return #call;          \
    if (!guards_stand()) return "guard: " #call; \
  } while (0)

static const char* make(void** block, tpa_context** context) {
  tpa_config* config = guarded(sizeof *config);
  tpa_arena_size size;
  char* memory;
  TRY(tpa_config_init(config, sizeof *config));
  config->max_vertices = 1000;
  TRY(tpa_arena_query(config, &size, NULL));
  memory = *block = malloc(size.bytes + size.alignment);
  while ((uintptr_t)memory % size.alignment != 0) ++memory;
  TRY(tpa_init(memory, size.bytes, config, context, NULL));
  return NULL;
}

static const char* load_and_move(tpa_context* context) {
  tpa_mesh_input* mesh = guarded(sizeof *mesh);
  tpa_move_input* move = guarded(sizeof *move);
  double moved[6 * 3];
  const uint32_t vertices[6] = {6, 7, 8, 9, 10, 11};
  int i;
  fill();
  mesh->vertex_count = 12;
  mesh->triangle_count = 16;
  mesh->position_type = TPA_FLOAT64;
  mesh->index_type = TPA_UINT32;
  mesh->positions = positions;
  mesh->triangles = triangles;
  TRY(tpa_load(context, mesh, NULL));
  for (i = 0; i < 18; ++i) moved[i] = positions[18 + i] - (i % 3 == 0 ? 1.25 : 0);
  move->count = 6;
  move->position_type = TPA_FLOAT64;
  move->positions = moved;
  move->vertices = vertices;
  TRY(tpa_move(context, move, NULL));
  return NULL;
}

static const char* work(tpa_context* context, outcome_of_0_1* outcome) {
  tpa_exec* exec = guarded(sizeof *exec);
  tpa_report* report = guarded(sizeof *report);
  tpa_contacts* contacts = guarded(sizeof *contacts);
  tpa_remesh_options* remesh = guarded(sizeof *remesh);
  tpa_smooth_options* smooth = guarded(sizeof *smooth);
  exec->parallel_for = serially;
  TRY(tpa_step(context, exec, report, NULL));
  outcome->region_before = report->region_before;
  TRY(tpa_adapt(context, exec, report, NULL));
  remesh->iterations = 2;
  remesh->target_length = 0.5;
  TRY(tpa_remesh(context, remesh, exec, report, NULL));
  smooth->iterations = 2;
  TRY(tpa_smooth(context, smooth, exec, report, NULL));
  outcome->vertices = report->vertices;
  outcome->triangles = report->triangles;
  TRY(tpa_detect(context, exec, contacts, NULL));
  outcome->pairs = contacts->count;
  return NULL;
}

static const char* look(tpa_context* context, outcome_of_0_1* outcome) {
  tpa_mesh_view* view = guarded(sizeof *view);
  tpa_mesh_output* output = guarded(sizeof *output);
  tpa_validation* validation = guarded(sizeof *validation);
  tpa_vertex_map_view* vertex_map = guarded(sizeof *vertex_map);
  tpa_triangle_map_view* triangle_map = guarded(sizeof *triangle_map);
  tpa_handle_info* info = guarded(sizeof *info);
  const uint32_t sides[3] = {5, 4, 3};
  TRY(tpa_view(context, view));
  TRY(tpa_export(context, output, NULL));
  TRY(tpa_validate(context, NULL, validation, NULL));
  TRY(tpa_vertex_map(context, vertex_map));
  TRY(tpa_triangle_map(context, triangle_map));
  TRY(tpa_handle_describe(3, sides, info));
  if (view->struct_size != sizeof *view || view->positions == NULL) return "view";
  if (output->vertex_count != view->vertex_count || output->triangle_count != view->triangle_count) return "export";
  if (vertex_map->new_count != view->vertex_count || triangle_map->new_count != view->triangle_count) return "maps";
  outcome->volume = validation->volume;
  outcome->handles = (uint32_t)info->handles;
  return NULL;
}

const char* run_user_of_0_1(outcome_of_0_1* outcome) {
  void* block = NULL;
  tpa_context* context = NULL;
  const char* fault = make(&block, &context);
  if (fault == NULL) fault = load_and_move(context);
  if (fault == NULL) fault = work(context, outcome);
  if (fault == NULL) fault = look(context, outcome);
  while (guard_count > 0) free(guards[--guard_count].begin);
  free(block);
  return fault;
}
