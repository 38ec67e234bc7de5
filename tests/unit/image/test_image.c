/* test_image.c -- limits and halving of pictures. */
#include "support.h"

#include "image/image.h"

/* A picture whose values all differ. */
static otx_image
numbered(otx_run *run, int32_t width, int32_t height, int32_t channels)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, channels, &image),
        OSDTEX_OK);
    for (int32_t i = 0; i < width * height * channels; ++i)
        image.pixels[i] = (float)(i % 251) * 0.25f;
    return image;
}

static void
test_limits_are_kept(void **state)
{
    otx_run *run = test_run_create();
    otx_image image;

    (void)state;
    assert_int_equal(
        otx_image_create(run, run->arena, 0, 1, 3, &image), OSDTEX_ERROR_LIMIT);
    assert_int_equal(
        otx_image_create(run, run->arena, OTX_IMAGE_MAX_SIDE + 1, 1, 3, &image),
        OSDTEX_ERROR_LIMIT);
    assert_int_equal(
        otx_image_create(
            run, run->arena, 1, 1, OTX_IMAGE_MAX_CHANNELS + 1, &image),
        OSDTEX_ERROR_LIMIT);
    assert_null(image.pixels);
    assert_int_equal(
        otx_image_create(run, run->arena, OTX_IMAGE_MAX_SIDE, 1, 1, &image),
        OSDTEX_OK);
    test_run_destroy(run);
}

static void
test_memory_limit_is_an_error(void **state)
{
    const otx_allocator_hooks hooks = {.limit_bytes = 8u << 20};
    otx_run *run = test_run_create_with(&hooks, 1);
    otx_image image;

    (void)state;
    assert_int_equal(
        otx_image_create(run, run->arena, 4096, 4096, 4, &image),
        OSDTEX_ERROR_MEMORY);
    assert_null(image.pixels);
    test_run_destroy(run);
}

static void
test_halves_are_means(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = numbered(run, 5, 4, 2);
    otx_image half;

    (void)state;
    assert_int_equal(
        otx_image_halve(run, run->arena, &image, &half), OSDTEX_OK);
    assert_int_equal(half.width, 3);
    assert_int_equal(half.height, 2);
    assert_float_equal(
        otx_image_at(&half, 1, 1)[1],
        0.25 * (otx_image_at(&image, 2, 2)[1] + otx_image_at(&image, 3, 2)[1] +
                otx_image_at(&image, 2, 3)[1] + otx_image_at(&image, 3, 3)[1]),
        0.0);
    /* The odd column is averaged over what is there. */
    assert_float_equal(
        otx_image_at(&half, 2, 0)[0],
        0.5 * (otx_image_at(&image, 4, 0)[0] + otx_image_at(&image, 4, 1)[0]),
        0.0);
    test_run_destroy(run);
}

static void
test_halving_ends_at_one_texel(void **state)
{
    otx_run *run = test_run_create();
    otx_image image = numbered(run, 1000, 3, 3);

    (void)state;
    for (int i = 0; i < 12; ++i)
        assert_int_equal(
            otx_image_halve(run, run->arena, &image, &image), OSDTEX_OK);
    assert_int_equal(image.width, 1);
    assert_int_equal(image.height, 1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_limits_are_kept),
        cmocka_unit_test(test_memory_limit_is_an_error),
        cmocka_unit_test(test_halves_are_means),
        cmocka_unit_test(test_halving_ends_at_one_texel),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
