/* test_tile_layout.c -- a tile's name is its place, and the line in the file
 * says the whole layout. */
#include "support.h"

#include "image/tile_layout.h"

static otx_tile_layout
layout_of(otx_run *run, int32_t boundaries, int32_t corners)
{
    otx_tile_layout l = {
        .boundaries = boundaries,
        .corners = corners,
        .cell = 16,
        .gutter = 2,
        .source_width = 300,
        .seed = 77,
        .figures = {0.125, -1.0, 0.5},
    };

    assert_int_equal(otx_tile_layout_arrange(run, &l), OSDTEX_OK);
    return l;
}

static void
numbers_and_names_are_one(void **state)
{
    for (int32_t boundaries = 1; boundaries <= 2; ++boundaries)
        for (int32_t corners = 1; corners <= 2; ++corners)
        {
            const otx_tile_layout l = layout_of(*state, boundaries, corners);
            const int32_t half = otx_tile_layout_half(&l);

            for (int32_t number = 0; number < half * half; ++number)
            {
                const otx_tile_name name = otx_tile_layout_name(&l, number);

                for (int i = 0; i < 4; ++i)
                {
                    assert_in_range(name.sides[i], 0, 2 * boundaries - 1);
                    assert_in_range(name.corners[i], 0, corners - 1);
                }
                assert_int_equal(otx_tile_layout_number(&l, &name), number);
                assert_int_equal(otx_tile_layout_cell(&l, number), number);
            }
        }
}

/* A set for one mesh has some of the tiles, in the order of their names. */
static const int32_t SOME[] = {0, 3, 7, 11, 200};

static otx_tile_layout
some_of(otx_run *run)
{
    otx_tile_layout l = layout_of(run, 2, 1);

    l.names = SOME;
    l.name_count = sizeof SOME / sizeof *SOME;
    assert_int_equal(otx_tile_layout_arrange(run, &l), OSDTEX_OK);
    return l;
}

static void
tiles_that_are_not_there_have_no_cell(void **state)
{
    const otx_tile_layout l = some_of(*state);

    for (int32_t number = 0; number < 256; ++number)
    {
        const int32_t cell = otx_tile_layout_cell(&l, number);

        if (cell >= 0)
            assert_int_equal(SOME[cell], number);
    }
    for (int32_t i = 0; i < l.name_count; ++i)
        assert_int_equal(otx_tile_layout_cell(&l, SOME[i]), i);
}

static otx_status
parse(
    otx_run *run, const char *text, const otx_tile_layout *l,
    otx_tile_layout *out)
{
    return otx_tile_layout_parse(
        run, "t.exr", text, l->columns * l->cell, l->rows * l->cell, out);
}

static void
what_is_printed_reads_back(void **state)
{
    otx_run *run = *state;
    const otx_tile_layout layouts[] = {layout_of(run, 2, 2), some_of(run)};

    for (int k = 0; k < 2; ++k)
    {
        const otx_tile_layout *l = &layouts[k];
        const char *text = otx_tile_layout_print(run->arena, l);
        otx_tile_layout back;

        assert_int_equal(parse(run, text, l, &back), OSDTEX_OK);
        assert_string_equal(otx_tile_layout_print(run->arena, &back), text);
        assert_int_equal(back.seed, 77);
        assert_float_equal(back.figures.inner_cut, 0.125, 0.0);
        assert_true(back.figures.vertex_window < 0.0);
        assert_int_equal(back.names != NULL, k);
        /* Of another picture. */
        assert_int_equal(
            otx_tile_layout_parse(
                run, "t.exr", text, l->columns * l->cell, 16, &back),
            OSDTEX_ERROR_FORMAT);
    }
}

/* Any beginning, and any digit made another sign. */
static void
damaged_lines_are_refused(void **state)
{
    otx_run *run = *state;
    const otx_tile_layout l = some_of(run);
    const char *text = otx_tile_layout_print(run->arena, &l);
    const size_t length = strlen(text);
    char *damaged = OTX_ZNEW(run->arena, char, length + 1);
    otx_tile_layout out;

    /* The last name is 200, which is more than the one before it as 20, too. */
    for (size_t i = 0; i + 2 < length; ++i)
    {
        memcpy(damaged, text, i);
        assert_int_equal(parse(run, damaged, &l, &out), OSDTEX_ERROR_FORMAT);
    }
    for (size_t i = 0; i < length; ++i)
    {
        if (text[i] < '0' || text[i] > '9')
            continue;
        memcpy(damaged, text, length);
        damaged[i] = '?';
        if (i + 2 < length)
            assert_int_equal(
                parse(run, damaged, &l, &out), OSDTEX_ERROR_FORMAT);
    }
    assert_non_null(strstr(test_last_message(run), "make the tiles again"));
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_run_setup, test_run_teardown)
    const struct CMUnitTest tests[] = {
        TEST(numbers_and_names_are_one),
        TEST(tiles_that_are_not_there_have_no_cell),
        TEST(what_is_printed_reads_back),
        TEST(damaged_lines_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
