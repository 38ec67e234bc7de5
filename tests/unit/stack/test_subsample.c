/* test_subsample.c -- the best choice of all, and bits that come back. */
#include "support.h"

#include "base/random.h"
#include "stack/subsample.h"

enum
{
    COUNT = 9,
    TEXELS = 150,
    PICKS = 4
};

static double
cost(uint8_t masks[COUNT][TEXELS], const int32_t *picks)
{
    double sum = 0.0;

    for (int32_t k = 0; k + 1 < PICKS; ++k)
    {
        double d = 0.0;

        for (int32_t i = 0; i < TEXELS; ++i)
            d += masks[picks[k]][i] != masks[picks[k + 1]][i];
        sum += d * d * d * d;
    }
    return sum;
}

/* Masks that fill up unevenly. */
static void
paint(uint8_t masks[COUNT][TEXELS])
{
    static const double shares[COUNT] = {
        0.0, 0.01, 0.02, 0.4, 0.45, 0.5, 0.55, 0.9, 1.0};

    for (int32_t k = 0; k < COUNT; ++k)
        for (int32_t i = 0; i < TEXELS; ++i)
            masks[k][i] = otx_random_unit(5, 1, (uint64_t)i) < shares[k];
}

static void
no_other_choice_is_better(void **state)
{
    otx_run *run = test_run_create();
    uint8_t masks[COUNT][TEXELS], back[TEXELS];
    otx_subsample s;
    int32_t picks[PICKS];
    double best;

    (void)state;
    paint(masks);
    assert_int_equal(otx_subsample_create(run, COUNT, TEXELS, &s), OSDTEX_OK);
    for (int32_t k = 0; k < COUNT; ++k)
        otx_subsample_put(&s, k, masks[k]);
    otx_subsample_get(&s, 4, back);
    assert_memory_equal(back, masks[4], TEXELS);
    assert_int_equal(otx_subsample_pick(run, &s, PICKS, picks), OSDTEX_OK);
    assert_int_equal(picks[0], 0);
    assert_int_equal(picks[PICKS - 1], COUNT - 1);
    best = cost(masks, picks);
    for (int32_t a = 1; a < COUNT - 1; ++a)
        for (int32_t b = a + 1; b < COUNT - 1; ++b)
            assert_true(best <= cost(masks, (int32_t[]){0, a, b, COUNT - 1}));
    assert_int_equal(
        otx_subsample_pick(run, &s, COUNT + 1, picks), OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_other_choice_is_better),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
