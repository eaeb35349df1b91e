/* SPDX-License-Identifier: MIT */
#include "surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ball.h"

#define RANGES 64
#define BALL_RADIUS 0.6   /* as world.h says */
#define BARE_DISTANCE 0.9 /* a ball there does not touch what is farther */

static int fail(const tpa_issue* issue) {
  char line[200];
  tpa_issue_text(issue, line, sizeof line);
  fprintf(stderr, "game: %s\n", line);
  return 0;
}

/* ---------------------------------------------------------------- attributes */

static void swap_attributes(Surface* s) {
  float* const attributes = s->attributes;
  uint8_t* const owners = s->owners;
  s->attributes = s->before;
  s->before = attributes;
  s->owners = s->owners_before;
  s->owners_before = owners;
}

/* After each commit. Colours and texture coordinates are blended; an owner cannot be: the nearer parent's. */
static void carry(Surface* s) {
  tpa_vertex_map_view map = {.struct_size = sizeof map};
  tpa_vertex_map(s->context, &map);
  swap_attributes(s);
  tpa_carry_vertices(s->context, s->before, FLOATS, s->attributes);
  for (uint32_t v = 0; v < map.new_count; ++v) {
    const tpa_vertex_origin* origin = &map.origins[v];
    s->owners[v] = s->owners_before[origin->weight < 0.5f ? origin->parents[1] : origin->parents[0]];
  }
}

/* ---------------------------------------------------------------- the graphics processor */

static void pack(const Surface* s, const tpa_mesh_view* view, uint32_t first, uint32_t count) {
  for (uint32_t v = first; v < first + count; ++v) {
    GpuVertex* out = &s->packed[v - first];
    for (int i = 0; i < 3; ++i) {
      out->place[i] = (float)view->positions[3 * v + (uint32_t)i];
      out->colour[i] = s->attributes[FLOATS * v + (uint32_t)i];
    }
    memcpy(out->texture, &s->attributes[FLOATS * v + 3], sizeof out->texture);
  }
}

/* Carved surface reddens. Only vertices that are copied anyway, so that the processor misses no colour. */
static void paint(Surface* s, const World* world, const tpa_mesh_view* view, tpa_range range) {
  static const float flesh[3] = {0.85f, 0.3f, 0.2f};
  for (uint32_t v = range.first; v < range.first + range.count; ++v) {
    float* colour = s->attributes + FLOATS * v;
    if (world_carves(world, view->positions + 3 * v))
      for (uint32_t i = 0; i < 3; ++i) colour[i] += 0.04f * (flesh[i] - colour[i]);
  }
}

/* After each commit: what has changed since the one before. */
static int show(Surface* s, const World* world, Gpu* gpu, tpa_issue* issue) {
  tpa_range vertices[RANGES], triangles[RANGES];
  tpa_change_list changes = {.struct_size = sizeof changes,
                             .gap = 4,
                             .vertex_capacity = RANGES,
                             .triangle_capacity = RANGES,
                             .vertices = vertices,
                             .triangles = triangles};
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_view(s->context, &view);
  if (tpa_changes(s->context, &changes, issue) != TPA_OK) return fail(issue);
  for (uint32_t r = 0; r < changes.vertex_ranges; ++r) {
    const tpa_range range = vertices[r];
    paint(s, world, &view, range);
    pack(s, &view, range.first, range.count);
    if (!gpu_copy(gpu, &gpu->vertices, range.first * sizeof *s->packed, s->packed, range.count * sizeof *s->packed))
      return 0;
  }
  for (uint32_t r = 0; r < changes.triangle_ranges; ++r) {
    const size_t size = 3 * sizeof *view.triangles;
    if (!gpu_copy(gpu, &gpu->triangles, triangles[r].first * size, view.triangles + 3 * triangles[r].first,
                  triangles[r].count * size))
      return 0;
  }
  gpu->vertex_count = view.vertex_count;
  gpu->triangle_count = view.triangle_count;
  gpu->bytes_whole += view.vertex_count * sizeof *s->packed + view.triangle_count * 3 * sizeof *view.triangles;
  return 1;
}

int surface_is_shown(Surface* s, const Gpu* gpu) {
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_view(s->context, &view);
  pack(s, &view, 0, view.vertex_count);
  return gpu->vertex_count == view.vertex_count && gpu->triangle_count == view.triangle_count &&
         memcmp(gpu->vertices.bytes, s->packed, view.vertex_count * sizeof *s->packed) == 0 &&
         memcmp(gpu->triangles.bytes, view.triangles, view.triangle_count * 3 * sizeof *view.triangles) == 0;
}

/* ---------------------------------------------------------------- new balls */

