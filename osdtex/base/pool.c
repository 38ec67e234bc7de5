/* pool.c -- POSIX threads that look for open loops.
 *
 * A loop lies on the stack of who runs it and is in a list, oldest first, while
 * others may join: those without anything to do take what was opened first,
 * which is the coarsest. Who waits for the end of a loop of the pool, or for
 * its turn in one, helps with loops that were opened inside. */
#include "base/pool.h"

#include "base/clock.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum
{
    MAX_THREADS = 256,
    /* Looks at a counter before a thread goes to sleep, some ten microseconds:
     * solvers open their next loop sooner than a sleeper wakes. */
    LOOKS = 4000,
    WAIT_NANOSECONDS = 50000000 /* between looks of an owner that waits */
};

typedef struct loop
{
    otx_pool_body body;
    void *context;
    int64_t end;
    _Atomic int64_t next;
    const otx_pool_order *order; /* NULL: any */
    uint8_t *done;               /* [end] of what has an order */
    bool inner;                  /* opened from within a body */
    _Atomic int32_t busy;        /* threads that joined */
    int64_t failed_index;
    otx_status failure;
    struct loop *newer;
} loop;

typedef struct thread
{
    otx_pool *pool;
    otx_worker worker;
    pthread_t handle;
} thread;

struct otx_pool
{
    otx_allocator *allocator;
    int32_t thread_count;
    int32_t started; /* threads other than the caller */
    thread threads[MAX_THREADS];

    pthread_mutex_t mutex;
    pthread_cond_t work;    /* a loop was opened */
    pthread_cond_t done;    /* something ended that others wait for */
    loop *open;             /* oldest first */
    _Atomic int64_t opened; /* loops so far */
    int32_t waiting;        /* for `done`, willing to help */
    bool quit;

    otx_pool_watch_fn watch; /* NULL none */
    void *watch_user;
    double watch_seconds, watched; /* between looks; the last one */
    _Atomic bool stopped;
};

/* -- stopping ------------------------------------------------------------- */

void
otx_pool_watch(otx_pool *pool, otx_pool_watch_fn fn, void *user, double seconds)
{
    pool->watch = fn;
    pool->watch_user = user;
    pool->watch_seconds = seconds;
    pool->watched = otx_clock_now();
    atomic_store(&pool->stopped, false);
}

otx_status
otx_pool_look(otx_pool *pool)
{
    if (pool->watch && !atomic_load(&pool->stopped))
    {
        const double t = otx_clock_now();

        if (t - pool->watched >= pool->watch_seconds)
        {
            pool->watched = t;
            if (!pool->watch(pool->watch_user))
                atomic_store(&pool->stopped, true);
        }
    }
    return atomic_load(&pool->stopped) ? OSDTEX_ERROR_CANCELLED : OSDTEX_OK;
}

bool
otx_pool_is_stopped(const otx_pool *pool)
{
    return atomic_load(&pool->stopped);
}

bool
otx_worker_is_stopped(const otx_worker *worker)
{
    return worker->pool && otx_pool_is_stopped(worker->pool);
}

/* Whether a thread is the one that made the pool. */
static bool
is_owner(const otx_worker *worker)
{
    return worker->pool && worker->index == 0;
}

otx_status
otx_worker_look(const otx_worker *worker)
{
    if (!worker)
        return OSDTEX_OK;
    if (is_owner(worker))
        return otx_pool_look(worker->pool);
    return otx_worker_is_stopped(worker) ? OSDTEX_ERROR_CANCELLED : OSDTEX_OK;
}

/* Waits for `done` a moment, so that the owner keeps asking. Under the lock,
 * let go while it asks. */
static void
wait_for_done(otx_pool *pool, const otx_worker *worker)
{
    struct timespec until;

    if (!pool->watch || !is_owner(worker))
    {
        pthread_cond_wait(&pool->done, &pool->mutex);
        return;
    }
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += WAIT_NANOSECONDS;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&pool->done, &pool->mutex, &until);
    pthread_mutex_unlock(&pool->mutex);
    otx_pool_look(pool);
    pthread_mutex_lock(&pool->mutex);
}

