/* test_shade.c -- textures, seams and light, where they can be told by hand. */
#include "looks.h"

#include "image/view.h"

static void
magnified_texels_are_bilinear(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene_texture texture = texture_of(run, 8, true);
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 96);
    const otx_scene scene = scene_quad(&texture);

    (void)state;
    for (int32_t y = 0; y < 8; ++y)
        for (int32_t x = 0; x < 8; ++x)
            paint(&texture.image, x, y, (float)((x + y) % 2), x / 8.0f, 0.5f);
    options.samples = 1;

    const otx_image image = render(run, &scene, &options);

    for (int32_t y = 0; y < 96; ++y)
        for (int32_t x = 0; x < 96; ++x)
        {
            const otx_vec2 texel = {(x + 0.5) / 12.0, (y + 0.5) / 12.0};
            const float *pixel = otx_image_at(&image, x, y);
            float expected[3];

            otx_view_value(
                otx_view_of(&texture.image, true, true), texel, expected);
            for (int32_t c = 0; c < 3; ++c)
                assert_true(fabsf(pixel[c] - expected[c]) < 1e-4f);
            assert_true(pixel[3] == 1.0f);
        }
    test_run_destroy(run);
}

static void
minified_checker_is_its_mean(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene_texture texture = texture_of(run, 256, true);
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 17);
    const otx_scene scene = scene_quad(&texture);

    (void)state;
    for (int32_t y = 0; y < 256; ++y)
        for (int32_t x = 0; x < 256; ++x)
            paint(
                &texture.image, x, y, (float)((x + y) % 2), 0.25f,
                (float)(x % 2));
    /* One sample to 15.06 texels a side would alias without filtering. */
    options.samples = 1;

    const otx_image image = render(run, &scene, &options);

    for (int32_t y = 0; y < 17; ++y)
        for (int32_t x = 0; x < 17; ++x)
        {
            const float *pixel = otx_image_at(&image, x, y);

            assert_true(fabsf(pixel[0] - 0.5f) < 1e-4f);
            assert_true(fabsf(pixel[1] - 0.25f) < 1e-4f);
            assert_true(fabsf(pixel[2] - 0.5f) < 1e-4f);
        }
    test_run_destroy(run);
}

static void
colour_is_associated_with_alpha(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene_texture texture = texture_of(run, 2, false);
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 40);
    const otx_scene scene = scene_quad(&texture);
    otx_camera wide = camera;
    bool partial = false;

    (void)state;
    for (int32_t i = 0; i < 4; ++i)
        paint(&texture.image, i % 2, i / 2, 0.8f, 0.4f, 0.2f);
    wide.fov = 1.31 * camera.fov;
    options.camera = &wide;

    const otx_image image = render(run, &scene, &options);

    for (int32_t i = 0; i < 40 * 40; ++i)
    {
        const float *p = image.pixels + 4 * (size_t)i;

        partial = partial || (p[3] > 0.0f && p[3] < 1.0f);
        assert_true(fabsf(p[0] - 0.8f * p[3]) < 1e-5f);
        assert_true(fabsf(p[2] - 0.2f * p[3]) < 1e-5f);
    }
    assert_true(partial);
    assert_true(otx_image_at(&image, 0, 0)[3] == 0.0f);

    options.transparent = false;

    const otx_image walled = render(run, &scene, &options);

    assert_true(fabs(sum_of_alpha(&walled) - 1600.0) < 1e-6);
    test_run_destroy(run);
}

static void
seams_are_as_wide_as_asked(void **state)
{
    static const float points[] = {
        -1, -1, 0, 0, -1, 0, 1, -1, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0};
    static const int32_t first[] = {0, 4, 8};
    static const int32_t verts[] = {0, 1, 4, 3, 1, 2, 5, 4};
    static const int32_t patches[] = {0, 1};
    otx_run *run = test_run_create();
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 64);
    otx_scene scene = {
        .vert_count = 6,
        .face_count = 2,
        .corner_count = 8,
        .points = points,
        .face_first = first,
        .face_verts = verts,
        .face_patch = patches,
    };
    double dark = 0.0;

    (void)state;
    options.show = OTX_SHOW_SEAMS;
    options.seam_width = 6.0;
    options.samples = 8;

    const otx_image image = render(run, &scene, &options);
    const float pale = otx_image_at(&image, 10, 32)[0];

    for (int32_t x = 0; x < 64; ++x)
        dark += 1.0 - otx_image_at(&image, x, 32)[0] / pale;
    assert_true(fabs(dark - 6.0) < 0.3);
    test_run_destroy(run);
}

static void
light_is_neither_dark_nor_blown(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 32);
    otx_render_options options = otx_render_defaults();
    double sum = 0.0;

    (void)state;
    assert_int_equal(otx_scene_smooth(run, &scene), OSDTEX_OK);
    options.width = options.height = 64;
    options.transparent = true;
    options.show = OTX_SHOW_FLAT;

    const otx_image image = render(run, &scene, &options);

    for (int32_t i = 0; i < 64 * 64; ++i)
    {
        sum += image.pixels[4 * i];
        assert_true(image.pixels[4 * i] < 0.8f);
    }
    sum /= sum_of_alpha(&image);
    assert_true(sum > 0.25 && sum < 0.55);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(magnified_texels_are_bilinear),
        cmocka_unit_test(minified_checker_is_its_mean),
        cmocka_unit_test(colour_is_associated_with_alpha),
        cmocka_unit_test(seams_are_as_wide_as_asked),
        cmocka_unit_test(light_is_neither_dark_nor_blown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