/* In the colour of the heart; texture coordinates by the place seen from the front. */
static void colour_ball(Surface* s, uint32_t heart, uint32_t first, const double (*directions)[3]) {
  for (uint32_t v = 0; v < BALL_VERTICES; ++v) {
    float* out = s->attributes + FLOATS * (first + v);
    for (uint32_t c = 0; c < 3; ++c) out[c] = (heart + 1) >> c & 1 ? 0.95f : 0.45f;
    out[3] = (float)(0.5 + 0.5 * directions[v][0]);
    out[4] = (float)(0.5 + 0.5 * directions[v][1]);
    s->owners[first + v] = (uint8_t)heart;
  }
}

/* Loads the mesh again, and a ball round the heart. All others keep their ids. */
static int add_ball(Surface* s, const World* world, uint32_t heart, tpa_issue* issue) {
  static double directions[BALL_VERTICES][3];
  static uint32_t ball[BALL_TRIANGLES][3];
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_view(s->context, &view); /* nothing yet at the start */
  const uint32_t vertices = view.vertex_count, triangles = view.triangle_count;
  const tpa_mesh_input mesh = {.struct_size = sizeof mesh,
                               .vertex_count = vertices + BALL_VERTICES,
                               .triangle_count = triangles + BALL_TRIANGLES,
                               .position_type = TPA_FLOAT64,
                               .index_type = TPA_UINT32,
                               .positions = s->targets,
                               .triangles = s->corners};
  if (mesh.vertex_count > MOST_VERTICES || mesh.triangle_count > MOST_TRIANGLES) return 1;
  if (vertices > 0) {
    memcpy(s->targets, view.positions, 3 * vertices * sizeof *s->targets);
    memcpy(s->corners, view.triangles, 3 * triangles * sizeof *s->corners);
  }
  ball_make(directions, ball);
  for (uint32_t v = 0; v < BALL_VERTICES; ++v)
    for (uint32_t i = 0; i < 3; ++i)
      s->targets[3 * (vertices + v) + i] = world->hearts[heart].at[i] + BALL_RADIUS * directions[v][i];
  for (uint32_t t = 0; t < BALL_TRIANGLES; ++t)
    for (uint32_t i = 0; i < 3; ++i) s->corners[3 * (triangles + t) + i] = vertices + ball[t][i];
  colour_ball(s, heart, vertices, (const double(*)[3])directions);
  return tpa_load(s->context, &mesh, issue) == TPA_OK || fail(issue);
}

/* No surface is near the heart: the heart is outside of all blobs, since no blob is so thick. */
static int is_bare(const Surface* s, const double heart[3]) {
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_view(s->context, &view);
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    const double x = view.positions[3 * v] - heart[0], y = view.positions[3 * v + 1] - heart[1],
                 z = view.positions[3 * v + 2] - heart[2];
    if (x * x + y * y + z * z < BARE_DISTANCE * BARE_DISTANCE) return 0;
  }
  return 1;
}

/* Looks at a heart in each frame. A heart that has lost its ball gets another: *revived. */
static int revive(Surface* s, const World* world, Gpu* gpu, int* revived, Story* story, tpa_issue* issue) {
  const uint32_t heart = world->frame % world->blobs;
  *revived = is_bare(s, world->hearts[heart].at);
  if (!*revived) return 1;
  ++story->revived;
  return add_ball(s, world, heart, issue) && show(s, world, gpu, issue);
}

/* ---------------------------------------------------------------- a frame */

static void tell(const tpa_context* context, Story* story) {
  const tpa_event* events;
  uint32_t count;
  tpa_events(context, &events, &count);
  for (uint32_t i = 0; i < count; ++i) switch (events[i].type) {
      case TPA_EVENT_MERGE: ++story->merges; break;
      case TPA_EVENT_SPLIT: ++story->splits; break;
      case TPA_EVENT_GENUS_UP: story->genus_up += events[i].amount; break;
      case TPA_EVENT_GENUS_DOWN: story->genus_down += events[i].amount; break;
      case TPA_EVENT_DEATH: ++story->deaths; break;
      case TPA_EVENT_ROLLBACK: story->left_behind += events[i].amount; break;
      default: break;
    }
}

/* The vertices that move in this frame, and their targets. */
static uint32_t aim(Surface* s, const World* world) {
  tpa_mesh_view view = {.struct_size = sizeof view};
  uint32_t count = 0;
  tpa_view(s->context, &view);
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    const double* at = view.positions + 3 * v;
    double way[3];
    if (world_way(world, at, way) == 0) continue;
    for (int i = 0; i < 3; ++i) s->targets[3 * count + (uint32_t)i] = at[i] + way[i];
    s->movers[count++] = v;
  }
  return count;
}

