/* Two balls move towards each other, step by step, until they are one; prints one line for each step.
 * C99 on the public header alone. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <topoadapt.h>

#define RINGS 12
#define SECTORS 24
#define BALL_VERTICES (RINGS * SECTORS + 2)
#define BALL_TRIANGLES (2 * RINGS * SECTORS)

static double positions[2 * BALL_VERTICES][3];
static uint32_t triangles[2 * BALL_TRIANGLES][3];

/* Writes ball `number` with its centre at (x, 0, 0): rings of vertices between two poles. */
static void make_ball(uint32_t number, double x, double radius) {
  const double pi = 3.14159265358979323846;
  const uint32_t base = number * BALL_VERTICES, north = base + RINGS * SECTORS, south = north + 1;
  uint32_t(*out)[3] = triangles + (size_t)number * BALL_TRIANGLES;
  for (uint32_t r = 0; r < RINGS; ++r)
    for (uint32_t s = 0; s < SECTORS; ++s) {
      const double polar = pi * (r + 1) / (RINGS + 1), around = 2 * pi * s / SECTORS;
      double* p = positions[base + r * SECTORS + s];
      p[0] = x + radius * sin(polar) * cos(around);
      p[1] = radius * sin(polar) * sin(around);
      p[2] = radius * cos(polar);
    }
  positions[north][0] = positions[south][0] = x;
  positions[north][2] = radius;
  positions[south][2] = -radius;
  for (uint32_t s = 0; s < SECTORS; ++s) {
    const uint32_t t = (s + 1) % SECTORS;
    const uint32_t top[3] = {north, base + s, base + t};
    const uint32_t bottom[3] = {south, base + (RINGS - 1) * SECTORS + t, base + (RINGS - 1) * SECTORS + s};
    for (int i = 0; i < 3; ++i) {
      out[0][i] = top[i];
      out[1][i] = bottom[i];
    }
    out += 2;
    for (uint32_t r = 0; r + 1 < RINGS; ++r) {
      const uint32_t upper = base + r * SECTORS, lower = upper + SECTORS;
      const uint32_t quad[6] = {upper + s, lower + s, lower + t, upper + s, lower + t, upper + t};
      for (int i = 0; i < 6; ++i) out[i / 3][i % 3] = quad[i];
      out += 2;
    }
  }
}

static int fail(const tpa_issue* issue) {
  char line[200];
  tpa_issue_text(issue, line, sizeof line);
  fprintf(stderr, "merge: %s\n", line);
  return 1;
}

/* A context in a block of its own; *block is what to free. */
static tpa_context* make_context(void** block, tpa_issue* issue) {
  tpa_config config;
  tpa_arena_size size;
  tpa_context* context = NULL;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 4 * BALL_VERTICES;
  if (tpa_arena_query(&config, &size, issue) != TPA_OK) return NULL;
  *block = malloc(size.bytes + size.alignment);
  if (*block == NULL) return NULL;
  char* start = (char*)*block + (size.alignment - (uintptr_t)*block % size.alignment) % size.alignment;
  return tpa_init(start, size.bytes, &config, &context, issue) == TPA_OK ? context : NULL;
}

/* Targets for all vertices: those of the left ball go right, the others left. */
static tpa_status approach(tpa_context* context, double distance, tpa_issue* issue) {
  static double targets[2 * BALL_VERTICES][3];
  tpa_mesh_view view = {.struct_size = sizeof view};
  tpa_move_input move = {.struct_size = sizeof move, .position_type = TPA_FLOAT64, .positions = targets};
  tpa_view(context, &view);
  move.count = view.vertex_count;
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    for (int i = 0; i < 3; ++i) targets[v][i] = view.positions[3 * v + (uint32_t)i];
    targets[v][0] += v < BALL_VERTICES ? distance : -distance;
  }
  return tpa_move(context, &move, issue);
}

int main(void) {
  tpa_issue issue = {.status = TPA_OK};
  void* block = NULL;
  tpa_context* context = make_context(&block, &issue);
  if (context == NULL) return fail(&issue);
  make_ball(0, -3, 2);
  make_ball(1, 3, 2);
  const tpa_mesh_input mesh = {.struct_size = sizeof mesh,
                               .vertex_count = 2 * BALL_VERTICES,
                               .triangle_count = 2 * BALL_TRIANGLES,
                               .position_type = TPA_FLOAT64,
                               .index_type = TPA_UINT32,
                               .positions = positions,
                               .triangles = triangles};
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return fail(&issue);

  tpa_validation now = {.struct_size = sizeof now};
  for (int step = 1; step <= 20 && now.components != 1; ++step) {
    tpa_report report = {.struct_size = sizeof report};
    if (approach(context, 0.15, &issue) != TPA_OK || tpa_step(context, NULL, &report, &issue) != TPA_OK ||
        tpa_validate(context, NULL, &now, &issue) != TPA_OK)
      return fail(&issue);
    printf("step %2d: %3u contacts, %u components, genus %d, %u vertices, volume %.3f\n", step,
           (unsigned)report.contacts, (unsigned)now.components, (int)now.genus, (unsigned)report.vertices, now.volume);
  }
  free(block);
  return now.components == 1 && now.genus == 0 && now.self_intersections == 0 ? 0 : 1;
}