/* -- indices, under the lock or not as each says -------------------------- */

static void
record_failure(otx_pool *pool, loop *l, int64_t index, otx_status status)
{
    if (pool)
        pthread_mutex_lock(&pool->mutex);
    if (index < l->failed_index)
    {
        l->failed_index = index;
        l->failure = status;
    }
    if (pool)
        pthread_mutex_unlock(&pool->mutex);
}

/* A loop with indices left, NULL none. Under the lock. */
static loop *
find_open(const otx_pool *pool, bool inner)
{
    loop *l = pool->open;

    while (l && ((inner && !l->inner) || atomic_load(&l->next) >= l->end))
        l = l->newer;
    return l;
}

static void take_indices(loop *l, otx_worker *worker);

/* Joins a loop until nothing is left of it. Under the lock, let go meanwhile.
 */
static void
join(otx_pool *pool, loop *l, otx_worker *worker)
{
    ++l->busy;
    pthread_mutex_unlock(&pool->mutex);
    take_indices(l, worker);
    pthread_mutex_lock(&pool->mutex);
    if (--l->busy == 0)
        pthread_cond_broadcast(&pool->done);
}

/* Helps with an inner loop, or waits until something ends or opens. Under the
 * lock. */
static void
help_or_wait(otx_pool *pool, otx_worker *worker)
{
    loop *l = find_open(pool, true);

    if (l)
    {
        join(pool, l, worker);
        return;
    }
    ++pool->waiting;
    wait_for_done(pool, worker);
    --pool->waiting;
}

static bool
is_turn(const loop *l, int64_t index)
{
    const otx_pool_order *o = l->order;

    for (int64_t i = o->first[index]; i < o->first[index + 1]; ++i)
        if (!l->done[o->before[i]])
            return false;
    return true;
}

/* What comes before has a lower index, so it was taken before. */
static void
wait_for_turn(loop *l, int64_t index, otx_worker *worker)
{
    otx_pool *pool = worker->pool;

    pthread_mutex_lock(&pool->mutex);
    while (!is_turn(l, index))
        help_or_wait(pool, worker);
    pthread_mutex_unlock(&pool->mutex);
}

static void
mark_done(loop *l, int64_t index, otx_pool *pool)
{
    pthread_mutex_lock(&pool->mutex);
    l->done[index] = 1;
    pthread_cond_broadcast(&pool->done);
    pthread_mutex_unlock(&pool->mutex);
}

/* Takes indices until none is left. All run even after a failure below would
 * have stopped a sequential loop: the lowest failure must be found whatever
 * the order, and failures are rare. */
static void
take_indices(loop *l, otx_worker *worker)
{
    int64_t index;

    while ((index = atomic_fetch_add(&l->next, 1)) < l->end)
    {
        const otx_arena_mark mark = otx_arena_here(worker->scratch);
        otx_status status;

        if (l->order)
            wait_for_turn(l, index, worker);
        status = otx_worker_look(worker);
        if (status == OSDTEX_OK)
            status = l->body(l->context, index, worker);
        otx_arena_release(worker->scratch, mark);
        if (status != OSDTEX_OK)
            record_failure(worker->pool, l, index, status);
        if (l->order)
            mark_done(l, index, worker->pool);
    }
}

/* -- loops --------------------------------------------------------------- */

static void
open_loop(otx_pool *pool, loop *l)
{
    loop **at = &pool->open;

    pthread_mutex_lock(&pool->mutex);
    while (*at)
        at = &(*at)->newer;
    *at = l;
    atomic_fetch_add(&pool->opened, 1);
    pthread_cond_broadcast(&pool->work);
    if (l->inner && pool->waiting > 0)
        pthread_cond_broadcast(&pool->done);
    pthread_mutex_unlock(&pool->mutex);
}

/* Waits for those who joined. A thread that has not woken by now, because it is
 * a short loop or a busy machine, is not waited for. */
