/* test_scene.c -- scenes are checked before they are traced, and made from
 * mappings; stretch is known for known shapes. */
#include "render/distortion.h"
#include "render/mapped_scene.h"
#include "scenes.h"

#include <stdlib.h>

static void
what_cannot_be_traced_is_refused(void **state)
{
    static const int32_t beyond[] = {0, 1, 2, 4};
    static const int32_t before[] = {0, 1, 2, -1};
    static const int32_t two[] = {0, 2};
    static const int32_t texture[] = {3};
    float points[12], uvs[8];
    otx_run *run = test_run_create();
    otx_scene scene;

    (void)state;
    scene = scene_quad(NULL);
    assert_int_equal(otx_scene_validate(run, &scene), OSDTEX_OK);
    scene.face_verts = beyond;
    assert_int_equal(otx_scene_validate(run, &scene), OSDTEX_ERROR_ARGUMENT);
    scene.face_verts = before;
    assert_int_equal(otx_scene_validate(run, &scene), OSDTEX_ERROR_ARGUMENT);
    scene = scene_quad(NULL);
    scene.face_first = two;
    assert_int_equal(otx_scene_validate(run, &scene), OSDTEX_ERROR_ARGUMENT);
    scene = scene_quad(NULL);
    scene.face_texture = texture;
    assert_int_equal(otx_scene_validate(run, &scene), OSDTEX_ERROR_ARGUMENT);
    scene = scene_quad(NULL);
    memcpy(points, QUAD_POINTS, sizeof points);
    points[4] = NAN;
    scene.points = points;
    assert_int_equal(otx_scene_validate(run, &scene), OSDTEX_ERROR_NUMERIC);
    scene = scene_quad(NULL);
    memcpy(uvs, QUAD_UVS, sizeof uvs);
    uvs[7] = INFINITY;
    scene.uvs = uvs;
    assert_int_equal(otx_scene_validate(run, &scene), OSDTEX_ERROR_NUMERIC);
    test_run_destroy(run);
}

static void
bounds_hold_what_is_drawn(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 16);
    uint8_t *hole = OTX_ZNEW(run->arena, uint8_t, scene.face_count);
    otx_vec3 centre;
    double radius;

    (void)state;
    otx_scene_bounds(&scene, &centre, &radius);
    assert_true(otx_vec3_length(centre) < 1e-6 && fabs(radius - 1.0) < 1e-6);
    /* Without its upper half, the sphere has its middle lower. */
    memset(hole + scene.face_count / 2, 1, (size_t)scene.face_count / 2);
    scene.face_hole = hole;
    otx_scene_bounds(&scene, &centre, &radius);
    assert_true(fabs(centre.y + 0.5) < 1e-6);
    assert_true(fabs(radius - sqrt(1.25)) < 1e-6);
    test_run_destroy(run);
}

static void
smooth_normals_of_a_sphere_point_outwards(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 24);

    (void)state;
    assert_int_equal(otx_scene_smooth(run, &scene), OSDTEX_OK);
    /* The vertices at the poles see one triangle each. */
    for (int32_t v = 48; v < scene.vert_count - 48; ++v)
    {
        const otx_vec3 n = otx_vec3_load(scene.vert_normals, v);
        const otx_vec3 p = otx_vec3_load(scene.points, v);

        assert_true(otx_vec3_dot(n, p) > 0.99);
    }
    test_run_destroy(run);
}

static void
stretch_is_one_for_what_is_flat(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_quad(NULL);
    float uvs[8];
    const float *stretch;
    int64_t flipped;

    (void)state;
    /* Two scene units to one of UV. */
    otx_distortion_faces(
        run, run->arena, &scene, &(otx_vec2){2.0, 2.0}, &stretch);
    assert_true(fabsf(stretch[0] - 1.0f) < 1e-6f);
    otx_distortion_faces(run, run->arena, &scene, NULL, &stretch);
    assert_true(fabsf(stretch[0] - 1.0f) < 1e-6f);
    /* Half as wide in UV: dp/ds is 2, dp/dt 1. */
    for (int32_t i = 0; i < 8; ++i)
        uvs[i] = QUAD_UVS[i] * (i % 2 ? 1.0f : 0.5f);
    scene.uvs = uvs;
    otx_distortion_faces(
        run, run->arena, &scene, &(otx_vec2){2.0, 2.0}, &stretch);
    assert_true(fabsf(stretch[0] - sqrtf(2.5f)) < 1e-6f);
    assert_true(
        fabs(otx_distortion_mean(&scene, stretch, &flipped) - sqrt(2.5)) <
        1e-6);
    assert_int_equal(flipped, 0);
    /* Mirrored. */
    for (int32_t i = 0; i < 8; i += 2)
        uvs[i] = -uvs[i];
    otx_distortion_faces(
        run, run->arena, &scene, &(otx_vec2){2.0, 2.0}, &stretch);
    assert_true(isinf(stretch[0]));
    otx_distortion_mean(&scene, stretch, &flipped);
    assert_int_equal(flipped, 1);
    test_run_destroy(run);
}

