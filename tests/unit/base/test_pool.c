/* test_pool.c -- every index once, the lowest failure wins, scratch is fresh,
 * loops may be nested and have an order. */
#include "support.h"

enum
{
    COUNT = 1000
};

static otx_status
count_visits(void *context, int64_t index, otx_worker *worker)
{
    int *visits = context;
    char *scratch = OTX_NEW(worker->scratch, char, 100000);

    if (!scratch)
        return OSDTEX_ERROR_MEMORY;
    memset(scratch, (int)index, 100000);
    ++visits[index];
    return OSDTEX_OK;
}

static otx_status
fail_on_multiples(void *context, int64_t index, otx_worker *worker)
{
    (void)context;
    (void)worker;
    return index % 10 == 7 ? -(otx_status)index : OSDTEX_OK;
}

static void
check_pool(int32_t threads)
{
    otx_run *run = test_run_create_with(NULL, threads);
    int visits[COUNT] = {0};

    assert_int_equal(otx_pool_threads(run->pool), threads);
    for (int round = 1; round <= 20; ++round)
    {
        assert_int_equal(
            otx_pool_for(run->pool, COUNT, count_visits, visits), OSDTEX_OK);
        for (int i = 0; i < COUNT; ++i)
            assert_int_equal(visits[i], round);
    }
    assert_int_equal(
        otx_pool_for(run->pool, COUNT, fail_on_multiples, NULL), -7);
    assert_int_equal(
        otx_pool_for(run->pool, 0, fail_on_multiples, NULL), OSDTEX_OK);
    test_run_destroy(run);
}

static void
every_index_runs_once_at_any_thread_count(void **state)
{
    (void)state;
    check_pool(1);
    check_pool(2);
    check_pool(8);
}

/* -- loops within loops --------------------------------------------------- */

enum
{
    OUTER = 37,
    INNER = 23
};

typedef struct nest
{
    int visits[OUTER][INNER];
    int sums[OUTER];
} nest;

typedef struct row
{
    nest *all;
    int64_t index;
} row;

static otx_status
visit_inner(void *context, int64_t index, otx_worker *worker)
{
    const row *r = context;
    char *scratch = OTX_NEW(worker->scratch, char, 1000);

    if (!scratch)
        return OSDTEX_ERROR_MEMORY;
    memset(scratch, (int)index, 1000);
    ++r->all->visits[r->index][index];
    return r->index % 10 == 3 && index >= 20 ? -(otx_status)(100 + index)
                                             : OSDTEX_OK;
}

/* What the body has in its arena stays while others are run in between. */
static otx_status
visit_outer(void *context, int64_t index, otx_worker *worker)
{
    nest *all = context;
    row r = {all, index};
    int *mine = OTX_NEW(worker->scratch, int, 1000);
    otx_status status;

    if (!mine)
        return OSDTEX_ERROR_MEMORY;
    for (int i = 0; i < 1000; ++i)
        mine[i] = (int)index;
    status = otx_pool_share(worker, INNER, visit_inner, &r);
    for (int i = 0; i < 1000; ++i)
        all->sums[index] += mine[i];
    return status;
}

static void
loops_may_open_loops(void **state)
{
    static const int32_t threads[] = {1, 2, 8};

    (void)state;
    for (int t = 0; t < 3; ++t)
        for (int round = 0; round < 20; ++round)
        {
            otx_run *run = test_run_create_with(NULL, threads[t]);
            nest all = {0};

            assert_int_equal(
                otx_pool_for(run->pool, OUTER, visit_outer, &all), -120);
            for (int i = 0; i < OUTER; ++i)
            {
                assert_int_equal(all.sums[i], 1000 * i);
                for (int k = 0; k < INNER; ++k)
                    assert_int_equal(all.visits[i][k], 1);
            }
            test_run_destroy(run);
        }
}

/* -- order --------------------------------------------------------------- */

/* Index i comes after i - 2, and after i / 2: values are sums over both. */
typedef struct chain
{
    int64_t first[COUNT + 1];
    int32_t before[2 * COUNT];
    int64_t values[COUNT];
} chain;

