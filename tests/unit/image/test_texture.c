/* test_texture.c -- the filter has the width of the footprint, both ways. */
#include "image/texture.h"
#include "support.h"

static const otx_vec2 NOTHING = {0.0, 0.0};

/* `size` squared with three channels, uninitialised. */
static otx_image
picture_of(otx_run *run, int32_t size)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, size, size, 3, &image), OSDTEX_OK);
    return image;
}

static void
paint(const otx_image *image, int32_t x, int32_t y, float r, float g, float b)
{
    float *p = otx_image_at(image, x, y);

    p[0] = r;
    p[1] = g;
    p[2] = b;
}

/* Stripes one texel wide that vary along x only, and a ramp along y. */
static otx_texture
striped_texture(otx_run *run, int32_t size)
{
    const otx_image source = picture_of(run, size);
    otx_texture texture;

    for (int32_t y = 0; y < size; ++y)
        for (int32_t x = 0; x < size; ++x)
            paint(
                &source, x, y, (float)(x % 2), (float)(y % 2),
                (float)x / (float)size);
    assert_int_equal(
        otx_texture_create(run, run->arena, &source, true, true, &texture),
        OSDTEX_OK);
    return texture;
}

static void
a_long_footprint_blurs_one_way_only(void **state)
{
    otx_run *run = test_run_create();
    const otx_texture texture = striped_texture(run, 64);
    const otx_vec2 along_y = {0.0, 12.0 / 64.0};
    const otx_vec2 across = {0.5 / 64.0, 0.0};
    float rgb[3];

    (void)state;
    for (int32_t x = 0; x < 64; ++x)
    {
        const otx_vec2 uv = {(x + 0.5) / 64.0, 0.5};

        otx_texture_filter(&texture, uv, across, along_y, rgb);
        assert_true(fabsf(rgb[0] - (float)(x % 2)) < 1e-5f);
        assert_true(fabsf(rgb[1] - 0.5f) < 0.05f);
        /* The order of the axes does not matter. */
        otx_texture_filter(&texture, uv, along_y, across, rgb);
        assert_true(fabsf(rgb[0] - (float)(x % 2)) < 1e-5f);
    }
    test_run_destroy(run);
}

static void
a_slanted_footprint_is_followed(void **state)
{
    otx_run *run = test_run_create();
    const otx_image source = picture_of(run, 64);
    const double side = sqrt(0.5) / 64.0;
    const otx_vec2 down_the_slope = {10.0 * side, -10.0 * side};
    const otx_vec2 across = {0.6 * side, 0.6 * side};
    otx_texture texture;
    float rgb[3];

    (void)state;
    /* Diagonal stripes eight texels wide: x + y is constant along them. */
    for (int32_t y = 0; y < 64; ++y)
        for (int32_t x = 0; x < 64; ++x)
            paint(&source, x, y, (float)((x + y) / 8 % 2), 0.0f, 0.0f);
    otx_texture_create(run, run->arena, &source, true, true, &texture);
    otx_texture_filter(
        &texture, (otx_vec2){0.5 + 1.0 / 64, 0.5 + 1.0 / 64}, across,
        down_the_slope, rgb);
    assert_true(rgb[0] < 0.01f);
    otx_texture_filter(
        &texture, (otx_vec2){0.5 + 5.0 / 64, 0.5 + 5.0 / 64}, across,
        down_the_slope, rgb);
    assert_true(rgb[0] > 0.99f);
    test_run_destroy(run);
}

static void
wide_footprints_end_at_the_mean(void **state)
{
    otx_run *run = test_run_create();
    const otx_texture texture = striped_texture(run, 64);
    const double sizes[] = {1.0, 1e3, 1e30, 1e300, INFINITY};
    float rgb[3];

    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
    {
        otx_texture_filter(
            &texture, (otx_vec2){0.3, 0.4}, (otx_vec2){sizes[i], 0.0},
            (otx_vec2){0.0, sizes[i]}, rgb);
        assert_true(isfinite(rgb[0]) && rgb[0] >= 0.0f && rgb[0] <= 1.0f);
        if (sizes[i] < 1e100)
            assert_true(fabsf(rgb[0] - 0.5f) < 1e-5f);
    }
    test_run_destroy(run);
}

static void
any_finite_uv_is_in_the_picture(void **state)
{
    static const double places[] = {-1e-20, -3.25, 1.0, 1e9, -1e38, 1e38};
    otx_run *run = test_run_create();
    otx_texture texture = striped_texture(run, 64);
    float rgb[3], moved[3];

    (void)state;
    for (int32_t wrap = 0; wrap < 2; ++wrap)
    {
        texture.wrap_x = texture.wrap_y = wrap;
        for (size_t i = 0; i < sizeof places / sizeof *places; ++i)
        {
            const otx_vec2 uv = {places[i], -places[i]};

            otx_texture_filter(&texture, uv, NOTHING, NOTHING, rgb);
            for (int32_t c = 0; c < 3; ++c)
                assert_true(rgb[c] >= 0.0f && rgb[c] <= 1.0f);
        }
    }
    otx_texture_filter(&texture, (otx_vec2){0.37, 0.21}, NOTHING, NOTHING, rgb);
    otx_texture_filter(
        &texture, (otx_vec2){-2.63, 5.21}, NOTHING, NOTHING, moved);
    for (int32_t c = 0; c < 3; ++c)
        assert_true(fabsf(rgb[c] - moved[c]) < 1e-5f);
    test_run_destroy(run);
}

static void
grey_pictures_are_spread(void **state)
{
    otx_run *run = test_run_create();
    float pixels[4] = {0.25f, 0.25f, 0.25f, 0.25f};
    const otx_image source = {2, 2, 1, pixels};
    otx_texture texture;
    float rgb[3];

    (void)state;
    otx_texture_create(run, run->arena, &source, false, false, &texture);
    otx_texture_filter(&texture, (otx_vec2){0.5, 0.5}, NOTHING, NOTHING, rgb);
    assert_true(rgb[0] == 0.25f && rgb[1] == 0.25f && rgb[2] == 0.25f);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_long_footprint_blurs_one_way_only),
        cmocka_unit_test(a_slanted_footprint_is_followed),
        cmocka_unit_test(wide_footprints_end_at_the_mean),
        cmocka_unit_test(any_finite_uv_is_in_the_picture),
        cmocka_unit_test(grey_pictures_are_spread),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
