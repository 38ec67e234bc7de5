/* test_render.c -- pictures of shapes whose pictures are known. */
#include "looks.h"

static void
a_sphere_covers_its_silhouette(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_sphere(run, 48);
    const double distance = 4.0;
    /* The cone that touches a unit sphere, on a picture at distance 1. */
    const double rim = 1.0 / sqrt(distance * distance - 1.0);
    const otx_camera camera = {
        {0.0, 0.0, distance},
        {0.0, 0.0, 0.0},
        2.0 * atan(1.25 * rim),
        0.0,
        OTX_UP_Y};
    otx_render_options options = facing_options(&camera, 160);
    const double radius = 80.0 / 1.25;
    const otx_image image = render(run, &scene, &options);

    (void)state;
    assert_true(
        fabs(sum_of_alpha(&image) / (OTX_PI * radius * radius) - 1.0) < 0.01);
    test_run_destroy(run);
}

/* A square half way to what is looked at. */
static void
what_is_clipped_is_looked_through(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    otx_camera camera = {
        {0.0, 0.0, 4.0}, {0.0, 0.0, -4.0}, OTX_CAMERA_FOV, 0.49, OTX_UP_Y};
    const otx_render_options options = facing_options(&camera, 32);
    otx_image image = render(run, &scene, &options);

    (void)state;
    assert_true(sum_of_alpha(&image) > 0.8 * 32 * 32);
    camera.clip = 0.51;
    image = render(run, &scene, &options);
    assert_true(sum_of_alpha(&image) == 0.0);
    test_run_destroy(run);
}

static void
every_view_frames_the_model(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_sphere(run, 24);

    (void)state;
    for (int32_t view = 0; view < OTX_VIEW_COUNT; ++view)
    {
        otx_render_options options = otx_render_defaults();

        options.width = view % 2 ? 96 : 48;
        options.height = view % 2 ? 48 : 96;
        options.transparent = true;
        options.view = (otx_view)view;

        const otx_image image = render(run, &scene, &options);
        const double area = OTX_PI * 24.0 * 24.0;

        assert_true(fabs(sum_of_alpha(&image) / area - 0.92) < 0.05);
        /* Nothing touches the border. */
        for (int32_t x = 0; x < image.width; ++x)
        {
            assert_true(otx_image_at(&image, x, 0)[3] == 0.0f);
            assert_true(otx_image_at(&image, x, image.height - 1)[3] == 0.0f);
        }
    }
    test_run_destroy(run);
}

/* Stripes as wide as a pixel. Samples that were each filtered over the whole
 * pixel would blur them twice, to 0.75. */
static void
samples_share_the_pixel(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene_texture texture = texture_of(run, 64, true);
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 32);
    const otx_scene scene = scene_quad(&texture);

    (void)state;
    for (int32_t i = 0; i < 64 * 64; ++i)
        paint(
            &texture.image, i % 64, i / 64, (float)(i % 64 / 2 % 2), 0.0f,
            0.0f);

    options.samples = 8;

    const otx_image image = render(run, &scene, &options);

    for (int32_t x = 0; x < 32; ++x)
    {
        const float red = otx_image_at(&image, x, 16)[0];

        assert_true(fabsf(red - (x % 2 ? 0.875f : 0.125f)) < 0.03f);
    }
    test_run_destroy(run);
}

static void
the_top_row_of_the_picture_is_up(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene_texture texture = texture_of(run, 8, false);
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 64);
    const otx_scene scene = scene_quad(&texture);

    (void)state;
    for (int32_t i = 0; i < 8; ++i)
    {
        paint(&texture.image, i, 7, 1.0f, 0.0f, 0.0f);
        if (i < 7)
            paint(&texture.image, 7, i, 0.0f, 0.0f, 1.0f);
    }

    const otx_image image = render(run, &scene, &options);
    const float *top = otx_image_at(&image, 20, 62);
    const float *bottom = otx_image_at(&image, 20, 2);
    const float *right = otx_image_at(&image, 62, 20);

    assert_true(top[0] > 0.99f && top[2] == 0.0f);
    assert_true(bottom[0] == 0.0f && bottom[2] == 0.0f);
    assert_true(right[0] == 0.0f && right[2] > 0.99f);
    test_run_destroy(run);
}

