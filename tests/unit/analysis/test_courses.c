/* test_courses.c -- courses are found where they are, and nowhere else. */
#include "analysis/courses.h"
#include "support.h"

#include "base/random.h"
#include "image/view.h"

#include <math.h>

enum
{
    SIDE = 192,
    HEIGHT = 24
};

static double
noise(int32_t x, int32_t y)
{
    return otx_random_unit(3, 0, (uint64_t)(y * SIDE + x));
}

/* Joints of 4 texels, the middle of the first at y = 7. */
static double
bricks(int32_t x, int32_t y)
{
    const int32_t course = (y + HEIGHT - 5) / HEIGHT;
    const bool bed = (y + HEIGHT - 5) % HEIGHT < 4;
    const bool head = (x + 32 * (course % 2)) % 64 < 4;

    return (bed || head ? 20.0 : 60.0) + 10.0 * noise(x, y);
}

static otx_image
paint(otx_run *run, double (*f)(int32_t, int32_t), bool upright)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &image), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
            for (int k = 0; k < 3; ++k)
                otx_image_at(&image, x, y)[k] =
                    (float)(upright ? f(y, SIDE - 1 - x) : f(x, y));
    return image;
}

static void
finds_courses_both_ways(void **state)
{
    (void)state;
    for (int upright = 0; upright < 2; ++upright)
    {
        otx_run *run = test_run_create();
        const otx_image image = paint(run, bricks, upright == 1);
        otx_courses c;

        assert_int_equal(otx_courses_find(run, &image, &c), OSDTEX_OK);
        assert_int_equal(c.count, SIDE / HEIGHT);
        assert_int_equal(c.upright, upright == 1);
        assert_true(otx_courses_are_plain(&c));
        for (int32_t k = 0; k < c.count; ++k)
        {
            const double d = (c.joints[k] - 7.0) / HEIGHT;

            assert_true(fabs(d - round(d)) < 0.1);
            assert_true(c.joints[k] < c.joints[k + 1]);
        }
        assert_true(fabs(c.joints[c.count] - c.joints[0] - SIDE) < 1e-9);
        test_run_destroy(run);
    }
}

/* A course's middle is light, whichever way it runs, and a picture on too. */
static void
texels_lie_in_their_course(void **state)
{
    (void)state;
    for (int upright = 0; upright < 2; ++upright)
    {
        otx_run *run = test_run_create();
        const otx_image image = paint(run, bricks, upright == 1);
        otx_courses c;

        assert_int_equal(otx_courses_find(run, &image, &c), OSDTEX_OK);
        for (int32_t k = -c.count; k < 2 * c.count; ++k)
        {
            float joint[3], middle[3];
            double sums[2] = {0, 0};

            for (double along = 0.5; along < SIDE; along += 1.0)
            {
                otx_view_value(
                    otx_view_of(&image, true, true),
                    otx_courses_texel(&c, along, k), joint);
                otx_view_value(
                    otx_view_of(&image, true, true),
                    otx_courses_texel(&c, along, k + 0.5), middle);
                sums[0] += (double)joint[0] / SIDE;
                sums[1] += (double)middle[0] / SIDE;
            }
            assert_true(sums[0] < 30.0 && sums[1] > 55.0);
        }
        test_run_destroy(run);
    }
}

static void
noise_has_none(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = paint(run, noise, false);
    otx_courses c;

    (void)state;
    assert_int_equal(otx_courses_find(run, &image, &c), OSDTEX_OK);
    assert_false(otx_courses_are_plain(&c));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_courses_both_ways),
        cmocka_unit_test(texels_lie_in_their_course),
        cmocka_unit_test(noise_has_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
