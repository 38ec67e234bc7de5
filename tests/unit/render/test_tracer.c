/* test_tracer.c -- what a ray meets, and where on it. */
#include "looks.h"

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

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_of_any_size_are_drawn),
        cmocka_unit_test(both_halves_of_a_quad_interpolate_its_corners),
        cmocka_unit_test(holes_are_not_drawn),
        cmocka_unit_test(the_place_of_a_model_does_not_matter),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
