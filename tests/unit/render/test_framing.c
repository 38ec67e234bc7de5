/* test_framing.c -- views hold the model, and nothing but a little air. */
#include "unit/render/scenes.h"

#include "render/framing.h"

enum
{
    WIDTH = 320,
    HEIGHT = 180
};

/* A box, sides far from alike, away from the origin. */
static const float BOX[24] = {
    5, 1, 2, 8, 1, 2, 8, 2, 2, 5, 2, 2, 5, 1, 9, 8, 1, 9, 8, 2, 9, 5, 2, 9};
static const int32_t BOX_FIRST[7] = {0, 4, 8, 12, 16, 20, 24};
static const int32_t BOX_VERTS[24] = {
    0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};

static otx_scene
box(void)
{
    return (otx_scene){
        .vert_count = 8,
        .face_count = 6,
        .corner_count = 24,
        .points = BOX,
        .face_first = BOX_FIRST,
        .face_verts = BOX_VERTS};
}

/* Of the picture's width and height, what the model takes. */
static void
filled(
    const otx_scene *scene, const otx_camera *camera, int32_t width,
    int32_t height, double share[2])
{
    const otx_camera_frame frame = otx_camera_aim(camera, width, height);
    double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};

    for (int32_t v = 0; v < scene->vert_count; ++v)
    {
        otx_vec2 at;

        assert_true(
            otx_camera_project(&frame, otx_vec3_load(scene->points, v), &at));
        low[0] = fmin(low[0], at.x / width);
        low[1] = fmin(low[1], at.y / height);
        high[0] = fmax(high[0], at.x / width);
        high[1] = fmax(high[1], at.y / height);
    }
    for (int k = 0; k < 2; ++k)
    {
        assert_true(low[k] > 0.0 && high[k] < 1.0);
        share[k] = high[k] - low[k];
    }
}

static void
the_wider_side_takes_nine_tenths(void **state)
{
    const otx_scene scene = box();
    double share[2];

    (void)state;
    for (int32_t view = 0; view < OTX_VIEW_COUNT; ++view)
        for (int32_t up = 0; up < OTX_UP_COUNT; ++up)
            for (int32_t i = 0; i < 7; ++i)
            {
                const int32_t width = i % 2 ? WIDTH : HEIGHT;
                const int32_t height = i % 2 ? HEIGHT : WIDTH;
                const otx_framing framing = {
                    (otx_view)view, (otx_up)up, 0.9 * i, (double)width / height,
                    false};
                const otx_camera camera = otx_framing_camera(&scene, &framing);

                filled(&scene, &camera, width, height, share);
                assert_true(fmax(share[0], share[1]) > 0.9);
            }
}

static void
a_turntable_holds_still(void **state)
{
    const otx_scene scene = box();
    otx_framing framing = {
        OTX_VIEW_THREE_QUARTER, OTX_UP_Z, 0.0, (double)WIDTH / HEIGHT, true};
    const otx_camera first = otx_framing_camera(&scene, &framing);
    double share[2], most = 0.0;

    (void)state;
    for (int32_t i = 0; i < 36; ++i)
    {
        framing.turn = 2.0 * OTX_PI * i / 36;

        const otx_camera camera = otx_framing_camera(&scene, &framing);

        /* About the vertical, and no nearer. */
        assert_true(fabs(camera.eye.z - first.eye.z) < 1e-9);
        assert_true(fabs(camera.target.z - first.target.z) < 1e-9);
        assert_true(
            fabs(
                otx_vec3_length(otx_vec3_sub(camera.eye, camera.target)) -
                otx_vec3_length(otx_vec3_sub(first.eye, first.target))) < 1e-9);
        filled(&scene, &camera, WIDTH, HEIGHT, share);
        most = fmax(most, fmax(share[0], share[1]));
    }
    assert_true(most > 0.8);
}

static void
what_has_no_extent_is_seen(void **state)
{
    otx_scene scene = box();
    float points[24];
    const otx_framing framing = {OTX_VIEW_FRONT, OTX_UP_Y, 0.0, 1.0, false};

    (void)state;
    for (int v = 0; v < 24; ++v)
        points[v] = v % 3 == 2 ? BOX[v] : 1.0f;
    scene.points = points;
    for (int round = 0; round < 2; ++round)
    {
        const otx_camera camera = otx_framing_camera(&scene, &framing);

        assert_true(otx_camera_is_valid(&camera));
        assert_true(camera.eye.z > (round ? 1.0 : 9.0));
        for (int v = 0; v < 24; ++v)
            points[v] = 1.0f;
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_wider_side_takes_nine_tenths),
        cmocka_unit_test(a_turntable_holds_still),
        cmocka_unit_test(what_has_no_extent_is_seen),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
