/* meter.h -- a host whose heap and patience can end at any moment. */
#ifndef OTX_TESTS_METER_H
#define OTX_TESTS_METER_H

/* cmocka.h needs these first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <osdtex/osdtex.h>

#include <stdlib.h>
#include <string.h>

/* A heap that counts, and fails at the k-th allocation. */
typedef struct meter
{
    _Atomic long blocks;
    _Atomic long calls;
    long fail_at; /* -1 never */
    /* Progress calls until cancelled; -1 never. */
    long cancel_at;
    long progress_calls;
} meter;

static inline void *
meter_alloc(void *user, size_t bytes)
{
    meter *m = user;
    const long call = m->calls++;

    if (call == m->fail_at)
        return NULL;
    ++m->blocks;
    return malloc(bytes);
}

static inline void
meter_release(void *user, void *block, size_t bytes)
{
    meter *m = user;

    --m->blocks;
    /* Who reads on finds nothing; a memset before free would be left out. */
    explicit_bzero(block, bytes);
    free(block);
}

static inline bool
meter_progress(void *user, const char *stage, double fraction)
{
    meter *m = user;

    assert_non_null(stage);
    assert_true(fraction >= 0.0 && fraction <= 1.0);
    return m->progress_calls++ != m->cancel_at;
}

static inline osdtex_context_options
metered(meter *m)
{
    osdtex_context_options options = osdtex_context_options_default();

    options.alloc = meter_alloc;
    options.release = meter_release;
    options.alloc_user = m;
    options.progress = meter_progress;
    options.progress_user = m;
    options.threads = 2;
    return options;
}

/* Moments to try: all of the first `dense`, then ever fewer, by k / `sparse`.
 */
typedef struct moments
{
    long dense, sparse;
} moments;

static inline long
next_moment(const moments *m, long k)
{
    return k < m->dense ? k + 1 : k + 1 + k / m->sparse;
}

/* Runs a whole job of a host over and over, a later allocation failing each
 * time: nothing leaks. `job` frees what it made. */
static inline void
fail_at_moments(const moments *at, osdtex_status (*job)(osdtex_context *))
{
    for (long k = 0;; k = next_moment(at, k))
    {
        meter m = {.fail_at = k, .cancel_at = -1};
        const osdtex_context_options options = metered(&m);
        osdtex_context *context;
        osdtex_status status;

        status = osdtex_context_create(&options, &context);
        if (status == OSDTEX_OK)
            status = job(context);
        osdtex_context_destroy(context);
        assert_int_equal(m.blocks, 0);
        if (m.calls <= k)
            return;
        /* A sentence that could not be kept is no failure. */
        assert_true(status == OSDTEX_ERROR_MEMORY || status == OSDTEX_OK);
    }
}

/* The same, cancelled a progress call later each time. */
static inline void
cancel_at_moments(const moments *at, osdtex_status (*job)(osdtex_context *))
{
    for (long k = 0;; k = next_moment(at, k))
    {
        meter m = {.fail_at = -1, .cancel_at = k};
        const osdtex_context_options options = metered(&m);
        osdtex_context *context;
        osdtex_status status;

        assert_int_equal(osdtex_context_create(&options, &context), OSDTEX_OK);
        status = job(context);
        osdtex_context_destroy(context);
        assert_int_equal(m.blocks, 0);
        if (m.progress_calls <= k)
        {
            assert_int_equal(status, OSDTEX_OK);
            return;
        }
        assert_int_equal(status, OSDTEX_ERROR_CANCELLED);
    }
}

#endif
