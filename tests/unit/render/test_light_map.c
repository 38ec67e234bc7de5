/* test_light_map.c -- nothing of the model is outside of the blocks, and the
 * light is that of rays. */
#include "looks.h"

#include "render/light_map.h"
#include "render/quick.h"

enum
{
    SIDE = 64
};

static void
the_model_lies_in_covered_blocks(void **state)
{
    static const double eyes[][3] = {
        {0.0, 0.0, 5.0}, {3.0, 1.0, 0.5}, {0.0, 0.3, 0.5}};
    otx_run *run = test_run_create();
    const otx_scene scene = scene_sphere(run, 12);
    otx_render_options options = otx_render_defaults();

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        const otx_camera camera = {
            {eyes[i][0], eyes[i][1], eyes[i][2]},
            {0.3, 0.2, 0.0},
            0.7,
            0.0,
            OTX_UP_Y};
        const otx_camera_frame frame = otx_camera_aim(&camera, SIDE, SIDE);
        int32_t met = 0, covered = 0;
        otx_tracer *tracer;
        otx_light_map map;
        otx_shade shade;

        options.show = OTX_SHOW_FLAT;
        assert_int_equal(otx_tracer_create(run, &scene, &tracer), OSDTEX_OK);
        assert_int_equal(
            otx_shade_prepare(run, &scene, &options, tracer, &frame, &shade),
            OSDTEX_OK);
        assert_int_equal(
            otx_light_map_make(run, &shade, SIDE, SIDE, false, &map),
            OSDTEX_OK);
        assert_null(map.texels);
        for (int32_t y = 0; y < SIDE; ++y)
            for (int32_t x = 0; x < SIDE; ++x)
            {
                otx_shade_sample sample = {.at = {x + 0.5, y + 0.5}};
                otx_hit hit;

                covered += otx_light_map_covers(&map, x, y);
                if (!otx_shade_trace(&shade, &sample, &hit))
                    continue;
                ++met;
                assert_true(otx_light_map_covers(&map, x, y));
            }
        assert_true(met > 0 && covered >= met);
        /* From outside it does not fill the picture. */
        assert_true(i == 2 || covered < SIDE * SIDE);
    }
    test_run_destroy(run);
}

/* Nothing hides the sky from a ball, nor the key from the side it is on. */
static void
a_ball_sees_all_of_its_sky(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 64);
    const otx_camera camera = {
        {0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.45, 0.0, OTX_UP_Y};
    const otx_camera_frame frame = otx_camera_aim(&camera, SIDE, SIDE);
    otx_render_options options = otx_render_defaults();
    otx_tracer *tracer;
    otx_light_map map;
    otx_shade shade;
    int32_t told = 0;

    (void)state;
    options.show = OTX_SHOW_FLAT;
    assert_int_equal(otx_scene_smooth(run, &scene), OSDTEX_OK);
    assert_int_equal(otx_tracer_create(run, &scene, &tracer), OSDTEX_OK);
    assert_int_equal(
        otx_shade_prepare(run, &scene, &options, tracer, &frame, &shade),
        OSDTEX_OK);
    assert_int_equal(
        otx_light_map_make(run, &shade, SIDE, SIDE, true, &map), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const otx_light_texel *t = &map.texels[y * SIDE + x];
            const otx_vec3 n = otx_vec3_load(t->normal, 0);
            const double pixel = t->depth * otx_vec3_length(frame.right);
            otx_light_known known;

            if (t->depth == 0.0f)
                continue;
            if (!otx_light_map_at(&map, x, y, n, t->depth, pixel, &known))
                continue;
            ++told;
            assert_true(known.sky > 0.9);
            if (otx_vec3_dot(n, shade.light.key) > 0.6)
                assert_true(known.key == 1.0);
            if (otx_vec3_dot(n, shade.light.key) < -0.6)
                assert_true(known.key == 0.0);
            /* Another surface in the pixel is not told. */
            assert_false(otx_light_map_at(
                &map, x, y, otx_vec3_scale(-1.0, n), t->depth, pixel, &known));
            assert_false(otx_light_map_at(
                &map, x, y, n, t->depth + 40.0 * pixel, pixel, &known));
        }
    assert_true(told > 0.5 * SIDE * SIDE);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_model_lies_in_covered_blocks),
        cmocka_unit_test(a_ball_sees_all_of_its_sky),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
