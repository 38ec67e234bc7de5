/* test_quick.c -- quick pixels say what all samples say, and are left to them
 * where they cannot. */
#include "looks.h"

#include "render/quick.h"

enum
{
    SIDE = 96
};

/* Everything that pixels are made of. */
typedef struct studio
{
    otx_scene scene;
    otx_camera camera;
    otx_render_options options;
    otx_tracer *tracer;
    otx_camera_frame frame;
    otx_shade shade;
    otx_light_map map;
    otx_quick quick;
} studio;

static void
set_up(otx_run *run, otx_scene scene, studio *out)
{
    *out = (studio){
        .scene = scene,
        .camera = {
            {0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, OTX_CAMERA_FOV, 0.0, OTX_UP_Y}};
    out->options = otx_render_defaults();
    out->options.width = out->options.height = SIDE;
    out->options.show = OTX_SHOW_FLAT;
    out->options.camera = &out->camera;
    assert_int_equal(
        otx_tracer_create(run, &out->scene, &out->tracer), OSDTEX_OK);
    out->frame = otx_camera_aim(&out->camera, SIDE, SIDE);
    assert_int_equal(
        otx_shade_prepare(
            run, &out->scene, &out->options, out->tracer, &out->frame,
            &out->shade),
        OSDTEX_OK);
    assert_int_equal(
        otx_light_map_make(run, &out->shade, SIDE, SIDE, true, &out->map),
        OSDTEX_OK);
    otx_quick_prepare(&out->shade, &out->map, &out->quick);
}

static void
pixels_know_what_they_are(void **state)
{
    otx_run *run = test_run_create();
    int32_t mixed = 0, empty = 0, done = 0;
    studio s;

    (void)state;
    set_up(run, scene_sphere(run, 48), &s);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            otx_light_known known;
            float rgb[3];
            const otx_quick_result result =
                otx_quick_pixel(&s.quick, x, y, 1, rgb, &known);

            mixed += result == OTX_QUICK_MIXED;
            empty += result == OTX_QUICK_EMPTY;
            done += result == OTX_QUICK_DONE;
        }
    /* A disc of radius .38 of the picture, and its rim. */
    assert_true(done > 0.8 * OTX_PI * 0.36 * 0.36 * SIDE * SIDE);
    assert_true(mixed > 100 && mixed < 1500);
    assert_true(empty > 0.4 * SIDE * SIDE);
    test_run_destroy(run);
}

/* Three samples to a side are not halved. */
static void
they_are_what_all_samples_say(void **state)
{
    otx_run *run = test_run_create();
    otx_scene_texture texture = texture_of(run, 64, true);
    static const otx_show shows[] = {OTX_SHOW_TEXTURE, OTX_SHOW_CLAY};
    otx_scene scene = scene_sphere(run, 48);

    (void)state;
    for (int32_t y = 0; y < 64; ++y)
        for (int32_t x = 0; x < 64; ++x)
            paint(
                &texture.image, x, y, (x / 8 + y / 8) % 2 ? 0.8f : 0.2f, 0.5f,
                0.4f);
    scene.textures = &texture;
    scene.texture_count = 1;
    assert_int_equal(otx_scene_smooth(run, &scene), OSDTEX_OK);
    for (int i = 0; i < 2; ++i)
    {
        otx_render_options options = otx_render_defaults();
        otx_image few, many;
        double sum = 0.0, signed_sum = 0.0, most = 0.0;

        options.width = options.height = SIDE;
        options.show = shows[i];
        few = render(run, &scene, &options);
        options.samples = 3;
        many = render(run, &scene, &options);
        for (int32_t k = 0; k < 4 * SIDE * SIDE; ++k)
        {
            const double d = few.pixels[k] - many.pixels[k];

            sum += fabs(d);
            signed_sum += d;
            most = fmax(most, fabs(d));
        }
        assert_true(sum / (4 * SIDE * SIDE) < 0.004);
        assert_true(fabs(signed_sum) / (4 * SIDE * SIDE) < 0.0015);
        assert_true(most < 0.4);
    }
    test_run_destroy(run);
}

/* A seam of two faces that show other things is never quick. */
static void
seams_take_all_samples(void **state)
{
    static const float points[] = {
        -1, -1, 0, 0, -1, 0, 0, 1, 0, -1, 1, 0, 1, -1, 0, 1, 1, 0};
    static const int32_t first[] = {0, 4, 8},
                         verts[] = {0, 1, 2, 3, 1, 4, 5, 2};
    static const float uvs[] = {0,    0, 0.1f, 0, 0.1f, 0.2f, 0,    0.2f,
                                0.6f, 0, 0.7f, 0, 0.7f, 0.2f, 0.6f, 0.2f};
    otx_run *run = test_run_create();
    otx_scene_texture texture = texture_of(run, 32, false);
    const otx_scene scene = {
        .vert_count = 6,
        .face_count = 2,
        .corner_count = 8,
        .points = points,
        .face_first = first,
        .face_verts = verts,
        .uvs = uvs,
        .texture_count = 1,
        .textures = &texture};
    const otx_camera camera = facing_camera(5.0);
    otx_render_options options = facing_options(&camera, 33);
    otx_image image;

    (void)state;
    for (int32_t y = 0; y < 32; ++y)
        for (int32_t x = 16; x < 32; ++x)
            paint(&texture.image, x, y, 1.0f, 1.0f, 1.0f);
    options.samples = 8;
    image = render(run, &scene, &options);
    /* The middle column is half of either, to a 64th and the jitter. */
    for (int32_t y = 0; y < 33; ++y)
        assert_true(fabs(otx_image_at(&image, 16, y)[0] - 0.5) < 0.08);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_know_what_they_are),
        cmocka_unit_test(they_are_what_all_samples_say),
        cmocka_unit_test(seams_take_all_samples),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
