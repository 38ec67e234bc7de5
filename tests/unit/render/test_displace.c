/* test_displace.c -- a mesh goes where its map of heights says, and a picture
 * of a material where its normals say. */
#include "render/displace.h"
#include "render/mapped_scene.h"
#include "render/render.h"
#include "unit/bake/flat.h"

enum
{
    N = 2,
    TEXELS = 64
};

/* Heights that rise along u by `range`, and normals that all are `normal`, on
 * a grey picture. */
static otx_exemplar *
ramp(otx_run *run, const float normal[3], double range)
{
    otx_exemplar *exemplar = flat_exemplar(run, TEXELS, 3);

    for (int32_t i = 0; i < 3 * TEXELS * TEXELS; ++i)
        exemplar->linear.pixels[i] = 0.5f;
    flat_add_ramp(run, TEXELS, normal, range, exemplar);
    return exemplar;
}

static otx_scene
scene_of(otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar)
{
    otx_scene scene;

    assert_int_equal(
        otx_scene_from_mapping(
            run, flat_mapping(run, surface, N), exemplar, &scene),
        OSDTEX_OK);
    assert_non_null(scene.maps);
    return scene;
}

/* UV is (.25 + .5 x / N, ...), and the texture has its nominal size. */
static void
heights_are_in_scene_units(void **state)
{
    static const float up[3] = {0.0f, 0.0f, 1.0f};
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 3);
    const otx_scene scene = scene_of(run, surface, ramp(run, up, 2.0));
    otx_scene moved;

    (void)state;
    assert_int_equal(otx_scene_displace(run, &scene, &moved), OSDTEX_OK);
    for (int32_t v = 0; v < scene.vert_count; ++v)
    {
        const float *p = scene.points + 3 * v, *q = moved.points + 3 * v;

        assert_float_equal(q[0], p[0], 1e-5);
        assert_float_equal(q[1], p[1], 1e-5);
        /* At the border what the edge is filtered over is on one side. */
        assert_float_equal(
            q[2] - p[2], 2.0 * (0.25 + 0.5 * p[0] / N - 0.5), 1e-3);
    }
    test_run_destroy(run);
}

static void
without_heights_nothing_moves(void **state)
{
    static const float up[3] = {0.0f, 0.0f, 1.0f};
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 1);
    otx_exemplar *exemplar = ramp(run, up, 2.0);
    otx_scene scene, moved;

    (void)state;
    exemplar->companions.maps[OTX_COMPANION_HEIGHT].is_there = false;
    scene = scene_of(run, surface, exemplar);
    assert_int_equal(otx_scene_displace(run, &scene, &moved), OSDTEX_OK);
    assert_ptr_equal(moved.points, scene.points);
    test_run_destroy(run);
}

/* Mean of the middle of a picture of the sheet from the front. */
static double
brightness(otx_run *run, const float normal[3], bool plain)
{
    const otx_surface *surface = flat_surface(run, N, 1);
    const otx_scene scene = scene_of(run, surface, ramp(run, normal, 0.0));
    otx_render_options how = otx_render_defaults();
    otx_image image;
    double sum = 0.0;

    how.width = how.height = 32;
    how.samples = 2;
    how.view = OTX_VIEW_FRONT;
    how.plain = plain;
    how.no_shadows = true;
    assert_int_equal(otx_render(run, &scene, &how, &image), OSDTEX_OK);
    for (int32_t y = 12; y < 20; ++y)
        for (int32_t x = 12; x < 20; ++x)
            sum += (double)otx_image_at(&image, x, y)[1] / 64.0;
    return sum;
}

/* The key is to the upper left of the camera. */
static void
normals_face_the_light_or_do_not(void **state)
{
    static const float up[3] = {0.0f, 0.0f, 1.0f};
    static const float to_key[3] = {-0.3f, 0.4f, 0.866f};
    static const float away[3] = {0.3f, -0.4f, 0.866f};
    otx_run *run = test_run_create();
    const double flat = brightness(run, up, false);

    (void)state;
    assert_true(brightness(run, to_key, false) > 1.05 * flat);
    assert_true(brightness(run, away, false) < 0.85 * flat);
    assert_true(
        fabs(brightness(run, to_key, true) - brightness(run, away, true)) <
        1e-6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heights_are_in_scene_units),
        cmocka_unit_test(without_heights_nothing_moves),
        cmocka_unit_test(normals_face_the_light_or_do_not),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
