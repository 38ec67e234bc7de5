/* test_light.c -- the light of previews: as much as its parts say, less what
 * the model hides, and alike in every view. */
#include "unit/render/scenes.h"

#include "render/light.h"

enum
{
    MANY = 4096
};

/* Light of a sphere's scene, or of a lone square's, from the front. */
static otx_light
light_on(otx_run *run, const otx_scene *scene, double turn, bool shadows)
{
    const otx_camera camera = {
        otx_vec3_scale(4.0, otx_camera_from(OTX_VIEW_FRONT, OTX_UP_Y, turn)),
        {0.0, 0.0, 0.0},
        OTX_CAMERA_FOV,
        0.0,
        OTX_UP_Y};
    const otx_camera_frame frame = otx_camera_aim(&camera, 64, 64);
    otx_tracer *tracer;

    assert_int_equal(otx_tracer_create(run, scene, &tracer), OSDTEX_OK);
    return otx_light_create(tracer, &frame, shadows);
}

static double
mean(const otx_light *light, otx_vec3 at, otx_vec3 normal, int32_t count)
{
    double sum = 0.0;

    for (int32_t i = 0; i < count; ++i)
        sum += otx_light_at(
            light, at, normal, normal, &(otx_light_rays){i, count, 5, NULL});
    return sum / count;
}

/* The direction of angles around Y and up. */
static otx_vec3
direction(double around, double up)
{
    return (otx_vec3){sin(around) * cos(up), sin(up), cos(around) * cos(up)};
}

/* A ball hides nothing of itself but what is behind it. */
static void
a_ball_is_lit_as_without_shadows(void **state)
{
    const otx_scene scene = scene_sphere(*state, 48);
    const otx_light with = light_on(*state, &scene, 0.0, true);
    const otx_light without = light_on(*state, &scene, 0.0, false);

    for (int i = 0; i < 24; ++i)
    {
        const otx_vec3 n = direction(0.5 * i, 1.2 * sin(1.7 * i));
        const otx_vec3 at = otx_vec3_scale(1.01, n);
        const double open = mean(&without, at, n, MANY);

        assert_float_equal(mean(&with, at, n, MANY), open, 0.01);
        assert_true(open > 0.1 && open < 1.8);
    }
}

/* Few rays come near to many. */
static void
sixteen_samples_are_enough(void **state)
{
    const otx_scene scene = scene_sphere(*state, 24);
    const otx_light light = light_on(*state, &scene, 0.0, true);

    for (int i = 0; i < 24; ++i)
    {
        const otx_vec3 n = direction(0.5 * i, 0.9 * sin(1.7 * i));
        const otx_vec3 at = otx_vec3_scale(1.01, n);

        assert_float_equal(
            mean(&light, at, n, 16), mean(&light, at, n, MANY), 0.06);
    }
}

static void
the_key_goes_with_the_camera(void **state)
{
    const otx_scene scene = scene_sphere(*state, 24);
    const otx_light front = light_on(*state, &scene, 0.0, false);

    assert_float_equal(otx_vec3_length(front.key), 1.0, 1e-9);
    /* From the upper left, towards the front. */
    assert_true(front.key.x < 0.0 && front.key.y > 0.0 && front.key.z > 0.0);
    assert_float_equal(otx_vec3_dot(front.key, front.key_x), 0.0, 1e-9);
    assert_float_equal(otx_vec3_dot(front.key, front.key_y), 0.0, 1e-9);
    assert_float_equal(
        otx_vec3_length(front.key_x), otx_vec3_length(front.key_y), 1e-9);
    for (int i = 1; i < 8; ++i)
    {
        const double turn = 0.8 * i;
        const otx_light light = light_on(*state, &scene, turn, false);
        const otx_vec3 n = direction(0.4, 0.3), m = direction(0.4 + turn, 0.3);

        assert_float_equal(
            mean(&light, m, m, MANY), mean(&front, n, n, MANY), 1e-3);
    }
}

