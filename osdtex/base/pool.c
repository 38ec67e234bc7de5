/* pool.c -- POSIX threads, one condition to start a loop and one to end it. */
#include "base/pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <unistd.h>

enum
{
    MAX_THREADS = 256
};

typedef struct thread
{
    otx_pool *pool;
    otx_worker worker;
    pthread_t handle;
} thread;

struct otx_pool
{
    otx_heap *heap;
    int32_t thread_count;
    int32_t started; /* threads other than the caller */
    thread threads[MAX_THREADS];

    pthread_mutex_t mutex;
    pthread_cond_t work;
    pthread_cond_t done;
    uint64_t generation; /* of the current loop */
    bool open;           /* a thread that wakes may still join it */
    int32_t busy;        /* threads that did, the caller left out */
    bool quit;

    otx_pool_body body;
    void *context;
    int64_t count;
    _Atomic int64_t next;
    int64_t failed_index;
    otx_status failure;
};

static void
record_failure(otx_pool *pool, int64_t index, otx_status status)
{
    pthread_mutex_lock(&pool->mutex);
    if (index < pool->failed_index)
    {
        pool->failed_index = index;
        pool->failure = status;
    }
    pthread_mutex_unlock(&pool->mutex);
}

/* Takes indices until none is left. All run even after a failure below would
 * have stopped a sequential loop: the lowest failure must be found whatever
 * the order, and failures are rare. */
static void
take_indices(otx_pool *pool, otx_worker *worker)
{
    int64_t index;

    while ((index = atomic_fetch_add(&pool->next, 1)) < pool->count)
    {
        const otx_arena_mark mark = otx_arena_here(worker->scratch);
        const otx_status status = pool->body(pool->context, index, worker);

        otx_arena_release(worker->scratch, mark);
        if (status != OSDTEX_OK)
            record_failure(pool, index, status);
    }
}

static void *
thread_main(void *argument)
{
    thread *self = argument;
    otx_pool *pool = self->pool;
    uint64_t seen = 0;

    pthread_mutex_lock(&pool->mutex);
    for (;;)
    {
        while (!pool->quit && pool->generation == seen)
            pthread_cond_wait(&pool->work, &pool->mutex);
        if (pool->quit)
            break;
        seen = pool->generation;
        if (!pool->open)
            continue;
        ++pool->busy;
        pthread_mutex_unlock(&pool->mutex);
        take_indices(pool, &self->worker);
        pthread_mutex_lock(&pool->mutex);
        if (--pool->busy == 0)
            pthread_cond_signal(&pool->done);
    }
    pthread_mutex_unlock(&pool->mutex);
    return NULL;
}

static bool
start_threads(otx_pool *pool)
{
    for (int32_t i = 0; i < pool->thread_count; ++i)
    {
        thread *t = &pool->threads[i];

        t->pool = pool;
        t->worker.index = i;
        t->worker.scratch = otx_arena_create(pool->heap);
        if (!t->worker.scratch)
            return false;
        if (i == 0)
            continue;
        if (pthread_create(&t->handle, NULL, thread_main, t) != 0)
            return false;
        ++pool->started;
    }
    return true;
}

otx_pool *
otx_pool_create(otx_heap *heap, int32_t threads)
{
    otx_pool *pool = otx_heap_alloc(heap, sizeof *pool);

    if (!pool)
        return NULL;
    if (threads <= 0)
        threads = (int32_t)sysconf(_SC_NPROCESSORS_ONLN);
    if (threads < 1)
        threads = 1;
    if (threads > MAX_THREADS)
        threads = MAX_THREADS;
    memset(pool, 0, sizeof *pool);
    pool->heap = heap;
    pool->thread_count = threads;
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->work, NULL);
    pthread_cond_init(&pool->done, NULL);
    if (!start_threads(pool))
    {
        otx_pool_destroy(pool);
        return NULL;
    }
    return pool;
}

void
otx_pool_destroy(otx_pool *pool)
{
    if (!pool)
        return;
    pthread_mutex_lock(&pool->mutex);
    pool->quit = true;
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->mutex);
    for (int32_t i = 1; i <= pool->started; ++i)
        pthread_join(pool->threads[i].handle, NULL);
    for (int32_t i = 0; i < pool->thread_count; ++i)
        otx_arena_destroy(pool->threads[i].worker.scratch);
    pthread_cond_destroy(&pool->done);
    pthread_cond_destroy(&pool->work);
    pthread_mutex_destroy(&pool->mutex);
    otx_heap_free(pool->heap, pool, sizeof *pool);
}

int32_t
otx_pool_threads(const otx_pool *pool)
{
    return pool->thread_count;
}

otx_status
otx_pool_for(otx_pool *pool, int64_t count, otx_pool_body body, void *context)
{
    pthread_mutex_lock(&pool->mutex);
    pool->body = body;
    pool->context = context;
    pool->count = count;
    atomic_store(&pool->next, 0);
    pool->failed_index = INT64_MAX;
    pool->failure = OSDTEX_OK;
    pool->open = count > 1;
    ++pool->generation;
    if (pool->open)
        pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->mutex);

    take_indices(pool, &pool->threads[0].worker);

    /* All indices are taken. A thread that has not woken by now, because it is
     * a short loop or a busy machine, is not waited for. */
    pthread_mutex_lock(&pool->mutex);
    pool->open = false;
    while (pool->busy > 0)
        pthread_cond_wait(&pool->done, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
    return pool->failure;
}
