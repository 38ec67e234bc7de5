/* test_pool.c -- every index once, the lowest failure wins, scratch is fresh.
 */
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

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_index_runs_once_at_any_thread_count),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
