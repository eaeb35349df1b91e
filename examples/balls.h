/* SPDX-License-Identifier: MIT */
/* Shared by the small programs: balls to work on, a context in its own block, and a line for errors.
 * C99 on the public header alone. */
#ifndef TOPOADAPT_EXAMPLES_BALLS_H
#define TOPOADAPT_EXAMPLES_BALLS_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <topoadapt.h>

#define RINGS 12
#define SECTORS 24
#define BALL_VERTICES (RINGS * SECTORS + 2)
#define BALL_TRIANGLES (2 * RINGS * SECTORS)
#define MOST_BALLS 4

static double positions[MOST_BALLS * BALL_VERTICES][3];
static uint32_t triangles[MOST_BALLS * BALL_TRIANGLES][3];

/* Writes ball `number` with its centre at (x, y, 0): rings of vertices between two poles. */
static void make_ball(uint32_t number, double x, double y, double radius) {
  const double pi = 3.14159265358979323846;
  const uint32_t base = number * BALL_VERTICES, north = base + RINGS * SECTORS, south = north + 1;
  uint32_t(*out)[3] = triangles + (size_t)number * BALL_TRIANGLES;
  for (uint32_t r = 0; r < RINGS; ++r)
    for (uint32_t s = 0; s < SECTORS; ++s) {
      const double polar = pi * (r + 1) / (RINGS + 1), around = 2 * pi * s / SECTORS;
      double* p = positions[base + r * SECTORS + s];
      p[0] = x + radius * sin(polar) * cos(around);
      p[1] = y + radius * sin(polar) * sin(around);
      p[2] = radius * cos(polar);
    }
  positions[north][0] = positions[south][0] = x;
  positions[north][1] = positions[south][1] = y;
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

/* The first `count` balls, for tpa_load. */
static tpa_mesh_input balls(uint32_t count) {
  const tpa_mesh_input mesh = {.struct_size = sizeof mesh,
                               .vertex_count = count * BALL_VERTICES,
                               .triangle_count = count * BALL_TRIANGLES,
                               .position_type = TPA_FLOAT64,
                               .index_type = TPA_UINT32,
                               .positions = positions,
                               .triangles = triangles};
  return mesh;
}

/* A context in its own block. The caller frees *block, also after a failure (NULL). */
static tpa_context* make_context(const tpa_config* config, void** block, tpa_issue* issue) {
  tpa_arena_size size;
  tpa_context* context = NULL;
  *block = NULL;
  if (tpa_arena_query(config, &size, issue) != TPA_OK) return NULL;
  *block = malloc(size.bytes);
  if (*block == NULL) return NULL;
  return tpa_init(*block, size.bytes, config, &context, issue) == TPA_OK ? context : NULL;
}

static int fail(const tpa_issue* issue) {
  char line[200];
  tpa_issue_text(issue, line, sizeof line);
  fprintf(stderr, "%s\n", line);
  return 1;
}

#endif
