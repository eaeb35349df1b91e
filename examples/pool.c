/* SPDX-License-Identifier: MIT */
#include "pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

typedef void (*Task)(void* data, uint32_t index);

/* The remaining tasks of a worker, from the first to before the last, in a single word: the worker takes from the
 * front, others from the back. Each share has its own cache line. */
typedef struct {
  _Alignas(64) atomic_ullong left; /* first + 2^32 last */
} Share;

typedef struct {
  Pool* pool;
  pthread_t thread;
  int index;
} Worker;

struct Pool {
  Worker* threads;
  Share* shares; /* of the calling thread, then of each worker */
  int workers;   /* besides the calling thread */
  pthread_mutex_t mutex;
  pthread_cond_t begin, end;
  atomic_uint begun, ended; /* rounds, which are calls of parallel_for, and pool_stop() */
  atomic_int busy;          /* workers that have not finished this round */
  int stop;
  Task task;
  void* data;
};

/* The next tasks of a detection come soon, and waking a thread takes longer, most of all on a virtual machine. So a
 * waiting thread first looks this often, for about a quarter of a millisecond. */
enum { LOOKS = 1 << 20 };

/* Waits for another number. Changes of the number signal with the mutex held. */
static void wait_while(Pool* pool, atomic_uint* number, unsigned is, pthread_cond_t* changed) {
  int looks;
  for (looks = 0; looks < LOOKS; ++looks)
    if (atomic_load(number) != is) return;
  pthread_mutex_lock(&pool->mutex);
  while (atomic_load(number) == is) pthread_cond_wait(changed, &pool->mutex);
  pthread_mutex_unlock(&pool->mutex);
}

static void count_on(Pool* pool, atomic_uint* number, pthread_cond_t* changed) {
  pthread_mutex_lock(&pool->mutex);
  atomic_fetch_add(number, 1);
  pthread_cond_broadcast(changed);
  pthread_mutex_unlock(&pool->mutex);
}

/* Calls the first or last task of the share, if any is left, and says so. */
static int take_task(Pool* pool, Share* share, int front) {
  unsigned long long left = atomic_load(&share->left), rest;
  uint32_t first, last;
  do {
    first = (uint32_t)left;
    last = (uint32_t)(left >> 32);
    if (first == last) return 0;
    rest = front ? left + 1 : left - (1ULL << 32);
  } while (!atomic_compare_exchange_weak(&share->left, &left, rest));
  pool->task(pool->data, front ? first : last - 1);
  return 1;
}

/* The worker's own tasks first, then the rest of the others. */
static void take_tasks(Pool* pool, int worker) {
  const int all = pool->workers + 1;
  int i;
  while (take_task(pool, &pool->shares[worker], 1)) continue;
  for (i = 1; i < all; ++i)
    while (take_task(pool, &pool->shares[(worker + i) % all], 0)) continue;
}

static void* work(void* p) {
  Worker* worker = p;
  Pool* pool = worker->pool;
  unsigned seen;
  for (seen = 0;; ++seen) {
    wait_while(pool, &pool->begun, seen, &pool->begin);
    if (pool->stop) return NULL;
    take_tasks(pool, worker->index);
    if (atomic_fetch_sub(&pool->busy, 1) == 1) count_on(pool, &pool->ended, &pool->end);
  }
}

static void parallel_for(void* user, uint32_t count, Task task, void* data) {
  Pool* pool = user;
  const unsigned round = atomic_load(&pool->ended);
  const int all = pool->workers + 1;
  int i;
  pool->task = task;
  pool->data = data;
  for (i = 0; i < all; ++i) {
    const unsigned long long first = (unsigned long long)count * (unsigned)i / (unsigned)all;
    const unsigned long long last = (unsigned long long)count * (unsigned)(i + 1) / (unsigned)all;
    atomic_store(&pool->shares[i].left, first | last << 32);
  }
  atomic_store(&pool->busy, pool->workers);
  count_on(pool, &pool->begun, &pool->begin);
  take_tasks(pool, 0);
  if (pool->workers > 0) wait_while(pool, &pool->ended, round, &pool->end);
}

static int start_worker(Pool* pool) {
  Worker* worker = &pool->threads[pool->workers];
  worker->pool = pool;
  worker->index = pool->workers + 1;
  return pthread_create(&worker->thread, NULL, work, worker) == 0;
}

Pool* pool_start(int workers) {
  Pool* pool = workers < 1 ? NULL : calloc(1, sizeof *pool);
  if (pool == NULL) return NULL;
  pthread_mutex_init(&pool->mutex, NULL);
  pthread_cond_init(&pool->begin, NULL);
  pthread_cond_init(&pool->end, NULL);
  pool->threads = calloc((size_t)workers, sizeof *pool->threads);
  pool->shares = aligned_alloc(64, sizeof(Share) * (size_t)workers);
  if (pool->threads != NULL && pool->shares != NULL) {
    int i;
    for (i = 0; i < workers; ++i) atomic_init(&pool->shares[i].left, 0);
    while (pool->workers < workers - 1 && start_worker(pool)) ++pool->workers;
    if (pool->workers == workers - 1) return pool;
  }
  pool_stop(pool);
  return NULL;
}

tpa_exec pool_exec(Pool* pool) {
  tpa_exec exec = {0};
  exec.struct_size = sizeof exec;
  exec.user = pool;
  exec.parallel_for = parallel_for;
  return exec;
}

void pool_stop(Pool* pool) {
  int i;
  pool->stop = 1;
  count_on(pool, &pool->begun, &pool->begin);
  for (i = 0; i < pool->workers; ++i) pthread_join(pool->threads[i].thread, NULL);
  pthread_cond_destroy(&pool->begin);
  pthread_cond_destroy(&pool->end);
  pthread_mutex_destroy(&pool->mutex);
  free(pool->shares);
  free(pool->threads);
  free(pool);
}