static otx_status
add_ones_before(void *context, int64_t index, otx_worker *worker)
{
    chain *c = context;

    (void)worker;
    c->values[index] = 1;
    for (int64_t i = c->first[index]; i < c->first[index + 1]; ++i)
        c->values[index] += c->values[c->before[i]] % 1000003;
    return OSDTEX_OK;
}

static otx_status
add_after_a_loop(void *context, int64_t index, otx_worker *worker)
{
    nest unused = {0};
    row r = {&unused, 0};

    OTX_TRY(otx_pool_share(worker, INNER, visit_inner, &r));
    return add_ones_before(context, index, worker);
}

static void
an_order_is_kept(void **state)
{
    static const int32_t threads[] = {1, 2, 8};
    static const otx_pool_body bodies[] = {add_ones_before, add_after_a_loop};
    static chain sequential, c;
    int64_t n = 0;

    (void)state;
    for (int32_t i = 0; i < COUNT; ++i)
    {
        sequential.first[i] = n;
        if (i > 1)
            sequential.before[n++] = i - 2;
        if (i > 0)
            sequential.before[n++] = i / 2;
        sequential.first[i + 1] = n;
        add_ones_before(&sequential, i, NULL);
    }
    for (int t = 0; t < 3; ++t)
        for (int b = 0; b < 2; ++b)
        {
            otx_run *run = test_run_create_with(NULL, threads[t]);
            const otx_pool_order order = {sequential.first, sequential.before};

            c = sequential;
            memset(c.values, 0, sizeof c.values);
            for (int32_t first = 0; first < COUNT; first += COUNT / 4)
                assert_int_equal(
                    otx_pool_for_ordered(
                        run->pool, &order, first, first + COUNT / 4, bodies[b],
                        &c),
                    OSDTEX_OK);
            assert_memory_equal(c.values, sequential.values, sizeof c.values);
            test_run_destroy(run);
        }
}

static bool
count_down(void *user)
{
    int *left = user;

    return --*left > 0;
}

static otx_status
count_runs(void *context, int64_t index, otx_worker *worker)
{
    int *runs = context;

    runs[index] = 1;
    return otx_worker_look(worker);
}

/* Once the watch says no, nothing runs until there is another one. */
static void
a_watch_stops_loops(void **state)
{
    (void)state;
    for (int32_t threads = 1; threads <= 4; ++threads)
    {
        otx_run *run = test_run_create_with(NULL, threads);
        int runs[COUNT] = {0}, left = 3;

        otx_pool_watch(run->pool, count_down, &left, 0.0);
        assert_int_equal(otx_pulse(run), OSDTEX_OK);
        assert_int_equal(otx_pulse(run), OSDTEX_OK);
        assert_int_equal(otx_pulse(run), OSDTEX_ERROR_CANCELLED);
        assert_true(otx_pool_is_stopped(run->pool));
        assert_int_equal(
            otx_pool_for(run->pool, COUNT, count_runs, runs),
            OSDTEX_ERROR_CANCELLED);
        for (int i = 0; i < COUNT; ++i)
            assert_int_equal(runs[i], 0);
        otx_pool_watch(run->pool, NULL, NULL, 0.0);
        assert_int_equal(
            otx_pool_for(run->pool, COUNT, count_runs, runs), OSDTEX_OK);
        for (int i = 0; i < COUNT; ++i)
            assert_int_equal(runs[i], 1);
        test_run_destroy(run);
    }
}

/* Whoever made the pool asks between its indices. */
static void
a_watch_is_asked_by_the_owner(void **state)
{
    otx_run *run = test_run_create_with(NULL, 1);
    int runs[COUNT] = {0}, left = 100, count = 0;

    (void)state;
    otx_pool_watch(run->pool, count_down, &left, 0.0);
    assert_int_equal(
        otx_pool_for(run->pool, COUNT, count_runs, runs),
        OSDTEX_ERROR_CANCELLED);
    for (int i = 0; i < COUNT; ++i)
        count += runs[i];
    assert_in_range(count, 40, 60);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_index_runs_once_at_any_thread_count),
        cmocka_unit_test(loops_may_open_loops),
        cmocka_unit_test(an_order_is_kept),
        cmocka_unit_test(a_watch_stops_loops),
        cmocka_unit_test(a_watch_is_asked_by_the_owner),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
