/* SPDX-License-Identifier: MIT */
/* A scheduler for tpa_exec: POSIX threads. Each thread has a share of the tasks, the same indices in each round, since
 * neighbouring indices work on neighbouring memory, still in the thread's cache from the last round. A thread without
 * tasks takes some from others. Any scheduler that calls each index once serves as well, with the same bits. */
#ifndef TOPOADAPT_EXAMPLES_POOL_H
#define TOPOADAPT_EXAMPLES_POOL_H

#include "topoadapt.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Pool Pool;

/* `workers` threads, at least 1, the calling one included. NULL without memory or threads. */
Pool* pool_start(int workers);
/* The pool in the library's form, valid until pool_stop(). A single thread calls at a time. */
tpa_exec pool_exec(Pool* pool);
/* Ends the threads and frees the pool. */
void pool_stop(Pool* pool);

#ifdef __cplusplus
}
#endif

#endif
