/* SPDX-License-Identifier: MIT */
/* Complete detection on one thread, and on several of a scheduler (pool.c): the same pairs, sooner.
 *
 *     threads [WORKERS]      default 2, the calling thread included
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "pool.h"

/* Two tori of `n` by `n` vertices, the second through the first. Points on a circle come by repeated rotation: no
 * trigonometry needed for an example. */
static void make_mesh(uint32_t n, double* positions, uint32_t* triangles) {
  const double turn_s = 6.283185307179586 / n, turn_c = 1 - turn_s * turn_s / 2;
  for (uint32_t t = 0; t < 2; ++t) {
    double a[2] = {1, 0};
    for (uint32_t i = 0; i < n; ++i) {
      double b[2] = {1, 0};
      for (uint32_t j = 0; j < n; ++j) {
        const double r = 3 + b[0], x = r * a[0], y = r * a[1], next = b[0] * turn_c - b[1] * turn_s;
        const double p[3] = {t == 0 ? x : x + 1.5, t == 0 ? y : b[1], t == 0 ? b[1] : -y};
        const uint32_t base = t * n * n, i1 = (i + 1) % n, j1 = (j + 1) % n, here = base + i * n + j;
        const uint32_t across = base + i1 * n + j1;
        const uint32_t corners[6] = {here, base + i1 * n + j, across, here, across, base + i * n + j1};
        memcpy(positions + 3 * here, p, sizeof p);
        memcpy(triangles + 6 * here, corners, sizeof corners);
        b[1] = b[1] * turn_c + b[0] * turn_s;
        b[0] = next;
      }
      const double next = a[0] * turn_c - a[1] * turn_s;
      a[1] = a[1] * turn_c + a[0] * turn_s;
      a[0] = next;
    }
  }
}

static double seconds_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Loads the mesh anew and detects. Returns the best of five times, or a negative number. */
static double measure(tpa_context* context, const tpa_mesh_input* mesh, const tpa_exec* exec, tpa_contacts* contacts) {
  double best = 1e30;
  int i;
  for (i = 0; i < 5; ++i) {
    double start, taken;
    if (tpa_load(context, mesh, NULL) != TPA_OK) return -1;
    start = seconds_now();
    if (tpa_detect(context, exec, contacts, NULL) != TPA_OK) return -1;
    taken = seconds_now() - start;
    if (taken < best) best = taken;
  }
  return best;
}

int main(int argc, char** argv) {
  const uint32_t n = 290; /* 168 200 vertices */
  const int asked = argc > 1 ? atoi(argv[1]) : 2, workers = asked < 1 || asked > 64 ? 2 : asked;
  tpa_config config;
  tpa_arena_size size;
  tpa_context* context = NULL;
  tpa_contacts one = {.struct_size = sizeof one}, many = one;
  double* positions = malloc(6 * n * n * sizeof *positions);
  uint32_t* triangles = malloc(12 * n * n * sizeof *triangles);
  const tpa_mesh_input mesh = {sizeof mesh, 2 * n * n, 4 * n * n, TPA_FLOAT64, TPA_UINT32, 0, 0, positions, triangles};
  make_mesh(n, positions, triangles);
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 2 * n * n;
  tpa_arena_query(&config, &size, NULL);
  void* block = malloc(size.bytes);
  if (tpa_init(block, size.bytes, &config, &context, NULL) != TPA_OK) return 2;

  const double alone = measure(context, &mesh, NULL, &one);
  if (alone < 0) return 2;
  tpa_contact* first = malloc((one.count + 1) * sizeof *first);
  memcpy(first, one.pairs, one.count * sizeof *first); /* the next call overwrites them */
  Pool* pool = pool_start(workers);
  if (pool == NULL) return 2;
  const tpa_exec exec = pool_exec(pool);
  const double together = measure(context, &mesh, &exec, &many);
  pool_stop(pool);
  const int same =
      together >= 0 && many.count == one.count && memcmp(first, many.pairs, one.count * sizeof *first) == 0;
  printf("%u pairs; one thread %.1f ms, %d threads %.1f ms: %.2f times as fast, %s\n", one.count, 1e3 * alone, workers,
         1e3 * together, alone / together, same ? "same pairs" : "OTHER PAIRS");
  free(first);
  free(block);
  free(triangles);
  free(positions);
  return same ? 0 : 1;
}