/* Behind a square that is between it and all light a place has a fifth of the
 * sky; before it, all. */
static void
what_is_hidden_is_dark(void **state)
{
    const otx_scene scene = scene_quad(NULL);
    const otx_light light = light_on(*state, &scene, 0.0, true);
    const otx_light open = light_on(*state, &scene, 0.0, false);
    const otx_vec3 front = {0, 0, 1};
    const otx_vec3 behind = {0, 0, -1e-3}, before = {0, 0, 1e-3};
    const double sky = mean(&open, behind, (otx_vec3){0, 0, 1}, MANY);

    assert_float_equal(mean(&light, before, front, MANY), sky, 0.01);
    assert_float_equal(
        mean(&light, behind, front, MANY), 0.22 * 0.62 * 0.675, 0.01);
    /* Seen from its own back it is lit by the sky alone. */
    assert_true(mean(&light, behind, (otx_vec3){0, 0, -1}, MANY) < 0.62 * 0.7);
}

/* The same place as a material: without gloss it is the matte surface; with
 * occlusion nothing of the sky is left. */
static void
materials_are_lit_alike(void **state)
{
    const otx_scene scene = scene_sphere(*state, 24);
    const otx_light light = light_on(*state, &scene, 0.0, true);

    for (int32_t i = 0; i < 64; ++i)
    {
        const otx_vec3 n = direction(0.1 * i, 0.9 * sin(1.7 * i));
        otx_light_place place = {
            .at = otx_vec3_scale(1.01, n),
            .face = n,
            .normal = n,
            .eye = n,
            .roughness = 0.5,
            .open = 1.0};
        const otx_lit lit = otx_light_material(
            &light, &place, &(otx_light_rays){i, 64, 9, NULL});
        otx_lit dark, smooth;

        assert_float_equal(
            lit.matte,
            otx_light_at(
                &light, place.at, n, n, &(otx_light_rays){i, 64, 9, NULL}),
            1e-12);
        assert_true(lit.gloss.facing >= 0.0 && lit.gloss.grazing >= 0.0);
        place.open = 0.0;
        dark = otx_light_material(
            &light, &place, &(otx_light_rays){i, 64, 9, NULL});
        assert_true(dark.matte <= lit.matte);
        if (otx_vec3_dot(n, light.key) < -0.3)
        {
            assert_float_equal(dark.matte, 0.0, 0.0);
            assert_float_equal(dark.gloss.facing, 0.0, 0.0);
        }
        place.open = 1.0;
        place.roughness = 0.0;
        smooth = otx_light_material(
            &light, &place, &(otx_light_rays){i, 64, 9, NULL});
        assert_float_equal(smooth.matte, lit.matte, 1e-12);
    }
}

/* Samples are numbers of their own: nothing is carried from one to the next. */
static void
samples_have_no_state(void **state)
{
    const otx_scene scene = scene_sphere(*state, 24);
    const otx_light light = light_on(*state, &scene, 0.0, true);
    const otx_vec3 n = direction(0.3, 0.2), at = otx_vec3_scale(1.01, n);
    double first[16];
    int32_t other = 0;

    for (int32_t i = 0; i < 16; ++i)
        first[i] =
            otx_light_at(&light, at, n, n, &(otx_light_rays){i, 16, 1, NULL});
    for (int32_t i = 15; i >= 0; --i)
    {
        assert_true(
            otx_light_at(&light, at, n, n, &(otx_light_rays){i, 16, 1, NULL}) ==
            first[i]);
        other +=
            otx_light_at(&light, at, n, n, &(otx_light_rays){i, 16, 2, NULL}) !=
            first[i];
    }
    assert_int_equal(other, 16);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(a_ball_is_lit_as_without_shadows),
        test_with_run(sixteen_samples_are_enough),
        test_with_run(the_key_goes_with_the_camera),
        test_with_run(what_is_hidden_is_dark),
        test_with_run(materials_are_lit_alike),
        test_with_run(samples_have_no_state),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
