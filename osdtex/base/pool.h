/* pool.h -- a fixed set of threads that share the indices of a loop.
 *
 * Indices are handed out one by one, so the order of execution is not fixed:
 * a loop body may write only to what belongs to its index. Sums over indices
 * are made afterwards, in index order. With that rule results do not depend on
 * the number of threads. */
#ifndef OTX_BASE_POOL_H
#define OTX_BASE_POOL_H

#include "base/arena.h"

typedef struct otx_pool otx_pool;

/* One thread of the pool. After every index its scratch arena is as it was
 * before. */
typedef struct otx_worker
{
    otx_pool *pool; /* NULL: a thread by itself */
    int32_t index;  /* [0, otx_pool_threads) */
    otx_arena *scratch;
} otx_worker;

typedef otx_status (*otx_pool_body)(
    void *context, int64_t index, otx_worker *worker);

/* `threads` of 0 means the cores of the machine. The calling thread is one of
 * them, so 1 starts none. NULL when memory or threads are out. */
otx_pool *otx_pool_create(otx_allocator *allocator, int32_t threads);
void otx_pool_destroy(otx_pool *pool);
int32_t otx_pool_threads(const otx_pool *pool);

/* Has `fn` asked, at most every `seconds`, whether to go on: by the thread that
 * made the pool, between the indices of its loops, while it waits for others,
 * and at every otx_pool_look. Once it says no, loops run no further indices and
 * return CANCELLED until a watch is set again. NULL: nobody is asked. */
typedef bool (*otx_pool_watch_fn)(void *user);
void otx_pool_watch(
    otx_pool *pool, otx_pool_watch_fn fn, void *user, double seconds);

/* Asks, if it is time. For loops of the thread that made the pool; costs a look
 * at the clock. CANCELLED once it was said. */
otx_status otx_pool_look(otx_pool *pool);

/* Whether it was said. Any thread; for bodies that run for long, by worker. */
bool otx_pool_is_stopped(const otx_pool *pool);
bool otx_worker_is_stopped(const otx_worker *worker);

/* otx_pool_look from within a body: the owner asks, the others are told. NULL:
 * goes on. */
otx_status otx_worker_look(const otx_worker *worker);

/* Runs body(context, i, worker) for every i in [0, count). Waits for all.
 * Returns the failure of the lowest failing index. A body must not call it. */
otx_status
otx_pool_for(otx_pool *pool, int64_t count, otx_pool_body body, void *context);

/* The same from within a body, with the worker that it was given: threads that
 * have run out of other indices help. For bodies that are few and long. */
otx_status otx_pool_share(
    otx_worker *worker, int64_t count, otx_pool_body body, void *context);

/* Which indices must have run before others: of index i the ones in
 * before[first[i]] to before[first[i + 1]], all below i. */
typedef struct otx_pool_order
{
    const int64_t *first;
    const int32_t *before;
} otx_pool_order;

/* otx_pool_for of the indices [first, end) in an order; those below `first`
 * have run. MEMORY besides. */
otx_status otx_pool_for_ordered(
    otx_pool *pool, const otx_pool_order *order, int64_t first, int64_t end,
    otx_pool_body body, void *context);

#endif