static void
threads_do_not_change_a_bit(void **state)
{
    static const int32_t threads[] = {1, 2, 8};
    otx_run *keep = test_run_create();
    otx_image first = {0};

    (void)state;
    for (int32_t show = 0; show < OTX_SHOW_COUNT; ++show)
        for (size_t i = 0; i < 3; ++i)
        {
            otx_run *run = test_run_create_with(NULL, threads[i]);
            otx_scene scene = scene_sphere(run, 12);
            const otx_scene_texture texture = texture_of(run, 16, true);
            otx_render_options options = otx_render_defaults();
            const otx_overlay_line line = {
                0, {{0, -1, 0}, {0.1, -0.9, 0.1}}, {0, 1}};
            const otx_overlay_dot dot = {{0, 0, 1}, 1};
            const otx_overlay overlay = {1, 1, &line, &dot, 0.1, 0.3, 0.0};

            options.overlay = &overlay;
            for (int32_t k = 0; k < 256; ++k)
                paint(
                    &texture.image, k % 16, k / 16, (float)(k % 3), 0.5f,
                    (float)(k % 7));
            scene.texture_count = 1;
            scene.textures = &texture;
            options.width = 100;
            options.height = 70;
            options.samples = 2;
            options.show = (otx_show)show;

            const otx_image image = render(run, &scene, &options);

            if (i == 0)
                otx_image_create(keep, keep->arena, 100, 70, 4, &first);
            if (i == 0)
                memcpy(first.pixels, image.pixels, 100 * 70 * 16);
            assert_memory_equal(first.pixels, image.pixels, 100 * 70 * 16);
            test_run_destroy(run);
        }
    test_run_destroy(keep);
}

static void
expect_argument_error(
    otx_run *run, const otx_scene *scene, const otx_render_options *options)
{
    otx_image out;

    assert_int_equal(
        otx_render(run, scene, options, &out), OSDTEX_ERROR_ARGUMENT);
    assert_null(out.pixels);
}

static void
bad_options_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    const otx_scene empty = {0};
    const otx_camera blind = {{1, 2, 3}, {1, 2, 3}, 1.0, 0.0, OTX_UP_Y};
    otx_render_options options = otx_render_defaults();

    (void)state;
    options.width = options.height = 8;
    expect_argument_error(run, &empty, &options);
    options.width = 0;
    expect_argument_error(run, &scene, &options);
    options.width = 8;
    options.samples = 17;
    expect_argument_error(run, &scene, &options);
    options.samples = 1;
    options.turn = NAN;
    expect_argument_error(run, &scene, &options);
    options.turn = 0.0;
    options.camera = &blind;
    expect_argument_error(run, &scene, &options);
    test_run_destroy(run);
}

static bool
stop_half_way(void *user, const char *stage, double fraction)
{
    (void)user;
    (void)stage;
    return fraction < 0.5;
}

static void
a_picture_can_be_stopped(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    otx_render_options options = otx_render_defaults();
    otx_image out;

    (void)state;
    options.width = options.height = 128;
    run->progress = stop_half_way;
    assert_int_equal(
        otx_render(run, &scene, &options, &out), OSDTEX_ERROR_CANCELLED);
    assert_null(out.pixels);
    test_run_destroy(run);
}

static void
names_are_found_again(void **state)
{
    otx_show show;

    (void)state;
    for (int32_t i = 0; i < OTX_SHOW_COUNT; ++i)
    {
        assert_true(
            otx_render_show_find(otx_render_show_name((otx_show)i), &show));
        assert_int_equal(show, i);
    }
    assert_false(otx_render_show_find("Texture", &show));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_covers_its_silhouette),
        cmocka_unit_test(what_is_clipped_is_looked_through),
        cmocka_unit_test(every_view_frames_the_model),
        cmocka_unit_test(samples_share_the_pixel),
        cmocka_unit_test(the_top_row_of_the_picture_is_up),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(a_picture_can_be_stopped),
        cmocka_unit_test(names_are_found_again),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
