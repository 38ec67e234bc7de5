/* test_worst_seam.c -- close views of seams. */
#include "render/worst_seam.h"
#include "scenes.h"

static const double ORIGIN[3] = {1e4, 0.0, 0.0};

static void
names_have_a_rank(void **state)
{
    (void)state;
    assert_int_equal(otx_worst_seam_rank("seam1"), 1);
    assert_int_equal(otx_worst_seam_rank("seam99"), 99);
    assert_int_equal(otx_worst_seam_rank("seam"), 0);
    assert_int_equal(otx_worst_seam_rank("seam0"), 0);
    assert_int_equal(otx_worst_seam_rank("seam100"), 0);
    assert_int_equal(otx_worst_seam_rank("seam1x"), 0);
    assert_int_equal(otx_worst_seam_rank("seams"), 0);
    assert_int_equal(otx_worst_seam_rank("front"), 0);
}

/* The sphere's UVs jump from u = 1 to 0 at the meridian in front. A picture
 * that grows brighter to the right shows it. */
static void
the_eye_is_before_the_seam(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 32);
    otx_scene_texture texture = texture_of(run, 4, false);
    otx_camera first, second;

    (void)state;
    for (int32_t y = 0; y < 4; ++y)
        for (int32_t x = 0; x < 4; ++x)
            for (int32_t k = 0; k < texture.image.channels; ++k)
                otx_image_at(&texture.image, x, y)[k] = 0.25f * (float)x;
    scene.texture_count = 1;
    scene.textures = &texture;
    assert_int_equal(
        otx_worst_seam_camera(run, &scene, 1, ORIGIN, &first), OSDTEX_OK);
    assert_non_null(strstr(test_last_message(run), "seam1 is around (1e+04,"));
    assert_non_null(strstr(test_last_message(run), "differ by 0.87"));
    assert_int_equal(
        otx_worst_seam_camera(run, &scene, 2, ORIGIN, &second), OSDTEX_OK);
    assert_true(fabs(first.target.x) < 1e-6 && first.target.z > 0.0);
    assert_true(fabs(second.target.x) < 1e-6 && second.target.z > 0.0);
    assert_true(
        otx_vec3_length(otx_vec3_sub(first.target, second.target)) > 0.1);
    assert_true(otx_vec3_length(first.eye) > otx_vec3_length(first.target));
    assert_true(otx_camera_is_valid(&first));
    test_run_destroy(run);
}

static void
without_seams_there_is_nothing_to_see(void **state)
{
    otx_run *run = test_run_create();
    otx_scene_texture texture = texture_of(run, 4, false);
    otx_scene scene = scene_quad(&texture);
    otx_camera camera;

    (void)state;
    assert_int_equal(
        otx_worst_seam_camera(run, &scene, 1, ORIGIN, &camera),
        OSDTEX_ERROR_ARGUMENT);
    scene = scene_quad(NULL);
    assert_int_equal(
        otx_worst_seam_camera(run, &scene, 1, ORIGIN, &camera),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_have_a_rank),
        cmocka_unit_test(the_eye_is_before_the_seam),
        cmocka_unit_test(without_seams_there_is_nothing_to_see),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
