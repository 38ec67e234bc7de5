/* test_camera.c -- rays and projection are inverse; views look where their
 * names say. */
#include "render/camera.h"
#include "support.h"

static const otx_vec3 CENTRE = {3.0, -2.0, 5.0};

static otx_camera
looking(otx_view view, otx_up up, double turn)
{
    return (otx_camera){
        otx_vec3_mix(1.0, CENTRE, 6.0, otx_camera_from(view, up, turn)), CENTRE,
        OTX_CAMERA_FOV, 0.0, up};
}

static void
projection_undoes_directions(void **state)
{
    (void)state;
    for (int32_t view = 0; view < OTX_VIEW_COUNT; ++view)
    {
        const otx_camera camera = looking((otx_view)view, OTX_UP_Y, 0.7);
        const otx_camera_frame frame = otx_camera_aim(&camera, 300, 200);

        for (int32_t i = 0; i < 20; ++i)
        {
            const double x = 15.0 * i, y = 200.0 - 9.0 * i;
            const otx_vec3 ray = otx_camera_direction(&frame, x, y);
            otx_vec2 back;

            assert_true(fabs(otx_vec3_length(ray) - 1.0) < 1e-12);
            assert_true(otx_camera_project(
                &frame, otx_vec3_mix(1.0, frame.eye, 3.0 + i, ray), &back));
            assert_true(fabs(back.x - x) < 1e-9 && fabs(back.y - y) < 1e-9);
        }
    }
}

static void
expect_direction(
    otx_view view, otx_up axis, double turn, otx_vec3 from, otx_vec3 up)
{
    const otx_camera camera = looking(view, axis, turn);
    const otx_camera_frame frame = otx_camera_aim(&camera, 10, 10);

    assert_true(fabs(otx_vec3_dot(frame.forward, from) + 1.0) < 1e-12);
    assert_true(fabs(otx_vec3_dot(otx_vec3_unit(frame.up), up) - 1.0) < 1e-12);
}

static void
views_look_from_where_they_say(void **state)
{
    const otx_vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    const otx_vec3 minus_x = {-1, 0, 0}, minus_z = {0, 0, -1};
    const otx_vec3 minus_y = {0, -1, 0};

    (void)state;
    expect_direction(OTX_VIEW_FRONT, OTX_UP_Y, 0.0, z, y);
    expect_direction(OTX_VIEW_BACK, OTX_UP_Y, 0.0, minus_z, y);
    expect_direction(OTX_VIEW_RIGHT, OTX_UP_Y, 0.0, x, y);
    expect_direction(OTX_VIEW_LEFT, OTX_UP_Y, 0.0, minus_x, y);
    expect_direction(OTX_VIEW_TOP, OTX_UP_Y, 0.0, y, minus_z);
    /* A quarter turn takes the eye from the front to the right. */
    expect_direction(OTX_VIEW_FRONT, OTX_UP_Y, 0.5 * OTX_PI, x, y);
    /* Z up: from -Y, as the programs do that have it so. */
    expect_direction(OTX_VIEW_FRONT, OTX_UP_Z, 0.0, minus_y, z);
    expect_direction(OTX_VIEW_RIGHT, OTX_UP_Z, 0.0, x, z);
    expect_direction(OTX_VIEW_TOP, OTX_UP_Z, 0.0, z, y);
    expect_direction(OTX_VIEW_FRONT, OTX_UP_Z, 0.5 * OTX_PI, x, z);
}

static void
blind_cameras_are_told(void **state)
{
    otx_camera camera = {{0, 0, 1}, {0, 0, 0}, 1.0, 0.0, OTX_UP_Y};

    (void)state;
    assert_true(otx_camera_is_valid(&camera));
    camera.fov = OTX_PI;
    assert_false(otx_camera_is_valid(&camera));
    camera.fov = NAN;
    assert_false(otx_camera_is_valid(&camera));
    camera.fov = 1.0;
    camera.eye.y = INFINITY;
    assert_false(otx_camera_is_valid(&camera));
    camera.eye = camera.target;
    assert_false(otx_camera_is_valid(&camera));
}

static void
nothing_behind_the_eye_is_seen(void **state)
{
    const otx_camera camera = {{0, 0, 1}, {0, 0, 0}, 1.0, 0.0, OTX_UP_Y};
    const otx_camera_frame frame = otx_camera_aim(&camera, 10, 10);
    otx_vec2 at;

    (void)state;
    assert_false(otx_camera_project(&frame, (otx_vec3){0, 0, 2}, &at));
    assert_false(otx_camera_project(&frame, (otx_vec3){0, 0, 1}, &at));
    assert_true(otx_camera_project(&frame, (otx_vec3){0, 0, 0}, &at));
    assert_true(at.x == 5.0 && at.y == 5.0);
}

static void
names_are_found_again(void **state)
{
    otx_view view;

    (void)state;
    for (int32_t i = 0; i < OTX_VIEW_COUNT; ++i)
    {
        assert_true(
            otx_camera_view_find(otx_camera_view_name((otx_view)i), &view));
        assert_int_equal(view, i);
    }
    assert_false(otx_camera_view_find("below", &view));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projection_undoes_directions),
        cmocka_unit_test(views_look_from_where_they_say),
        cmocka_unit_test(blind_cameras_are_told),
        cmocka_unit_test(nothing_behind_the_eye_is_seen),
        cmocka_unit_test(names_are_found_again),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
