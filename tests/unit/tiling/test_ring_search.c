/* test_ring_search.c -- the windows that are found are the best there are. */
#include "tiles.h"

enum
{
    WANTED = 6
};

static void
what_is_found_is_the_best(void **state)
{
    static const otx_ring_region anywhere = {0};
    tiles *t = tiles_prepare(2, 11);
    otx_ring_search search;
    otx_texel_window found[WANTED];
    double last = 0.0;

    (void)state;
    assert_int_equal(
        otx_ring_search_create(
            t->run, &t->pool, &t->kit, &t->layout, &anywhere, &search),
        OSDTEX_OK);
    for (int32_t n = 0; n < 4; ++n)
    {
        const otx_tile_name name = otx_tile_layout_name(&t->layout, 5 * n);
        const int32_t count = otx_ring_search_find(
            t->run->scratch, &search, &name, OTX_RING_SEARCH_SIDES, WANTED,
            found);
        double least = INFINITY;

        assert_in_range(count, 1, WANTED);
        for (int32_t y = search.y0; y < search.y1; ++y)
            for (int32_t x = search.x0; x < search.x1; ++x)
                for (int32_t turns = 0; turns < 4; turns += search.turns_step)
                    least = fmin(
                        least, otx_ring_search_error(
                                   &search, &name, OTX_RING_SEARCH_SIDES,
                                   (otx_texel_window){x, y, turns}));
        for (int32_t i = 0; i < count; ++i)
        {
            const double error = otx_ring_search_error(
                &search, &name, OTX_RING_SEARCH_SIDES, found[i]);

            if (i == 0)
                assert_true(error == least);
            assert_true(i == 0 || error >= last);
            last = error;
        }
    }
    test_run_destroy(t->run);
}

static void
a_region_holds_windows(void **state)
{
    tiles *t = tiles_prepare(2, 12);
    const otx_ring_region region = {10, 20, 45, 60};
    const otx_ring_region small = {10, 20, 14, 24};
    const otx_tile_name name = otx_tile_layout_name(&t->layout, 0);
    otx_ring_search search;
    otx_texel_window found[WANTED];
    int32_t count;

    (void)state;
    assert_int_equal(
        otx_ring_search_create(
            t->run, &t->pool, &t->kit, &t->layout, &region, &search),
        OSDTEX_OK);
    count = otx_ring_search_find(
        t->run->scratch, &search, &name, OTX_RING_SEARCH_SIDES, WANTED, found);
    for (int32_t i = 0; i < count; ++i)
    {
        assert_in_range(found[i].x, 10, 45 - t->kit.sizes.side + 1);
        assert_in_range(found[i].y, 20, 60 - t->kit.sizes.side + 1);
    }
    assert_int_equal(
        otx_ring_search_create(
            t->run, &t->pool, &t->kit, &t->layout, &small, &search),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(t->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_found_is_the_best),
        cmocka_unit_test(a_region_holds_windows),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