static void
a_mapping_is_shown_as_it_is(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene quad = scene_quad(NULL);
    int32_t patch[] = {7};
    float normals[12] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    const otx_level leaf = {
        .face_count = 1,
        .vert_count = 4,
        .corner_count = 4,
        .face_first = quad.face_first,
        .face_verts = quad.face_verts,
    };
    const otx_surface surface = {
        .level_count = 1,
        .levels = &leaf,
        .points = quad.points,
        .normals = normals,
    };
    float uvs[8];
    const otx_mapping mapping = {
        .surface = &surface,
        .scale = 4.0,
        .uvs = uvs,
        .face_patch = patch,
        .patch_count = 8,
    };
    otx_exemplar exemplar = {.wrap_y = true};
    otx_scene scene;

    (void)state;
    /* The square of side 2 takes half the width of a picture that is twice as
     * wide as high, and all of its height. */
    otx_image_create(run, run->arena, 8, 4, 3, &exemplar.linear);
    exemplar.match = exemplar.linear;
    for (int32_t i = 0; i < 8; ++i)
        uvs[i] = QUAD_UVS[i] * (i % 2 ? 1.0f : 0.5f);
    assert_int_equal(
        otx_scene_from_mapping(run, &mapping, &exemplar, &scene), OSDTEX_OK);
    assert_ptr_equal(scene.uvs, uvs);
    assert_int_equal(scene.face_patch[0], 7);
    assert_true(fabsf(scene.face_stretch[0] - 1.0f) < 1e-6f);
    assert_true(!scene.textures[0].wrap_x && scene.textures[0].wrap_y);
    test_run_destroy(run);
}

/* Fails the allocation that `left` counts down to. */
typedef struct failing
{
    int64_t left;
} failing;

static void *
failing_alloc(void *user, size_t bytes)
{
    failing *f = user;

    return f->left > 0 && --f->left == 0 ? NULL : malloc(bytes);
}

static void
failing_release(void *user, void *block, size_t bytes)
{
    (void)user;
    (void)bytes;
    free(block);
}

static void
running_out_of_memory_leaks_nothing(void **state)
{
    bool failed = true;

    (void)state;
    for (int64_t k = 1; failed; ++k)
    {
        failing f = {0};
        const otx_allocator_hooks hooks = {
            failing_alloc, failing_release, &f, 0};
        otx_run *run = test_run_create_with(&hooks, 2);
        const otx_scene_texture texture = texture_of(run, 256, true);
        otx_scene scene = scene_sphere(run, 32);
        otx_render_options options = otx_render_defaults();
        otx_image image;
        otx_status status;

        scene.texture_count = 1;
        scene.textures = &texture;
        options.show = OTX_SHOW_SEAMS;
        options.width = options.height = 40;
        options.samples = 1;
        f.left = k;
        status = otx_render(run, &scene, &options, &image);
        failed = status == OSDTEX_ERROR_MEMORY;
        assert_true(failed || status == OSDTEX_OK);
        assert_true(k > 1 || failed);
        assert_int_equal(image.pixels == NULL, failed);
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_cannot_be_traced_is_refused),
        cmocka_unit_test(bounds_hold_what_is_drawn),
        cmocka_unit_test(smooth_normals_of_a_sphere_point_outwards),
        cmocka_unit_test(stretch_is_one_for_what_is_flat),
        cmocka_unit_test(a_mapping_is_shown_as_it_is),
        cmocka_unit_test(running_out_of_memory_leaks_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
