/* test_render.c -- pictures of shapes whose pictures are known. */
#include "image/view.h"
#include "scenes.h"

static otx_image
render(otx_run *run, const otx_scene *scene, const otx_render_options *options)
{
    otx_image out;

    assert_int_equal(otx_render(run, scene, options, &out), OSDTEX_OK);
    assert_int_equal(out.width, options->width);
    assert_int_equal(out.height, options->height);
    assert_int_equal(out.channels, 4);
    return out;
}

static double
sum_of_alpha(const otx_image *image)
{
    double sum = 0.0;

    for (int32_t y = 0; y < image->height; ++y)
        for (int32_t x = 0; x < image->width; ++x)
            sum += otx_image_at(image, x, y)[3];
    return sum;
}

static void
a_sphere_covers_its_silhouette(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_sphere(run, 48);
    const double distance = 4.0;
    /* The cone that touches a unit sphere, on a picture at distance 1. */
    const double rim = 1.0 / sqrt(distance * distance - 1.0);
    const otx_camera camera = {
        {0.0, 0.0, distance}, {0.0, 0.0, 0.0}, 2.0 * atan(1.25 * rim), 0.0};
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
        {0.0, 0.0, 4.0}, {0.0, 0.0, -4.0}, OTX_CAMERA_FOV, 0.49};
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

/* A square as a pentagon with a corner on its side, and as two triangles. */
static void
faces_of_any_size_are_drawn(void **state)
{
    static const float points[] = {
        -1, -1, 0, 0, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const float uvs[] = {
        0, 0, 0.5, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1};
    static const int32_t pentagon[] = {0, 5};
    static const int32_t triangles[] = {0, 3, 6};
    static const int32_t verts[] = {0, 1, 2, 3, 4};
    static const int32_t pairs[] = {0, 2, 3, 0, 3, 4};
    otx_run *run = test_run_create();
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 32);
    otx_scene scene = {
        .vert_count = 5,
        .face_count = 1,
        .corner_count = 5,
        .points = points,
        .face_first = pentagon,
        .face_verts = verts,
        .uvs = uvs,
    };

    (void)state;
    options.show = OTX_SHOW_UV;
    options.samples = 1;
    for (int32_t round = 0; round < 2; ++round)
    {
        const otx_image image = render(run, &scene, &options);

        for (int32_t i = 0; i < 32 * 32; ++i)
        {
            const float *p = image.pixels + 4 * (size_t)i;

            assert_true(fabs(p[0] - (i % 32 + 0.5) / 32.0) < 1e-4);
            assert_true(fabs(p[1] - (i / 32 + 0.5) / 32.0) < 1e-4);
            assert_true(p[3] == 1.0f);
        }
        scene.face_count = 2;
        scene.corner_count = 6;
        scene.face_first = triangles;
        scene.face_verts = pairs;
        scene.uvs = uvs + 10;
    }
    test_run_destroy(run);
}

static void
both_halves_of_a_quad_interpolate_its_corners(void **state)
{
    otx_run *run = test_run_create();
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 32);
    const otx_scene scene = scene_quad(NULL);

    (void)state;
    options.show = OTX_SHOW_UV;
    options.samples = 1;

    const otx_image image = render(run, &scene, &options);

    for (int32_t i = 0; i < 32 * 32; ++i)
    {
        const float *p = image.pixels + 4 * (size_t)i;

        assert_true(fabs(p[0] - (i % 32 + 0.5) / 32.0) < 1e-4);
        assert_true(fabs(p[1] - (i / 32 + 0.5) / 32.0) < 1e-4);
    }
    test_run_destroy(run);
}

static void
holes_are_not_drawn(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 16);
    uint8_t *hole = OTX_ZNEW(run->arena, uint8_t, scene.face_count);
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 64);

    (void)state;
    /* The front half, so that the back is seen from inside. */
    for (int32_t f = 0; f < scene.face_count; ++f)
        hole[f] = (f % 32) < 8 || (f % 32) >= 24;
    scene.face_hole = hole;
    options.unlit = false;
    options.show = OTX_SHOW_NORMALS;

    const otx_image image = render(run, &scene, &options);
    const float *middle = otx_image_at(&image, 32, 32);

    assert_true(middle[3] == 1.0f && middle[2] < 0.1f);
    memset(hole, 1, (size_t)scene.face_count);
    otx_image none;

    assert_int_equal(
        otx_render(run, &scene, &options, &none), OSDTEX_ERROR_ARGUMENT);
    assert_null(none.pixels);
    assert_non_null(strstr(test_last_message(run), "no face to draw"));
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
the_place_of_a_model_does_not_matter(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_sphere(run, 12);
    otx_scene moved = scene;
    float *points = OTX_NEW(run->arena, float, 3 * (size_t)scene.vert_count);
    otx_render_options options = otx_render_defaults();
    double difference = 0.0;

    (void)state;
    /* Exact in floats, so that only the renderer could tell. */
    for (int32_t i = 0; i < 3 * scene.vert_count; ++i)
        points[i] = scene.points[i] * 0x1p-60f;
    moved.points = points;
    options.width = 64;
    options.height = 48;
    options.show = OTX_SHOW_FLAT;

    const otx_image a = render(run, &scene, &options);
    const otx_image b = render(run, &moved, &options);

    for (int32_t i = 0; i < 64 * 48 * 4; ++i)
        difference = fmax(difference, fabs(a.pixels[i] - b.pixels[i]));
    assert_true(difference < 1e-3);
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
    const otx_camera blind = {{1, 2, 3}, {1, 2, 3}, 1.0, 0.0};
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
        cmocka_unit_test(magnified_texels_are_bilinear),
        cmocka_unit_test(minified_checker_is_its_mean),
        cmocka_unit_test(samples_share_the_pixel),
        cmocka_unit_test(the_top_row_of_the_picture_is_up),
        cmocka_unit_test(colour_is_associated_with_alpha),
        cmocka_unit_test(faces_of_any_size_are_drawn),
        cmocka_unit_test(both_halves_of_a_quad_interpolate_its_corners),
        cmocka_unit_test(holes_are_not_drawn),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(the_place_of_a_model_does_not_matter),
        cmocka_unit_test(seams_are_as_wide_as_asked),
        cmocka_unit_test(light_is_neither_dark_nor_blown),
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(a_picture_can_be_stopped),
        cmocka_unit_test(names_are_found_again),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
