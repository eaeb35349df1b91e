/* A scheduler for tpa_exec: POSIX threads, each with its share of the tasks, the same indices in each round: tasks with
 * indices near each other work on memory near each other, and what a thread wrote in one round lies in its cache in
 * the next. Who has finished takes from others. Any scheduler that calls each index once serves as well; the results
 * have the same bits. */
#ifndef TOPOADAPT_EXAMPLES_POOL_H
#define TOPOADAPT_EXAMPLES_POOL_H

#include "topoadapt.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Pool Pool;

/* `workers` threads, at least 1, the calling one included. NULL where there is no memory, or no thread to be had. */
Pool* pool_start(int workers);
/* The pool as the library wants it, until pool_stop(). For one calling thread at a time. */
tpa_exec pool_exec(Pool* pool);
/* Ends the threads and frees the pool. */
void pool_stop(Pool* pool);

#ifdef __cplusplus
}
#endif

#endif
