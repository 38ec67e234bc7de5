/* test_toroid.c -- pictures that are made to tile. */
#include "support.h"

#include "base/random.h"
#include "quilt/oddness.h"
#include "quilt/toroid.h"

#include <math.h>

/* A picture whose linear, match and Lab texels are the same; texel (x, y) is
 * f(x, y). */
static otx_exemplar
picture(
    otx_run *run, int32_t width, int32_t height,
    float (*f)(int32_t x, int32_t y))
{
    otx_exemplar e = {0};

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, 3, &e.lab), OSDTEX_OK);
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
        {
            float *texel = otx_image_at(&e.lab, x, y);

            texel[0] = f(x, y);
            texel[1] = texel[2] = 0.0f;
        }
    e.linear = e.match = e.lab;
    return e;
}

static double
knot(int32_t x, int32_t y)
{
    return otx_random_unit(7, 0, (uint64_t)(x + 1000 * y));
}

/* Blurs of random height. */
static float
noise(int32_t x, int32_t y)
{
    const double u = x % 6 / 6.0, v = y % 6 / 6.0;
    const int32_t i = x / 6, j = y / 6;

    return (
        float)(100.0 * ((1.0 - u) * (1.0 - v) * knot(i, j) + u * (1.0 - v) * knot(i + 1, j) + (1.0 - u) * v * knot(i, j + 1) + u * v * knot(i + 1, j + 1)));
}

static float
slope(int32_t x, int32_t y)
{
    (void)y;
    return (float)x;
}

/* Columns of period 12 that a width of 100 cuts off. */
static float
stripes(int32_t x, int32_t y)
{
    (void)y;
    return 50.0f + 50.0f * (float)sin(x * 2.0 * 3.14159265358979 / 12.0);
}

static int32_t
at(const otx_texel_map *map, int32_t x, int32_t y)
{
    return otx_texel_map_at(
        map, (x + map->width) % map->width, (y + map->height) % map->height);
}

/* The border is nowhere as it was, and texels far from it are where they were.
 */
static void
test_covers_the_border(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = picture(run, 120, 90, noise);
    otx_toroid t;

    (void)state;
    assert_int_equal(otx_toroid_make(run, &e, &t), OSDTEX_OK);
    assert_int_equal(t.map.width, 120);
    assert_int_equal(t.map.height, 90);
    for (int32_t y = 0; y < 90; ++y)
        assert_false(
            at(&t.map, 119, y) == y * 120 + 119 && at(&t.map, 0, y) == y * 120);
    for (int32_t x = 0; x < 120; ++x)
        assert_false(
            at(&t.map, x, 89) == 89 * 120 + x && at(&t.map, x, 0) == x);
    for (int32_t y = 14; y < 76; ++y)
        for (int32_t x = 14; x < 106; ++x)
            assert_int_equal(at(&t.map, x, y), y * 120 + x);
    for (int32_t i = 0; i < 120 * 90; ++i)
        assert_in_range(t.map.texels[i], 0, 120 * 90 - 1);
    assert_true(t.oddness > 0.0 && t.oddness < 1.1);
    test_run_destroy(run);
}

/* An axis along which the picture tiles is left alone. */
static void
test_one_axis(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar e = picture(run, 96, 96, noise);
    otx_toroid t;

    (void)state;
    e.wrap_y = true;
    assert_int_equal(otx_toroid_make(run, &e, &t), OSDTEX_OK);
    for (int32_t x = 14; x < 82; ++x)
        for (int32_t y = 0; y < 96; ++y)
            assert_int_equal(at(&t.map, x, y), y * 96 + x);
    test_run_destroy(run);
}

/* What cannot be mended is called odd. */
static void
test_judges(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar e = picture(run, 100, 100, slope);
    otx_toroid t;

    (void)state;
    e.wrap_y = true;
    assert_int_equal(otx_toroid_make(run, &e, &t), OSDTEX_OK);
    assert_true(t.oddness > 2.0);
    test_run_destroy(run);
}

/* A whole number of periods has no cut that shows, another one does. */
static void
test_no_cuts_no_oddness(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = picture(run, 96, 96, stripes);
    otx_texel_pool pool;
    otx_texel_map map;
    double odd = -1.0;

    (void)state;
    assert_int_equal(
        otx_texel_pool_create(run, run->arena, &e, &e.lab, 0, &pool),
        OSDTEX_OK);
    assert_int_equal(
        otx_texel_map_create(run, run->arena, 96, 96, &map), OSDTEX_OK);
    for (int32_t i = 0; i < 96 * 96; ++i)
        map.texels[i] = i;
    assert_int_equal(otx_oddness_measure(run, &pool, &map, &odd), OSDTEX_OK);
    assert_true(odd < 1.1);
    test_run_destroy(run);
}

static void
test_too_small(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = picture(run, 64, 31, noise);
    otx_toroid t;

    (void)state;
    assert_int_equal(otx_toroid_make(run, &e, &t), OSDTEX_ERROR_LIMIT);
    assert_non_null(strstr(test_last_message(run), "too small"));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_covers_the_border),
        cmocka_unit_test(test_one_axis), cmocka_unit_test(test_judges),
        cmocka_unit_test(test_no_cuts_no_oddness),
        cmocka_unit_test(test_too_small)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
