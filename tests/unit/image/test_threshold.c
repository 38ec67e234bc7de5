/* test_threshold.c -- two heaps of values are parted, one is not. */
#include "support.h"

#include "base/random.h"
#include "image/threshold.h"

enum
{
    COUNT = 4000
};

/* A share of values around `high`, the rest around `low`. */
static void
heap(double low, double high, double spread, double share, float *out)
{
    for (int32_t i = 0; i < COUNT; ++i)
        out[i] =
            (float)((i < share * COUNT ? high : low) + spread * (otx_random_unit(1, 1, (uint64_t)i) - 0.5));
}

/* However unlike they are in number. */
static void
two_heaps_are_parted(void **state)
{
    static const double shares[] = {0.5, 0.2, 0.05};
    float values[COUNT];

    (void)state;
    for (int k = 0; k < 3; ++k)
    {
        otx_threshold t;

        heap(-3.0, 7.0, 2.0, shares[k], values);
        t = otx_threshold_find(values, COUNT);
        for (int32_t i = 0; i < COUNT; ++i)
            assert_true(
                ((double)values[i] >= t.value) == (i < shares[k] * COUNT));
        assert_true(t.clarity > 0.9 && t.clarity <= 1.0);
    }
}

static void
one_heap_is_not_clear(void **state)
{
    float values[COUNT];
    otx_threshold t;

    (void)state;
    heap(5.0, 5.0, 4.0, 0.0, values);
    t = otx_threshold_find(values, COUNT);
    /* Halving an even spread explains three quarters of it. */
    assert_float_equal(t.clarity, 0.75, 0.02);
    assert_float_equal(t.value, 5.0, 0.1);
}

static void
one_value_is_no_heap(void **state)
{
    float values[COUNT];

    (void)state;
    heap(2.0, 2.0, 0.0, 0.0, values);
    assert_float_equal(otx_threshold_find(values, COUNT).clarity, 0.0, 0.0);
    assert_float_equal(otx_threshold_find(values, 1).value, 2.0, 0.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_heaps_are_parted),
        cmocka_unit_test(one_heap_is_not_clear),
        cmocka_unit_test(one_value_is_no_heap),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
