/* test_wear.c -- usage over what a patch covers. */
#include "scene.h"

#include "match/wear.h"

enum
{
    CELLS = 8,
    SIDE = 64
};

/* Table and factor of a square patch of two cells a side. */
static void
check(bool wrap, const float *usage, double tolerance)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, SIDE, SIDE);
    const otx_matcher *matcher = scene_matcher(run, &image, wrap);
    const double angle = 0.5 * OTX_PI;
    otx_match_query query = otx_match_query_defaults(&angle, 1);
    otx_vec2 cover[256];
    otx_wear wear;

    for (int i = 0; i < 256; ++i)
        cover[i] = (otx_vec2){i % 16 + 0.5, i / 16 + 0.5};
    query.cover = cover;
    query.cover_count = 256;
    query.centre = (otx_vec2){8.0, 8.0};
    query.usage = usage;
    query.usage_width = query.usage_height = CELLS;
    query.usage_weight = 0.5;
    assert_int_equal(otx_wear_create(run->arena, &query, &wear), OSDTEX_OK);
    otx_wear_tabulate(matcher, &query, angle, &wear);
    for (int y = 2; y < CELLS - 2; ++y)
        for (int x = 2; x < CELLS - 2; ++x)
        {
            /* The centre, turned, at the middle of the cell. */
            const otx_match placed = {
                .angle = angle,
                .shift = {8.0 * x + 4.0 + 8.0, 8.0 * y + 4.0 - 8.0}};
            const double factor = otx_wear_factor(matcher, &query, &placed);

            assert_true(
                fabs(factor - (double)wear.factors[y * CELLS + x]) < tolerance);
        }
    test_run_destroy(run);
}

static void
even_usage_is_the_same_everywhere(void **state)
{
    float usage[CELLS * CELLS];

    (void)state;
    for (int i = 0; i < CELLS * CELLS; ++i)
        usage[i] = 3.0f;
    check(true, usage, 1e-5);
    check(false, usage, 1e-5);
}

/* The mean of what changes evenly is that of the middle. */
static void
the_table_is_the_factor(void **state)
{
    float usage[CELLS * CELLS];

    (void)state;
    for (int i = 0; i < CELLS * CELLS; ++i)
        usage[i] = (float)(i % CELLS) + 2.0f * (float)(i / CELLS);
    check(true, usage, 0.1);
    check(false, usage, 0.1);
}

static void
without_usage_nothing_costs(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = scene_exemplar(run, SIDE, SIDE);
    const otx_matcher *matcher = scene_matcher(run, &image, true);
    const double angle = 0.0;
    const otx_match_query query = otx_match_query_defaults(&angle, 1);
    otx_wear wear;

    (void)state;
    assert_int_equal(otx_wear_create(run->arena, &query, &wear), OSDTEX_OK);
    assert_null(wear.factors);
    assert_true(
        otx_wear_factor(matcher, &query, &(otx_match){.angle = angle}) == 1.0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_usage_is_the_same_everywhere),
        cmocka_unit_test(the_table_is_the_factor),
        cmocka_unit_test(without_usage_nothing_costs),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
