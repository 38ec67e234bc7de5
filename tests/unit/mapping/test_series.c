/* test_series.c -- weights are as many equal values. */
#include "support.h"

#include "mapping/series.h"

static void
of_none_all_is_zero(void **state)
{
    otx_series s = {0};

    (void)state;
    assert_float_equal(otx_series_mean(&s), 0.0, 0.0);
    assert_float_equal(otx_series_quantile(&s, 0.5), 0.0, 0.0);
}

static void
a_weight_is_as_many_values(void **state)
{
    static const double values[] = {5.0, -1.0, 2.0, 2.0, 8.0};
    static const int weights[] = {3, 1, 4, 2, 2};
    otx_series_item few[5], many[12];
    otx_series weighted = {.items = few}, repeated = {.items = many};

    (void)state;
    for (int i = 0; i < 5; ++i)
    {
        otx_series_add(&weighted, values[i], weights[i]);
        for (int k = 0; k < weights[i]; ++k)
            otx_series_add(&repeated, values[i], 1.0);
    }
    assert_float_equal(
        otx_series_mean(&weighted), otx_series_mean(&repeated), 1e-12);
    for (int k = 0; k <= 12; ++k)
        assert_float_equal(
            otx_series_quantile(&weighted, k / 12.0),
            otx_series_quantile(&repeated, k / 12.0), 0.0);
    assert_float_equal(otx_series_quantile(&weighted, 0.0), -1.0, 0.0);
    assert_float_equal(otx_series_quantile(&weighted, 0.5), 2.0, 0.0);
    assert_float_equal(otx_series_quantile(&weighted, 1.0), 8.0, 0.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_none_all_is_zero),
        cmocka_unit_test(a_weight_is_as_many_values),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