/* The step of a frame. What its units do not hold waits for the next frame. *moved: there was a commit. */
static int move(Surface* s, const World* world, uint64_t budget, uint64_t* units, int* moved, Story* story,
                tpa_issue* issue) {
  tpa_report report = {.struct_size = sizeof report};
  const tpa_exec exec = {.struct_size = sizeof exec, .flags = TPA_EXEC_KEEP, .budget = budget, .progress = units};
  const uint32_t count = aim(s, world);
  const tpa_move_input move = {.struct_size = sizeof move,
                               .count = count,
                               .position_type = TPA_FLOAT64,
                               .positions = s->targets,
                               .vertices = s->movers};
  *moved = 0;
  if (count == 0) return 1;
  if (tpa_move(s->context, &move, issue) != TPA_OK) return fail(issue);
  if (tpa_step(s->context, &exec, &report, issue) != TPA_OK) return fail(issue);
  *moved = 1;
  s->late_frames = report.unfinished > 0 ? s->late_frames + 1 : 0;
  if (report.unfinished > 0) ++story->held_back;
  if (s->late_frames > story->latest) story->latest = s->late_frames;
  tell(s->context, story);
  return 1;
}

/* Evens out the edges with the units that are left. What these do not hold waits for the next frame. *changed: there
 * was a commit; none where the units do not even hold the check of the work done. */
static int remesh(Surface* s, const World* world, uint64_t budget, uint64_t* units, int* changed, Story* story,
                  tpa_issue* issue) {
  const tpa_remesh_options options = {
      .struct_size = sizeof options, .iterations = 1, .target_length = world->edge, .relaxation = 0.5};
  uint64_t spent = 0;
  tpa_report report = {.struct_size = sizeof report};
  const tpa_exec exec = {
      .struct_size = sizeof exec, .flags = TPA_EXEC_KEEP, .budget = budget - *units, .progress = &spent};
  const tpa_status status = tpa_remesh(s->context, &options, &exec, &report, issue);
  *changed = status == TPA_OK;
  *units += spent;
  if (status != TPA_OK && status != TPA_E_BUDGET) return fail(issue);
  if (!*changed || report.unfinished > 0) ++story->put_off;
  return 1;
}

static int follow(Surface* s, const World* world, Gpu* gpu, tpa_issue* issue) {
  carry(s);
  return show(s, world, gpu, issue);
}

/* A third of the units is left to the remeshing, and more where the step does not need its part. */
int surface_frame(Surface* s, const World* world, Gpu* gpu, uint64_t budget, uint64_t* units, Story* story) {
  tpa_issue issue = {.status = TPA_OK};
  int changed;
  *units = 0;
  if (!revive(s, world, gpu, &changed, story, &issue)) return 0;
  if (changed) return 1;
  if (!move(s, world, budget - budget / 3, units, &changed, story, &issue)) return 0;
  if (!changed) return 1;
  if (!follow(s, world, gpu, &issue)) return 0;
  if (!remesh(s, world, budget, units, &changed, story, &issue)) return 0;
  return !changed || follow(s, world, gpu, &issue);
}

/* ---------------------------------------------------------------- begin and end */

static int take_memory(Surface* s) {
  s->attributes = calloc(MOST_VERTICES, FLOATS * sizeof *s->attributes);
  s->before = calloc(MOST_VERTICES, FLOATS * sizeof *s->before);
  s->owners = calloc(MOST_VERTICES, 1);
  s->owners_before = calloc(MOST_VERTICES, 1);
  s->targets = calloc(MOST_VERTICES, 3 * sizeof *s->targets);
  s->corners = calloc(MOST_TRIANGLES, 3 * sizeof *s->corners);
  s->movers = calloc(MOST_VERTICES, sizeof *s->movers);
  s->packed = calloc(MOST_VERTICES, sizeof *s->packed);
  return s->attributes && s->before && s->owners && s->owners_before && s->targets && s->corners && s->movers &&
         s->packed;
}

static int make_context(Surface* s, tpa_issue* issue) {
  tpa_config config;
  tpa_arena_size size;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = MOST_VERTICES;
  config.max_triangles = MOST_TRIANGLES;
  if (tpa_arena_query(&config, &size, issue) != TPA_OK) return fail(issue);
  s->block = malloc(size.bytes);
  if (s->block == NULL) return 0;
  return tpa_init(s->block, size.bytes, &config, &s->context, issue) == TPA_OK || fail(issue);
}

int surface_start(Surface* s, const World* world, Gpu* gpu) {
  tpa_issue issue = {.status = TPA_OK};
  memset(s, 0, sizeof *s);
  if (!take_memory(s) || !make_context(s, &issue)) return 0;
  for (uint32_t h = 0; h < world->blobs; ++h)
    if (!add_ball(s, world, h, &issue)) return 0;
  return show(s, world, gpu, &issue);
}

void surface_end(Surface* s) {
  free(s->packed);
  free(s->movers);
  free(s->corners);
  free(s->targets);
  free(s->owners_before);
  free(s->owners);
  free(s->before);
  free(s->attributes);
  free(s->block);
}
