/* test_distance.c -- distances from where labels change, on a grid. */
#include "grid.h"

#include "surface/distance.h"

enum
{
    NX = 12,
    NY = 4
};

static void
distances_count_from_the_border(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, NX, NY, 0.5);
    uint8_t labels[NX * NY];
    double away[NX * NY];

    (void)state;
    for (int32_t f = 0; f < NX * NY; ++f)
        labels[f] = f % NX > 3;
    assert_int_equal(
        otx_distance_measure(run, surface, labels, 8.0, 13.0, away), OSDTEX_OK);
    for (int32_t f = 0; f < NX * NY; ++f)
    {
        const int32_t x = f % NX, steps = x > 3 ? x - 4 : 3 - x;

        /* Faces are 4 texels wide; the fourth step is beyond the limit. */
        if (steps > 3)
            assert_true(isinf(away[f]));
        else
            assert_true(fabs(away[f] - 4.0 * steps) < 1e-9);
    }
    test_run_destroy(run);
}

static void
one_label_ends_nowhere(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, NX, NY, 0.5);
    const uint8_t labels[NX * NY] = {0};
    double away[NX * NY];

    (void)state;
    assert_int_equal(
        otx_distance_measure(run, surface, labels, 8.0, INFINITY, away),
        OSDTEX_OK);
    for (int32_t f = 0; f < NX * NY; ++f)
        assert_true(isinf(away[f]));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_count_from_the_border),
        cmocka_unit_test(one_label_ends_nowhere),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
