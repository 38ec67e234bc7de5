/* test_bin.c -- every item is in each block of its box, in order. */
#include "support.h"

#include "bake/bin.h"
#include "base/random.h"

enum
{
    COLUMNS = 7,
    ROWS = 5,
    ITEMS = 200
};

static otx_bin_box
random_box(const void *context, int32_t index)
{
    const uint64_t i = (uint64_t)index;
    otx_bin_box box;

    (void)context;
    box.x = (int32_t)(COLUMNS * otx_random_unit(2, 0, i));
    box.y = (int32_t)(ROWS * otx_random_unit(2, 1, i));
    box.x_end =
        box.x + (int32_t)((COLUMNS - box.x + 1) * otx_random_unit(2, 2, i));
    box.y_end =
        box.y + (int32_t)((ROWS - box.y + 1) * otx_random_unit(2, 3, i));
    return box;
}

static bool
holds(otx_bin_box box, int32_t x, int32_t y)
{
    return x >= box.x && x < box.x_end && y >= box.y && y < box.y_end;
}

static void
blocks_list_what_reaches_into_them(void **state)
{
    otx_run *run = test_run_create();
    otx_bin bin;

    (void)state;
    assert_int_equal(
        otx_bin_build(
            run, run->arena, COLUMNS, ROWS, ITEMS, random_box, NULL, &bin),
        OSDTEX_OK);
    assert_int_equal(bin.first[0], 0);
    for (int32_t y = 0; y < ROWS; ++y)
        for (int32_t x = 0; x < COLUMNS; ++x)
        {
            int64_t at = bin.first[y * COLUMNS + x];

            for (int32_t i = 0; i < ITEMS; ++i)
                if (holds(random_box(NULL, i), x, y))
                    assert_int_equal(bin.items[at++], i);
            assert_int_equal(at, bin.first[y * COLUMNS + x + 1]);
        }
    test_run_destroy(run);
}

static void
nothing_is_nowhere(void **state)
{
    otx_run *run = test_run_create();
    otx_bin bin;

    (void)state;
    assert_int_equal(
        otx_bin_build(
            run, run->arena, COLUMNS, ROWS, 0, random_box, NULL, &bin),
        OSDTEX_OK);
    for (int32_t i = 0; i <= COLUMNS * ROWS; ++i)
        assert_int_equal(bin.first[i], 0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_list_what_reaches_into_them),
        cmocka_unit_test(nothing_is_nowhere),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
