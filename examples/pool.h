/* A scheduler for tpa_exec: POSIX threads that take the indices of tasks from a common counter. Any scheduler that calls
 * each index once serves as well; the results have the same bits. */
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
