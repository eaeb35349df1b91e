/* A scheduler for tpa_exec: a pool of POSIX threads that take task indices from a common counter. Any scheduler that
 * calls each index once serves as well; the results have the same bits.
 *
 *     threads [WORKERS]      default 2, the calling thread included
 */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "topoadapt.h"

/* ---------------------------------------------------------------- the pool */

#define MAX_WORKERS 64

typedef void (*Task)(void* data, uint32_t index);

typedef struct {
  pthread_t threads[MAX_WORKERS];
  int workers; /* besides the calling thread */
  pthread_mutex_t mutex;
  pthread_cond_t begin, end;
  unsigned round; /* counts calls of parallel_for */
  int busy;       /* workers that have not finished this round */
  int stop;
  Task task;
  void* data;
  uint32_t count;
  atomic_uint next;
} Pool;

static void take_tasks(Pool* pool) {
  for (;;) {
    const uint32_t i = atomic_fetch_add_explicit(&pool->next, 1, memory_order_relaxed);
    if (i >= pool->count) return;
    pool->task(pool->data, i);
  }
}

static void* work(void* p) {
  Pool* pool = p;
  unsigned seen = 0;
  pthread_mutex_lock(&pool->mutex);
  for (;;) {
    while (pool->round == seen && !pool->stop) pthread_cond_wait(&pool->begin, &pool->mutex);
    if (pool->stop) break;
    seen = pool->round;
    pthread_mutex_unlock(&pool->mutex);
    take_tasks(pool);
    pthread_mutex_lock(&pool->mutex);
    if (--pool->busy == 0) pthread_cond_signal(&pool->end);
  }
  pthread_mutex_unlock(&pool->mutex);
  return NULL;
}

static void parallel_for(void* user, uint32_t count, Task task, void* data) {
  Pool* pool = user;
  pthread_mutex_lock(&pool->mutex);
  pool->task = task;
  pool->data = data;
  pool->count = count;
  atomic_store(&pool->next, 0);
  pool->busy = pool->workers;
  ++pool->round;
  pthread_cond_broadcast(&pool->begin);
  pthread_mutex_unlock(&pool->mutex);
  take_tasks(pool);
  pthread_mutex_lock(&pool->mutex);
  while (pool->busy > 0) pthread_cond_wait(&pool->end, &pool->mutex);
  pthread_mutex_unlock(&pool->mutex);
}

static int start_pool(Pool* pool, int workers) {
  memset(pool, 0, sizeof *pool);
  pthread_mutex_init(&pool->mutex, NULL);
  pthread_cond_init(&pool->begin, NULL);
  pthread_cond_init(&pool->end, NULL);
  for (; pool->workers < workers; ++pool->workers)
    if (pthread_create(&pool->threads[pool->workers], NULL, work, pool) != 0) return 0;
  return 1;
}

static void stop_pool(Pool* pool) {
  int i;
  pthread_mutex_lock(&pool->mutex);
  pool->stop = 1;
  pthread_cond_broadcast(&pool->begin);
  pthread_mutex_unlock(&pool->mutex);
  for (i = 0; i < pool->workers; ++i) pthread_join(pool->threads[i], NULL);
}

/* ---------------------------------------------------------------- what it is used for */

/* Two tori of `n` by `n` vertices, the second through the first. */
static void make_mesh(uint32_t n, double* positions, uint32_t* triangles) {
  /* Points on a circle by repeated rotation: no trigonometry needed for an example. */
  const double turn_s = 6.283185307179586 / n, turn_c = 1 - turn_s * turn_s / 2;
  uint32_t t, i, j, k = 0;
  for (t = 0; t < 2; ++t) {
    double a[2] = {1, 0};
    for (i = 0; i < n; ++i) {
      double b[2] = {1, 0};
      for (j = 0; j < n; ++j) {
        double* p = positions + 3 * ((t * n + i) * n + j);
        const double r = 3 + b[0], x = r * a[0], y = r * a[1], next = b[0] * turn_c - b[1] * turn_s;
        p[0] = t == 0 ? x : x + 1.5;
        p[1] = t == 0 ? y : b[1];
        p[2] = t == 0 ? b[1] : -y;
        b[1] = b[1] * turn_c + b[0] * turn_s;
        b[0] = next;
      }
      {
        const double next = a[0] * turn_c - a[1] * turn_s;
        a[1] = a[1] * turn_c + a[0] * turn_s;
        a[0] = next;
      }
      for (j = 0; j < n; ++j) {
        const uint32_t base = t * n * n, i1 = (i + 1) % n, j1 = (j + 1) % n;
        const uint32_t p = base + i * n + j, q = base + i1 * n + j, r = base + i1 * n + j1, s = base + i * n + j1;
        const uint32_t corners[6] = {p, q, r, p, r, s};
        memcpy(triangles + k, corners, sizeof corners);
        k += 6;
      }
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
  int workers = argc > 1 ? atoi(argv[1]) : 2, same;
  tpa_config config;
  tpa_arena_size size;
  tpa_context* context = NULL;
  tpa_mesh_input mesh = {0};
  tpa_exec exec = {0};
  tpa_contacts one = {0}, many = {0};
  tpa_contact* first;
  double alone, together;
  Pool pool;
  double* positions = malloc(6 * n * n * sizeof *positions);
  uint32_t* triangles = malloc(12 * n * n * sizeof *triangles);
  void* block;
  if (workers < 1 || workers > MAX_WORKERS) workers = 2;
  make_mesh(n, positions, triangles);
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 2 * n * n;
  tpa_arena_query(&config, &size, NULL);
  block = aligned_alloc(size.alignment, (size.bytes + size.alignment - 1) / size.alignment * size.alignment);
  if (tpa_init(block, size.bytes, &config, &context, NULL) != TPA_OK) return 2;
  mesh.struct_size = sizeof mesh;
  mesh.vertex_count = 2 * n * n;
  mesh.triangle_count = 4 * n * n;
  mesh.position_type = TPA_FLOAT64;
  mesh.index_type = TPA_UINT32;
  mesh.positions = positions;
  mesh.triangles = triangles;
  one.struct_size = many.struct_size = sizeof one;
  exec.struct_size = sizeof exec;
  exec.user = &pool;
  exec.parallel_for = parallel_for;

  alone = measure(context, &mesh, NULL, &one);
  if (alone < 0) return 2;
  first = malloc((one.count + 1) * sizeof *first);
  memcpy(first, one.pairs, one.count * sizeof *first);
  if (!start_pool(&pool, workers - 1)) return 2;
  together = measure(context, &mesh, &exec, &many);
  stop_pool(&pool);
  same = together >= 0 && many.count == one.count && memcmp(first, many.pairs, one.count * sizeof *first) == 0;
  printf("%u pairs; one thread %.1f ms, %d threads %.1f ms: %.2f times as fast, %s\n", one.count, 1e3 * alone, workers,
         1e3 * together, alone / together, same ? "same pairs" : "OTHER PAIRS");
  free(first);
  free(block);
  free(triangles);
  free(positions);
  return same ? 0 : 1;
}
