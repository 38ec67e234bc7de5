/* test_view.c -- values, slopes and lines; inside, across and beyond borders.
 */
#include "grid.h"

#include "image/view.h"

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
centres_are_exact(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = numbered(run, 7, 5, 3);

    (void)state;
    for (int32_t y = 0; y < 5; ++y)
        for (int32_t x = 0; x < 7; ++x)
            for (int wrap = 0; wrap < 2; ++wrap)
            {
                float color[3];

                otx_view_value(
                    otx_view_of(&image, wrap, wrap),
                    (otx_vec2){x + 0.5, y + 0.5}, color);
                assert_memory_equal(
                    color, otx_image_at(&image, x, y), sizeof color);
            }
    test_run_destroy(run);
}

static void
a_wrapped_view_is_periodic(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = numbered(run, 8, 4, 3);

    (void)state;
    for (int i = 0; i < 100; ++i)
    {
        const otx_vec2 at = {i * 0.125, i * 0.0625};
        const otx_vec2 far_away = {at.x - 16.0, at.y + 400.0};
        float a[3], b[3];

        otx_view_value(otx_view_of(&image, true, true), at, a);
        otx_view_value(otx_view_of(&image, true, true), far_away, b);
        assert_memory_equal(a, b, sizeof a);
    }
    test_run_destroy(run);
}

static void
its_border_mixes_both_ends(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = numbered(run, 8, 1, 1);
    float seam;

    (void)state;
    otx_view_value(
        otx_view_of(&image, true, false), (otx_vec2){0.0, 0.5}, &seam);
    assert_float_equal(seam, 0.5 * (image.pixels[0] + image.pixels[7]), 0.0);
    test_run_destroy(run);
}

static void
a_held_view_stays_on_the_rim(void **state)
{
    otx_run *run = test_run_create();
    const otx_image image = numbered(run, 6, 3, 1);
    float color;

    (void)state;
    otx_view_value(
        otx_view_of(&image, false, false), (otx_vec2){-100.0, 1.5}, &color);
    assert_float_equal(color, *otx_image_at(&image, 0, 1), 0.0);
    otx_view_value(
        otx_view_of(&image, false, false), (otx_vec2){1e30, 1e30}, &color);
    assert_float_equal(color, *otx_image_at(&image, 5, 2), 0.0);
    test_run_destroy(run);
}

static void
a_constant_is_itself_anywhere(void **state)
{
    const double strange[] = {0.0, -0.3, 5.7, 1e300, -1e300, NAN, INFINITY};
    otx_run *run = test_run_create();
    otx_image image;

    (void)state;
    assert_int_equal(
        otx_image_create(run, run->arena, 5, 3, 1, &image), OSDTEX_OK);
    for (int i = 0; i < 15; ++i)
        image.pixels[i] = 0.1f;
    for (size_t i = 0; i < 7; ++i)
        for (int wrap = 0; wrap < 2; ++wrap)
        {
            float color;

            otx_view_value(
                otx_view_of(&image, wrap, wrap),
                (otx_vec2){strange[i], strange[6 - i]}, &color);
            assert_float_equal(color, 0.1f, 0.0);
        }
    test_run_destroy(run);
}

/* Also across the border of a picture that tiles; beyond one that does not,
 * nothing changes. */
static void
slopes_are_those_of_values(void **state)
{
    const double step = 1e-3;
    otx_run *run = test_run_create();
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 16, 12, true, 2);

    (void)state;
    for (uint64_t i = 0; i < 400; ++i)
    {
        const otx_image_view view =
            otx_view_of(&exemplar->match, i % 2 == 0, i % 3 == 0);
        /* Away from texel centres, where the slope jumps. */
        const otx_vec2 at = {
            floor(60.0 * otx_random_unit(1, 1, 2 * i) - 20.0) + 0.8,
            floor(60.0 * otx_random_unit(1, 1, 2 * i + 1) - 20.0) + 0.7};
        double color[3], right[3], above[3];
        otx_vec2 slope[3], none[3];
        float value[3];

        otx_view_slope(view, at, color, slope);
        otx_view_slope(view, (otx_vec2){at.x + step, at.y}, right, none);
        otx_view_slope(view, (otx_vec2){at.x, at.y + step}, above, none);
        otx_view_value(view, at, value);
        for (int c = 0; c < 3; ++c)
        {
            assert_float_equal(color[c], value[c], 1e-5);
            assert_float_equal(slope[c].x, (right[c] - color[c]) / step, 1e-6);
            assert_float_equal(slope[c].y, (above[c] - color[c]) / step, 1e-6);
        }
    }
    test_run_destroy(run);
}

/* The quick path inside the picture, the wrapping and the clamping one all
 * equal single lookups. */
static void
a_line_is_single_lookups(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 16, 12, true, 2);
    const otx_image *image = &exemplar->lab;

    (void)state;
    for (uint64_t i = 0; i < 400; ++i)
    {
        otx_vec2 side[2];
        float colors[3 * 5], expected[3];
        const bool wrap = i % 2 == 0;

        for (uint64_t k = 0; k < 2; ++k)
            side[k] = (otx_vec2){
                60.0 * otx_random_unit(1, 1, 4 * i + k) - 20.0,
                60.0 * otx_random_unit(1, 1, 4 * i + k + 2) - 20.0};
        if (i % 5 == 0)
            side[1] = otx_vec2_lerp(side[0], side[1], 0.02);
        otx_view_line(otx_view_of(image, wrap, wrap), side, 0.0, 5, colors);
        for (int k = 0; k < 5; ++k)
        {
            otx_view_value(
                otx_view_of(image, wrap, wrap),
                otx_vec2_lerp(side[0], side[1], (k + 0.5) / 5), expected);
            for (int c = 0; c < 3; ++c)
                assert_float_equal(colors[3 * k + c], expected[c], 1e-3);
        }
    }
    test_run_destroy(run);
}

static void
an_offset_lies_to_the_left(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar *exemplar = test_exemplar_create(run->arena, 8, 8, false, 2);
    const otx_vec2 side[2] = {{2.0, 3.0}, {6.0, 3.0}};
    float colors[3];

    (void)state;
    for (int32_t i = 0; i < 64; ++i)
        exemplar->lab.pixels[3 * i] = (float)(i / 8 + 0.5);
    otx_view_line(
        otx_view_of(&exemplar->lab, false, false), side, 1.25, 1, colors);
    assert_float_equal(colors[0], 4.25, 1e-5);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(centres_are_exact),
        cmocka_unit_test(a_wrapped_view_is_periodic),
        cmocka_unit_test(its_border_mixes_both_ends),
        cmocka_unit_test(a_held_view_stays_on_the_rim),
        cmocka_unit_test(a_constant_is_itself_anywhere),
        cmocka_unit_test(slopes_are_those_of_values),
        cmocka_unit_test(a_line_is_single_lookups),
        cmocka_unit_test(an_offset_lies_to_the_left),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
