/* SPDX-License-Identifier: MIT */
/* Threads of a module with shared memory: tpa_exec.parallel_for over workers that wait in web_worker. A thread that may
 * not sleep, as that of a page, turns in a loop until the last task has ended. */
#include <stdint.h>
#include <topoadapt.h>

#define EXPORT __attribute__((visibility("default")))

typedef void (*Task)(void* data, uint32_t index);

/* What the present round calls. Written between rounds only: a round ends with its last task. */
static Task task;
static void* task_data;
static uint32_t task_count;

static uint64_t next;  /* round * 2^32 + the next task. A thread that takes a task has seen task_... of that round */
static uint32_t ended; /* tasks of the round that have returned */
static uint32_t calls; /* rounds so far, on which workers sleep */
static uint32_t workers;

/* Takes tasks until none is left. */
static void work(void) {
  uint64_t at = __atomic_load_n(&next, __ATOMIC_SEQ_CST);
  for (;;) {
    const uint32_t index = (uint32_t)at;
    const Task call = __atomic_load_n(&task, __ATOMIC_SEQ_CST);
    void* const data = __atomic_load_n(&task_data, __ATOMIC_SEQ_CST);
    if (index >= __atomic_load_n(&task_count, __ATOMIC_SEQ_CST)) return;
    /* Fails where another thread was quicker, or the round is over. */
    if (!__atomic_compare_exchange_n(&next, &at, at + 1, 0, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST)) continue;
    call(data, index);
    __atomic_add_fetch(&ended, 1, __ATOMIC_SEQ_CST);
    at = __atomic_load_n(&next, __ATOMIC_SEQ_CST);
  }
}

static void parallel_for(void* user, uint32_t count, Task call, void* data) {
  (void)user;
  if (count == 0) return;
  /* No thread takes a task of the last round any more: its count is reached. */
  __atomic_store_n(&task, call, __ATOMIC_SEQ_CST);
  __atomic_store_n(&task_data, data, __ATOMIC_SEQ_CST);
  __atomic_store_n(&ended, 0, __ATOMIC_SEQ_CST);
  const uint64_t round = (__atomic_load_n(&next, __ATOMIC_SEQ_CST) >> 32) + 1;
  /* The place first: under the old count, a thread that has seen the new one would find a task. */
  __atomic_store_n(&next, round << 32 | UINT32_MAX, __ATOMIC_SEQ_CST);
  __atomic_store_n(&task_count, count, __ATOMIC_SEQ_CST);
  __atomic_store_n(&next, round << 32, __ATOMIC_SEQ_CST);
  __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST);
  __builtin_wasm_memory_atomic_notify((int*)&calls, UINT32_MAX);
  work();
  while (__atomic_load_n(&ended, __ATOMIC_SEQ_CST) != count) {
  }
}

/* tpa_exec.parallel_for, for the caller who fills a tpa_exec. */
EXPORT void* web_parallel_for(void) { return (void*)(uintptr_t)parallel_for; }

/* Workers that take part. */
EXPORT uint32_t web_workers(void) { return __atomic_load_n(&workers, __ATOMIC_SEQ_CST); }

/* Runs in a worker for as long as that lives. */
EXPORT void web_worker(void) {
  __atomic_add_fetch(&workers, 1, __ATOMIC_SEQ_CST);
  for (;;) {
    const uint32_t seen = __atomic_load_n(&calls, __ATOMIC_SEQ_CST);
    work();
    __builtin_wasm_memory_atomic_wait32((int*)&calls, (int)seen, -1);
  }
}
