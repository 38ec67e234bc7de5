/* test_pyramid.c -- mip levels: sizes, means and symmetry. */
#include "support.h"

#include "base/random.h"
#include "image/pyramid.h"

static const int32_t sizes[][2] = {
    {1, 1}, {2, 2}, {3, 3}, {64, 64}, {65, 63}, {300, 1}, {7, 130}};

enum
{
    SIZE_COUNT = sizeof sizes / sizeof *sizes
};

static otx_image
noise(otx_run *run, int32_t width, int32_t height)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, 3, &image), OSDTEX_OK);
    for (int32_t i = 0; i < width * height * 3; ++i)
        image.pixels[i] = (float)otx_random_unit(1, 0, (uint64_t)i);
    return image;
}

static double
mean(const otx_image *image, int32_t channel)
{
    const int32_t count = image->width * image->height;
    double sum = 0.0;

    for (int32_t i = 0; i < count; ++i)
        sum += image->pixels[i * image->channels + channel];
    return sum / count;
}

static void
test_sizes_round_down(void **state)
{
    (void)state;
    assert_int_equal(otx_pyramid_count(1, 1), 1);
    assert_int_equal(otx_pyramid_count(2, 1), 2);
    assert_int_equal(otx_pyramid_count(300, 200), 9);
    assert_int_equal(
        otx_pyramid_count(OTX_IMAGE_MAX_SIDE, 1), OTX_PYRAMID_MAX_LEVELS);
    assert_int_equal(otx_pyramid_side(300, 3), 37);
    assert_int_equal(otx_pyramid_side(3, 5), 1);
}

/* True areas: no texel is lost or counted twice. */
static void
test_every_level_has_the_mean_of_the_picture(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    for (int s = 0; s < SIZE_COUNT; ++s)
    {
        const otx_image image = noise(run, sizes[s][0], sizes[s][1]);
        otx_pyramid pyramid;

        assert_int_equal(
            otx_pyramid_build(run, run->arena, &image, &pyramid), OSDTEX_OK);
        for (int32_t l = 0; l < pyramid.count; ++l)
        {
            assert_int_equal(
                pyramid.levels[l].width, otx_pyramid_side(image.width, l));
            assert_int_equal(
                pyramid.levels[l].height, otx_pyramid_side(image.height, l));
            for (int32_t c = 0; c < 3; ++c)
                assert_float_equal(
                    mean(&pyramid.levels[l], c), mean(&image, c), 1e-6);
        }
        assert_int_equal(pyramid.levels[pyramid.count - 1].width, 1);
        assert_int_equal(pyramid.levels[pyramid.count - 1].height, 1);
    }
    test_run_destroy(run);
}

static otx_image
turned(otx_run *run, const otx_image *image)
{
    otx_image out;

    assert_int_equal(
        otx_image_create(run, run->arena, image->width, image->height, 3, &out),
        OSDTEX_OK);
    for (int32_t y = 0; y < image->height; ++y)
        for (int32_t x = 0; x < image->width; ++x)
            memcpy(
                otx_image_at(&out, x, y),
                otx_image_at(
                    image, image->width - 1 - x, image->height - 1 - y),
                3 * sizeof(float));
    return out;
}

/* Odd sizes do not shift the picture to one side. */
static void
test_reduction_commutes_with_a_half_turn(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    for (int s = 0; s < SIZE_COUNT; ++s)
    {
        const otx_image image = noise(run, sizes[s][0], sizes[s][1]);
        const otx_image back = turned(run, &image);
        otx_image a, b;

        assert_int_equal(
            otx_pyramid_reduce(run, run->arena, &image, &a), OSDTEX_OK);
        assert_int_equal(
            otx_pyramid_reduce(run, run->arena, &back, &b), OSDTEX_OK);
        b = turned(run, &b);
        for (int32_t i = 0; i < a.width * a.height * 3; ++i)
            assert_float_equal(a.pixels[i], b.pixels[i], 1e-6);
    }
    test_run_destroy(run);
}

static void
test_even_sizes_are_halved(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = noise(run, 32, 16);
    otx_image reduced, halved;

    (void)state;
    assert_int_equal(
        otx_pyramid_reduce(run, run->arena, &image, &reduced), OSDTEX_OK);
    assert_int_equal(
        otx_image_halve(run, run->arena, &image, &halved), OSDTEX_OK);
    for (int32_t i = 0; i < 16 * 8 * 3; ++i)
        assert_float_equal(reduced.pixels[i], halved.pixels[i], 1e-7);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes_round_down),
        cmocka_unit_test(test_every_level_has_the_mean_of_the_picture),
        cmocka_unit_test(test_reduction_commutes_with_a_half_turn),
        cmocka_unit_test(test_even_sizes_are_halved),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
