/* test_outline.c -- packed stones are deep, mortar is not; between sparse spots
 * lies the ground. */
#include "grid.h"

#include "analysis/outline.h"

enum
{
    SIDE = 128,
    CELL = 32
};

/* How far texel (x, y) is from the middle of its cell, along the axis in which
 * that is more. */
static double
from_middle(int32_t x, int32_t y)
{
    return fmax(
        fabs(x % CELL + 0.5 - CELL / 2), fabs(y % CELL + 0.5 - CELL / 2));
}

/* Squares of half the side `reach` in every cell, of one colour on another,
 * with a little of a pattern. */
static otx_exemplar *
squares(otx_run *run, double reach, double contrast)
{
    otx_exemplar *e = test_exemplar_create(run->arena, SIDE, SIDE, true, 1);

    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
            for (int k = 0; k < 3; ++k)
                otx_image_at(&e->lab, x, y)[k] =
                    (float)(from_middle(x, y) < reach ? contrast : 0.0);
    return e;
}

static void
stones_are_deep_and_mortar_is_not(void **state)
{
    otx_run *run = test_run_create();
    otx_image out;

    (void)state;
    assert_int_equal(
        otx_outline_find(run, squares(run, 15.0, 50.0), &out), OSDTEX_OK);
    assert_int_equal(out.channels, 1);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const float depth = *otx_image_at(&out, x, y);

            if (from_middle(x, y) < 8.0)
                assert_true(depth == 1.0f);
            if (from_middle(x, y) > 14.0)
                assert_true(depth < 0.5f);
        }
    test_run_destroy(run);
}

static void
between_spots_lies_the_ground(void **state)
{
    otx_run *run = test_run_create();
    otx_image out;

    (void)state;
    assert_int_equal(
        otx_outline_find(run, squares(run, 6.0, 50.0), &out), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const float depth = *otx_image_at(&out, x, y);

            if (from_middle(x, y) < 6.0)
                assert_true(depth == 1.0f);
            if (from_middle(x, y) > 12.0)
                assert_true(depth == 0.0f);
        }
    test_run_destroy(run);
}

static void
what_has_no_outlines_can_be_cut_anywhere(void **state)
{
    otx_run *run = test_run_create();
    otx_image out;

    (void)state;
    assert_int_equal(
        otx_outline_find(run, squares(run, 14.0, 0.0), &out), OSDTEX_OK);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        assert_true(out.pixels[i] == 0.0f);
    test_run_destroy(run);
}

/* Large pictures are looked at small, and are left as they are. */
static void
the_size_of_a_picture_does_not_matter(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar *e =
        test_exemplar_create(run->arena, 700, 350, false, 1);
    const float first = e->lab.pixels[0];
    otx_image out;

    (void)state;
    assert_int_equal(otx_outline_find(run, e, &out), OSDTEX_OK);
    assert_int_equal(out.width, 175);
    assert_int_equal(out.height, 88);
    assert_true(e->lab.pixels[0] == first);
    for (int32_t i = 0; i < out.width * out.height; ++i)
        assert_true(out.pixels[i] >= 0.0f && out.pixels[i] <= 1.0f);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stones_are_deep_and_mortar_is_not),
        cmocka_unit_test(between_spots_lies_the_ground),
        cmocka_unit_test(what_has_no_outlines_can_be_cut_anywhere),
        cmocka_unit_test(the_size_of_a_picture_does_not_matter),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
