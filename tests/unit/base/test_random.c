/* test_random.c -- even, independent of order, different for every purpose. */
#include "support.h"

#include "base/random.h"

#include <math.h>

enum
{
    DRAWS = 100000
};

static void
numbers_depend_on_seed_stage_and_element(void **state)
{
    const uint64_t base = otx_random_bits(1, 2, 3);

    (void)state;
    assert_true(base == otx_random_bits(1, 2, 3));
    assert_true(base != otx_random_bits(2, 2, 3));
    assert_true(base != otx_random_bits(1, 3, 3));
    assert_true(base != otx_random_bits(1, 2, 4));
    assert_true(otx_random_bits(0, 0, 0) != 0);
}

/* Mean, variance and each of 16 bins within five standard errors. */
static void
units_are_even(void **state)
{
    double sum = 0.0, squares = 0.0;
    int32_t bins[16] = {0};

    (void)state;
    for (uint64_t i = 0; i < DRAWS; ++i)
    {
        const double x = otx_random_unit(7, 1, i);

        assert_true(x >= 0.0 && x < 1.0);
        sum += x;
        squares += x * x;
        ++bins[(int)(16.0 * x)];
    }
    assert_true(fabs(sum / DRAWS - 0.5) < 5.0 * sqrt(1.0 / 12.0 / DRAWS));
    assert_true(fabs(squares / DRAWS - 1.0 / 3.0) < 5e-3);
    for (int i = 0; i < 16; ++i)
        assert_true(fabs(bins[i] - DRAWS / 16.0) < 5.0 * sqrt(DRAWS / 16.0));
}

static void
neighbouring_elements_are_not_alike(void **state)
{
    double product = 0.0;

    (void)state;
    for (uint64_t i = 0; i < DRAWS; ++i)
        product += (otx_random_unit(7, 1, i) - 0.5) *
                   (otx_random_unit(7, 1, i + 1) - 0.5);
    assert_true(fabs(product / DRAWS * 12.0) < 5.0 / sqrt(DRAWS));
}

/* A changed bit of the input changes about half of the output. */
static void
every_bit_matters(void **state)
{
    (void)state;
    for (int bit = 0; bit < 64; ++bit)
    {
        double changed = 0.0;

        for (uint64_t i = 0; i < 200; ++i)
        {
            uint64_t d = otx_random_bits(5, 9, i * 977) ^
                         otx_random_bits(5, 9, (i * 977) ^ (1ull << bit));

            for (; d; d &= d - 1)
                changed += 1.0;
        }
        assert_true(fabs(changed / 200.0 - 32.0) < 3.0);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_depend_on_seed_stage_and_element),
        cmocka_unit_test(units_are_even),
        cmocka_unit_test(neighbouring_elements_are_not_alike),
        cmocka_unit_test(every_bit_matters),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
