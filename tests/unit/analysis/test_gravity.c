/* test_gravity.c -- walls and shingles have a top, grain and gravel have none.
 */
#include "support.h"

#include "analysis/gravity.h"
#include "base/random.h"

enum
{
    SIDE = 256
};

typedef double (*pattern_fn)(double x, double y);

/* Bricks of 64 x 32 with joints of 3, every other course moved by half. */
static double
bricks(double x, double y)
{
    const int32_t course = (int32_t)(y / 32.0);
    const double along = fmod(x + (course % 2 ? 32.0 : 0.0), 64.0);

    return fmod(y, 32.0) < 3.0 || along < 3.0
               ? 20.0
               : 50.0 +
                     10.0 * otx_random_unit(
                                1, (uint64_t)course,
                                (uint64_t)((x + (course % 2 ? 32 : 0)) / 64.0));
}

static double
turned_bricks(double x, double y)
{
    return bricks(y, x);
}

/* Rows of a grain along x. */
static double
grain(double x, double y)
{
    (void)x;
    return 50.0 + 20.0 * sin(0.7 * y) + 10.0 * sin(0.31 * y);
}

static double
gravel(double x, double y)
{
    return 50.0 +
           40.0 * otx_random_unit(2, (uint64_t)(x / 6.0), (uint64_t)(y / 6.0));
}

static double
weave(double x, double y)
{
    const bool over = ((int)(x / 16.0) + (int)(y / 16.0)) % 2 == 0;
    const double at = fmod(over ? x : y, 16.0) / 16.0;

    return 30.0 + 40.0 * sin(OTX_PI * at);
}

/* Each brightens downwards and ends in a dark edge, in rows of 20, moved. */
static double
shingles(double x, double y)
{
    const int32_t row = (int32_t)(y / 20.0);
    const double middle = fmod(x + 7.0 * row, 24.0) - 12.0;
    const double at = fmod(y + 0.03 * middle * middle, 20.0) / 20.0;

    return 30.0 + 40.0 * at;
}

static otx_gravity
measure(pattern_fn pattern)
{
    otx_run *run = test_run_create();
    otx_image lab;
    otx_square square;
    otx_gravity out;

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &lab), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            float *p = otx_image_at(&lab, x, y);

            p[0] = (float)pattern(x, y);
            p[1] = p[2] = 0.0f;
        }
    assert_int_equal(otx_square_cut(run, &lab, &square), OSDTEX_OK);
    assert_int_equal(otx_gravity_measure(&square, &out), OSDTEX_OK);
    test_run_destroy(run);
    return out;
}

static void
walls_and_shingles_have_a_top(void **state)
{
    (void)state;
    assert_true(measure(bricks).upright);
    assert_true(measure(shingles).upright);
}

static void
grain_gravel_and_weaves_have_none(void **state)
{
    (void)state;
    assert_false(measure(grain).upright);
    assert_false(measure(gravel).upright);
    assert_false(measure(weave).upright);
    assert_false(measure(turned_bricks).upright);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_and_shingles_have_a_top),
        cmocka_unit_test(grain_gravel_and_weaves_have_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
