/* test_camera.c -- rays and projection are inverse; views look where their
 * names say. */
#include "render/camera.h"
#include "support.h"

static const otx_vec3 CENTRE = {3.0, -2.0, 5.0};

static void
projection_undoes_directions(void **state)
{
    (void)state;
    for (int32_t view = 0; view < OTX_VIEW_COUNT; ++view)
    {
        const otx_camera camera =
            otx_camera_see((otx_view)view, CENTRE, 2.0, 1.5, 0.7);
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
the_sphere_fills_the_shorter_side(void **state)
{
    static const double aspects[] = {0.5, 1.0, 2.0};

    (void)state;
    for (size_t i = 0; i < 3; ++i)
    {
        const otx_camera camera = otx_camera_see(
            OTX_VIEW_THREE_QUARTER, CENTRE, 2.0, aspects[i], 0.0);
        const double distance =
            otx_vec3_length(otx_vec3_sub(camera.eye, CENTRE));
        const double rim = tan(asin(2.0 / distance));
        const double half = tan(0.5 * camera.fov) * fmin(1.0, aspects[i]);

        assert_true(rim < half && rim > 0.93 * half);
    }
}

static void
expect_direction(otx_view view, double turn, otx_vec3 from, otx_vec3 up)
{
    const otx_camera camera = otx_camera_see(view, CENTRE, 1.0, 1.0, turn);
    const otx_camera_frame frame = otx_camera_aim(&camera, 10, 10);

    assert_true(fabs(otx_vec3_dot(frame.forward, from) + 1.0) < 1e-12);
    assert_true(fabs(otx_vec3_dot(otx_vec3_unit(frame.up), up) - 1.0) < 1e-12);
}

static void
views_look_from_where_they_say(void **state)
{
    const otx_vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    const otx_vec3 minus_x = {-1, 0, 0}, minus_z = {0, 0, -1};

    (void)state;
    expect_direction(OTX_VIEW_FRONT, 0.0, z, y);
    expect_direction(OTX_VIEW_BACK, 0.0, minus_z, y);
    expect_direction(OTX_VIEW_RIGHT, 0.0, x, y);
    expect_direction(OTX_VIEW_LEFT, 0.0, minus_x, y);
    expect_direction(OTX_VIEW_TOP, 0.0, y, minus_z);
    /* A quarter turn takes the eye from the front to the right. */
    expect_direction(OTX_VIEW_FRONT, 0.5 * OTX_PI, x, y);
}

static void
blind_cameras_are_told(void **state)
{
    otx_camera camera = {{0, 0, 1}, {0, 0, 0}, 1.0, 0.0};

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
    const otx_camera camera = {{0, 0, 1}, {0, 0, 0}, 1.0, 0.0};
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
        cmocka_unit_test(the_sphere_fills_the_shorter_side),
        cmocka_unit_test(views_look_from_where_they_say),
        cmocka_unit_test(blind_cameras_are_told),
        cmocka_unit_test(nothing_behind_the_eye_is_seen),
        cmocka_unit_test(names_are_found_again),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