static void
close_loop(otx_pool *pool, loop *l, otx_worker *worker)
{
    loop **at = &pool->open;

    pthread_mutex_lock(&pool->mutex);
    while (*at != l)
        at = &(*at)->newer;
    *at = l->newer;
    pthread_mutex_unlock(&pool->mutex);
    for (int32_t i = 0; i < LOOKS && atomic_load(&l->busy) > 0; ++i)
        continue;
    pthread_mutex_lock(&pool->mutex);
    while (l->busy > 0)
        if (l->inner)
            wait_for_done(pool, worker);
        else
            help_or_wait(pool, worker);
    pthread_mutex_unlock(&pool->mutex);
}

static otx_status
run_loop(loop *l, otx_worker *worker)
{
    otx_pool *pool = worker->pool;
    const bool shared =
        pool && pool->started > 0 && l->end - atomic_load(&l->next) > 1;

    if (shared)
        open_loop(pool, l);
    take_indices(l, worker);
    if (shared)
        close_loop(pool, l, worker);
    return l->failure;
}

otx_status
otx_pool_for(otx_pool *pool, int64_t count, otx_pool_body body, void *context)
{
    loop l = {
        .body = body,
        .context = context,
        .end = count,
        .failed_index = INT64_MAX};

    return run_loop(&l, &pool->threads[0].worker);
}

otx_status
otx_pool_share(
    otx_worker *worker, int64_t count, otx_pool_body body, void *context)
{
    loop l = {
        .body = body,
        .context = context,
        .end = count,
        .inner = true,
        .failed_index = INT64_MAX};

    return run_loop(&l, worker);
}

otx_status
otx_pool_for_ordered(
    otx_pool *pool, const otx_pool_order *order, int64_t first, int64_t end,
    otx_pool_body body, void *context)
{
    otx_worker *worker = &pool->threads[0].worker;
    const otx_arena_mark mark = otx_arena_here(worker->scratch);
    loop l = {
        .body = body,
        .context = context,
        .end = end,
        .order = order,
        .done = OTX_ZNEW(worker->scratch, uint8_t, end),
        .failed_index = INT64_MAX};
    otx_status status;

    if (!l.done)
        return OSDTEX_ERROR_MEMORY;
    memset(l.done, 1, (size_t)first);
    atomic_store(&l.next, first);
    status = run_loop(&l, worker);
    otx_arena_release(worker->scratch, mark);
    return status;
}

/* -- threads ------------------------------------------------------------- */

/* Waits a moment, then asleep, for a loop to be opened. Under the lock. */
static void
wait_for_work(otx_pool *pool)
{
    const int64_t seen = atomic_load(&pool->opened);

    pthread_mutex_unlock(&pool->mutex);
    for (int32_t i = 0; i < LOOKS && atomic_load(&pool->opened) == seen; ++i)
        continue;
    pthread_mutex_lock(&pool->mutex);
    if (atomic_load(&pool->opened) == seen && !pool->quit)
        pthread_cond_wait(&pool->work, &pool->mutex);
}

static void *
thread_main(void *argument)
{
    thread *self = argument;
    otx_pool *pool = self->pool;

    pthread_mutex_lock(&pool->mutex);
    while (!pool->quit)
    {
        loop *l = find_open(pool, false);

        if (l)
            join(pool, l, &self->worker);
        else
            wait_for_work(pool);
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
        t->worker.pool = pool;
        t->worker.scratch = otx_arena_create(pool->allocator);
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
otx_pool_create(otx_allocator *allocator, int32_t threads)
{
    otx_pool *pool = otx_allocator_alloc(allocator, sizeof *pool);

    if (!pool)
        return NULL;
    if (threads <= 0)
        threads = (int32_t)sysconf(_SC_NPROCESSORS_ONLN);
    if (threads < 1)
        threads = 1;
    if (threads > MAX_THREADS)
        threads = MAX_THREADS;
    memset(pool, 0, sizeof *pool);
    pool->allocator = allocator;
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
    otx_allocator_free(pool->allocator, pool, sizeof *pool);
}

int32_t
otx_pool_threads(const otx_pool *pool)
{
    return pool->thread_count;
}
