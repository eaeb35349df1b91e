/* SPDX-License-Identifier: MIT */
/* Two spheres move into each other until they are one; prints a digest of the mesh after each step. Nothing but the
 * public header and IEEE arithmetic, in static memory: the same lines on every platform. */
#include <stdio.h>
#include <string.h>

#include "topoadapt.h"

double sqrt(double);

#define PARTS 8 /* of each edge of an octahedron */
#define VERTICES (4 * PARTS * PARTS + 2)
#define TRIANGLES (8 * PARTS * PARTS)

static double positions[2 * VERTICES][3];
static uint32_t triangles[2 * TRIANGLES][3];
static double targets[8 * VERTICES][3];
static uint64_t block[1 << 18];

static uint32_t vertex_count, triangle_count;

/* The vertex at a point of the octahedron |x| + |y| + |z| = PARTS, made when it is met for the first time. */
static uint32_t vertex_at(uint32_t first, double centre, const int* p) {
  double d[3], length = 0;
  uint32_t v;
  int i;
  for (i = 0; i < 3; ++i) length += (double)p[i] * p[i];
  length = sqrt(length);
  for (i = 0; i < 3; ++i) d[i] = p[i] / length + (i == 0 ? centre : 0);
  for (v = first; v < vertex_count; ++v)
    if (memcmp(positions[v], d, sizeof d) == 0) return v;
  memcpy(positions[vertex_count], d, sizeof d);
  return vertex_count++;
}

static void add_triangle(uint32_t first, double centre, const int* a, const int* b, const int* c, int swap) {
  uint32_t* t = triangles[triangle_count++];
  t[0] = vertex_at(first, centre, a);
  t[1] = vertex_at(first, centre, swap ? c : b);
  t[2] = vertex_at(first, centre, swap ? b : c);
}

static void add_sphere(double centre) {
  const uint32_t first = vertex_count;
  int octant, i, j, k;
  for (octant = 0; octant < 8; ++octant) {
    const int s[3] = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
    const int swap = s[0] * s[1] * s[2] < 0;
    for (i = 0; i < PARTS; ++i)
      for (j = 0; i + j < PARTS; ++j) {
        int at[4][3];
        for (k = 0; k < 4; ++k) {
          const int x = i + (k == 1 || k == 3), y = j + (k == 2 || k == 3);
          at[k][0] = s[0] * x, at[k][1] = s[1] * y, at[k][2] = s[2] * (PARTS - x - y);
        }
        add_triangle(first, centre, at[0], at[1], at[2], swap);
        if (i + j + 1 < PARTS) add_triangle(first, centre, at[1], at[3], at[2], swap);
      }
  }
}

/* FNV-1a. */
static uint64_t digest(uint64_t hash, const void* data, size_t bytes) {
  const unsigned char* p = data;
  while (bytes-- > 0) hash = (hash ^ *p++) * UINT64_C(0x100000001b3);
  return hash;
}

static int fail(const char* what, tpa_status status) {
  printf("%s: %s\n", what, tpa_status_string(status));
  return 1;
}

int main(void) {
  tpa_config config;
  tpa_context* context = NULL;
  tpa_mesh_input mesh = {0};
  tpa_status status;
  int step;
  add_sphere(-1.1);
  add_sphere(1.1);
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 3 * VERTICES;
  if ((status = tpa_init(block, sizeof block, &config, &context, NULL)) != TPA_OK) return fail("init", status);
  mesh.struct_size = sizeof mesh;
  mesh.vertex_count = vertex_count;
  mesh.triangle_count = triangle_count;
  mesh.position_type = TPA_FLOAT64;
  mesh.index_type = TPA_UINT32;
  mesh.positions = positions;
  mesh.triangles = triangles;
  if ((status = tpa_load(context, &mesh, NULL)) != TPA_OK) return fail("load", status);
  for (step = 1; step <= 8; ++step) {
    tpa_mesh_view view = {0};
    tpa_move_input move = {0};
    tpa_report report = {0};
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    uint32_t v;
    view.struct_size = sizeof view;
    tpa_view(context, &view);
    for (v = 0; v < view.vertex_count; ++v) {
      memcpy(targets[v], view.positions + 3 * v, sizeof targets[v]);
      targets[v][0] += targets[v][0] < 0 ? 0.05 : -0.05;
    }
    move.struct_size = sizeof move;
    move.count = view.vertex_count;
    move.position_type = TPA_FLOAT64;
    move.positions = targets;
    report.struct_size = sizeof report;
    if ((status = tpa_move(context, &move, NULL)) != TPA_OK) return fail("move", status);
    if ((status = tpa_step(context, NULL, &report, NULL)) != TPA_OK) return fail("step", status);
    tpa_view(context, &view);
    hash = digest(hash, view.positions, 3 * sizeof(double) * view.vertex_count);
    hash = digest(hash, view.triangles, 3 * sizeof(uint32_t) * view.triangle_count);
    printf("step %d: %u contacts, %u handles, %u vertices, %08lx%08lx\n", step, (unsigned)report.contacts,
           (unsigned)report.handles[0], (unsigned)report.vertices, (unsigned long)(hash >> 32),
           (unsigned long)(hash & 0xFFFFFFFFu));
  }
  return 0;
}
