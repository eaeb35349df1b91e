#include "pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

typedef void (*Task)(void* data, uint32_t index);

struct Pool {
  pthread_t* threads;
  int workers; /* besides the calling thread */
  pthread_mutex_t mutex;
  pthread_cond_t begin, end;
  atomic_uint begun, ended; /* rounds, which are calls of parallel_for, and pool_stop() */
  atomic_int busy;          /* workers that have not finished this round */
  int stop;
  Task task;
  void* data;
  uint32_t count;
  atomic_uint next;
};

/* A detection comes back with the next tasks soon, and to wake a thread that sleeps takes longer than that, on a virtual
 * machine most of all. So whoever waits looks so often first, which takes a quarter of a millisecond or so. */
enum { LOOKS = 1 << 20 };

/* Until the number is another one. Whoever changes it signals with the mutex held. */
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

static void take_tasks(Pool* pool) {
  for (;;) {
    const uint32_t i = atomic_fetch_add_explicit(&pool->next, 1, memory_order_relaxed);
    if (i >= pool->count) return;
    pool->task(pool->data, i);
  }
}

static void* work(void* p) {
  Pool* pool = p;
  unsigned seen;
  for (seen = 0;; ++seen) {
    wait_while(pool, &pool->begun, seen, &pool->begin);
    if (pool->stop) return NULL;
    take_tasks(pool);
    if (atomic_fetch_sub(&pool->busy, 1) == 1) count_on(pool, &pool->ended, &pool->end);
  }
}

static void parallel_for(void* user, uint32_t count, Task task, void* data) {
  Pool* pool = user;
  const unsigned round = atomic_load(&pool->ended);
  pool->task = task;
  pool->data = data;
  pool->count = count;
  atomic_store(&pool->next, 0);
  atomic_store(&pool->busy, pool->workers);
  count_on(pool, &pool->begun, &pool->begin);
  take_tasks(pool);
  if (pool->workers > 0) wait_while(pool, &pool->ended, round, &pool->end);
}

Pool* pool_start(int workers) {
  Pool* pool = workers < 1 ? NULL : calloc(1, sizeof *pool);
  if (pool == NULL) return NULL;
  pthread_mutex_init(&pool->mutex, NULL);
  pthread_cond_init(&pool->begin, NULL);
  pthread_cond_init(&pool->end, NULL);
  pool->threads = calloc((size_t)workers, sizeof *pool->threads);
  while (pool->threads != NULL && pool->workers < workers - 1 &&
         pthread_create(&pool->threads[pool->workers], NULL, work, pool) == 0)
    ++pool->workers;
  if (pool->threads != NULL && pool->workers == workers - 1) return pool;
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
  for (i = 0; i < pool->workers; ++i) pthread_join(pool->threads[i], NULL);
  pthread_cond_destroy(&pool->begin);
  pthread_cond_destroy(&pool->end);
  pthread_mutex_destroy(&pool->mutex);
  free(pool->threads);
  free(pool);
}
