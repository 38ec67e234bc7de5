/* test_edges.c -- edge strength: slopes, turns, rims. */
#include "support.h"

#include "analysis/edges.h"
#include "base/random.h"

#include <math.h>

static otx_image
blank(otx_run *run, int32_t width, int32_t height, int32_t channels)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, channels, &image),
        OSDTEX_OK);
    return image;
}

static otx_image
noise(otx_run *run, int32_t width, int32_t height)
{
    const otx_image image = blank(run, width, height, 3);

    for (int32_t i = 0; i < width * height * 3; ++i)
        image.pixels[i] = (float)otx_random_unit(1, 0, (uint64_t)i);
    return image;
}

/* The texel (x, y) of `from` is put to (u, v). */
static void
put(const otx_image *from, int32_t x, int32_t y, const otx_image *to, int32_t u,
    int32_t v)
{
    memcpy(otx_image_at(to, u, v), otx_image_at(from, x, y), 3 * sizeof(float));
}

static otx_edges
find(otx_run *run, const otx_image *image, bool wrap)
{
    otx_edges edges;

    assert_int_equal(
        otx_edges_find(run, run->arena, image, wrap, wrap, &edges), OSDTEX_OK);
    return edges;
}

/* All channels count: slopes (2, 0) and (1, -2) make 3 together. */
static void
test_a_slope_has_its_length(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = blank(run, 9, 7, 2);

    (void)state;
    for (int32_t y = 0; y < 7; ++y)
        for (int32_t x = 0; x < 9; ++x)
        {
            otx_image_at(&image, x, y)[0] = (float)(2 * x);
            otx_image_at(&image, x, y)[1] = (float)(x - 2 * y);
        }

    const otx_edges edges = find(run, &image, false);

    for (int32_t y = 1; y < 6; ++y)
        for (int32_t x = 1; x < 8; ++x)
            assert_float_equal(*otx_image_at(&edges.strength, x, y), 3.0, 1e-6);
    test_run_destroy(run);
}

static void
test_one_colour_has_no_edges(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = blank(run, 8, 8, 3);

    (void)state;
    for (int32_t i = 0; i < 8 * 8 * 3; ++i)
        image.pixels[i] = 0.7F;

    const otx_edges edges = find(run, &image, false);

    for (int32_t i = 0; i < 8 * 8; ++i)
        assert_true(edges.strength.pixels[i] == 0.0F);
    assert_true(edges.sigma == 0.0);
    test_run_destroy(run);
}

/* As the match needs it: a turned picture has the turned edges. */
static void
test_edges_turn_with_the_picture(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = noise(run, 12, 9);
    const otx_image turned = blank(run, 9, 12, 3);

    (void)state;
    for (int32_t y = 0; y < 9; ++y)
        for (int32_t x = 0; x < 12; ++x)
            put(&image, x, y, &turned, 8 - y, x);

    const otx_edges a = find(run, &image, false);
    const otx_edges b = find(run, &turned, false);

    for (int32_t y = 0; y < 9; ++y)
        for (int32_t x = 0; x < 12; ++x)
            assert_float_equal(
                *otx_image_at(&a.strength, x, y),
                *otx_image_at(&b.strength, 8 - y, x), 1e-6);
    test_run_destroy(run);
}

/* Two periods of a tiling picture have its edges twice, rim included. */
static void
test_a_tiling_picture_has_no_rim(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = noise(run, 10, 6);
    const otx_image twice = blank(run, 20, 6, 3);

    (void)state;
    for (int32_t y = 0; y < 6; ++y)
        for (int32_t x = 0; x < 20; ++x)
            put(&image, x % 10, y, &twice, x, y);

    const otx_edges a = find(run, &image, true);
    const otx_edges b = find(run, &twice, true);

    for (int32_t y = 0; y < 6; ++y)
        for (int32_t x = 0; x < 20; ++x)
            assert_true(
                *otx_image_at(&a.strength, x % 10, y) ==
                *otx_image_at(&b.strength, x, y));
    assert_float_equal(a.sigma, b.sigma, 1e-9);
    test_run_destroy(run);
}

static void
test_sigma_is_that_of_two_random_texels(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = noise(run, 7, 5);
    const otx_edges edges = find(run, &image, true);
    double sum = 0.0;

    (void)state;
    for (int32_t i = 0; i < 35; ++i)
        for (int32_t j = 0; j < 35; ++j)
            sum +=
                pow((double)edges.strength.pixels[i] -
                        (double)edges.strength.pixels[j],
                    2.0);
    assert_float_equal(edges.sigma, sqrt(sum / (35 * 35)), 1e-6);
    test_run_destroy(run);
}

static void
test_edges_follow_the_colours(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = noise(run, 8, 6);
    const otx_edges edges = find(run, &image, true);
    otx_image out;

    (void)state;
    assert_int_equal(
        otx_edges_append(run, run->arena, &image, &edges, 2.0, &out),
        OSDTEX_OK);
    assert_int_equal(out.channels, 4);
    for (int32_t i = 0; i < 8 * 6; ++i)
    {
        for (int32_t c = 0; c < 3; ++c)
            assert_true(out.pixels[4 * i + c] == image.pixels[3 * i + c]);
        assert_true(out.pixels[4 * i + 3] == 2.0F * edges.strength.pixels[i]);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_slope_has_its_length),
        cmocka_unit_test(test_one_colour_has_no_edges),
        cmocka_unit_test(test_edges_turn_with_the_picture),
        cmocka_unit_test(test_a_tiling_picture_has_no_rim),
        cmocka_unit_test(test_sigma_is_that_of_two_random_texels),
        cmocka_unit_test(test_edges_follow_the_colours),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
