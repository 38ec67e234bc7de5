/* test_oddness.c -- what cuts show that the picture does not. */
#include "support.h"

#include "quilt/oddness.h"

enum
{
    COURSE = 24, /* texels from joint to joint */
    JOINT = 3,
    HEIGHT = 8 * COURSE,
    WIDE = 128,
    NARROW = 92 /* less than three windows at a quarter of the size */
};

/* Courses: rows of light stone and dark joints. */
static otx_exemplar
courses(otx_run *run, int32_t width)
{
    otx_exemplar e = {0};

    assert_int_equal(
        otx_image_create(run, run->arena, width, HEIGHT, 3, &e.lab), OSDTEX_OK);
    for (int32_t y = 0; y < HEIGHT; ++y)
        for (int32_t x = 0; x < width; ++x)
            otx_image_at(&e.lab, x, y)[0] = y % COURSE < JOINT ? 20.0f : 80.0f;
    e.linear = e.match = e.lab;
    return e;
}

/* The oddness of a picture that shows row `row(y)` of the courses as row y. */
static double
oddness(int32_t width, int32_t (*row)(int32_t y))
{
    otx_run *run = test_run_create();
    const otx_exemplar e = courses(run, width);
    otx_texel_pool pool;
    otx_texel_map map;
    double odd = -1.0;

    assert_int_equal(
        otx_texel_pool_create(run, run->arena, &e, &e.lab, 0, &pool),
        OSDTEX_OK);
    assert_int_equal(
        otx_texel_map_create(run, run->arena, width, HEIGHT, &map), OSDTEX_OK);
    for (int32_t y = 0; y < HEIGHT; ++y)
        for (int32_t x = 0; x < width; ++x)
            map.texels[y * width + x] = row(y) * width + x;
    assert_int_equal(otx_oddness_measure(run, &pool, &map, &odd), OSDTEX_OK);
    test_run_destroy(run);
    return odd;
}

static int32_t
as_it_is(int32_t y)
{
    return y;
}

/* One course is there twice. */
static int32_t
repeated(int32_t y)
{
    return y < 3 * COURSE + 19 ? y : y - COURSE;
}

/* Two courses are half as high again, cut where stone meets stone: little
 * windows find the like of it everywhere. */
static int32_t
higher(int32_t y)
{
    return y < 2 * COURSE + 19  ? y
           : y < 5 * COURSE + 7 ? y - COURSE / 2
                                : y - COURSE;
}

/* Joints end at a cut in the middle of stone: it becomes a course by itself. */
static int32_t
lower(int32_t y)
{
    return y < 2 * COURSE + 10 ? y : (y + COURSE / 2) % HEIGHT;
}

static void
what_goes_on_is_not_odd(void **state)
{
    (void)state;
    assert_true(oddness(WIDE, as_it_is) < 1.0);
    assert_true(oddness(WIDE, repeated) < 1.0);
}

static void
courses_that_break_are_seen_at_a_quarter_of_the_size(void **state)
{
    (void)state;
    assert_true(oddness(WIDE, higher) > 2.0);
    /* At full and half the size nothing is to be seen of it. */
    assert_true(oddness(NARROW, higher) < 1.0);
}

static void
joints_that_come_too_close_are_seen_at_half_the_size(void **state)
{
    (void)state;
    assert_true(oddness(NARROW, lower) > 2.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_goes_on_is_not_odd),
        cmocka_unit_test(courses_that_break_are_seen_at_a_quarter_of_the_size),
        cmocka_unit_test(joints_that_come_too_close_are_seen_at_half_the_size),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
