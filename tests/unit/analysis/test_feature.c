/* test_feature.c -- things between joints, and cut out by an alpha. */
#include "grid.h"

#include "analysis/feature.h"

enum
{
    SIDE = 96,
    STONES = 4 /* along a side */
};

/* Squares of lightness 70 with joints of 20 between them, and noise. */
static otx_exemplar *
wall(otx_arena *arena, bool wraps, bool alpha)
{
    otx_exemplar *e = test_exemplar_create(arena, SIDE, SIDE, wraps, 3);
    const int32_t step = SIDE / STONES;

    if (alpha)
    {
        e->linear.channels = 4;
        e->linear.pixels = OTX_ZNEW(arena, float, 4 * SIDE * SIDE);
    }
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const bool joint = x % step < 5 || y % step < 5;
            float *lab = otx_image_at(&e->lab, x, y);

            lab[0] =
                (joint ? 20.0f : 70.0f) +
                4.0f * (float)otx_random_unit(1, 2, (uint64_t)(y * SIDE + x));
            lab[1] = lab[2] = 0.0f;
            if (alpha)
                otx_image_at(&e->linear, x, y)[3] = joint ? 0.0f : 1.0f;
        }
    return e;
}

static void
check_stones(const otx_features *f, int32_t whole)
{
    const double step = (double)SIDE / STONES;
    int32_t count = 0;

    assert_int_equal(f->count, STONES * STONES);
    for (int32_t i = 0; i < f->count; ++i)
    {
        assert_float_equal(f->list[i].area, 19.0 * 19.0, 60.0);
        assert_float_equal(fmod(f->list[i].middle.x, step), 14.5, 1.0);
        assert_float_equal(fmod(f->list[i].middle.y, step), 14.5, 1.0);
        assert_int_equal(otx_features_at(f, f->list[i].middle), i + 1);
        count += f->list[i].whole;
    }
    assert_int_equal(count, whole);
    assert_int_equal(otx_features_at(f, (otx_vec2){2.0, 2.0}), 0);
    assert_true(otx_features_are_clear(f));
}

static void
joints_part_stones(void **state)
{
    otx_run *run = *state;
    otx_features f;

    assert_int_equal(
        otx_features_find(run, wall(run->arena, true, false), &f), OSDTEX_OK);
    assert_false(f.by_alpha);
    assert_true(f.network > 0.9);
    check_stones(&f, STONES * STONES);
}

/* Without wrapping the last row and column end at the border. */
static void
the_border_cuts_what_it_meets(void **state)
{
    otx_run *run = *state;
    otx_features f;

    assert_int_equal(
        otx_features_find(run, wall(run->arena, false, false), &f), OSDTEX_OK);
    check_stones(&f, (STONES - 1) * (STONES - 1));
    assert_int_equal(otx_features_at(&f, (otx_vec2){-1.0, 20.0}), 0);
}

static void
an_alpha_parts_what_it_cuts_out(void **state)
{
    otx_run *run = *state;
    otx_features f;

    assert_int_equal(
        otx_features_find(run, wall(run->arena, true, true), &f), OSDTEX_OK);
    assert_true(f.by_alpha);
    check_stones(&f, STONES * STONES);
}

static void
one_colour_shows_nothing(void **state)
{
    otx_run *run = *state;
    otx_exemplar *e = test_exemplar_create(run->arena, SIDE, SIDE, true, 3);
    otx_features f;

    for (int32_t i = 0; i < 3 * SIDE * SIDE; ++i)
        e->lab.pixels[i] = 50.0f;
    assert_int_equal(otx_features_find(run, e, &f), OSDTEX_OK);
    assert_false(otx_features_are_clear(&f));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(joints_part_stones),
        test_with_run(the_border_cuts_what_it_meets),
        test_with_run(an_alpha_parts_what_it_cuts_out),
        test_with_run(one_colour_shows_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
