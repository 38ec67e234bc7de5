/* test_overlay.c -- lines and dots where they were put, in their colours. */
#include "scenes.h"

static const otx_vec3 RIGHT = {1, 0, 0}, UP = {0, 1, 0};

static otx_overlay_index
prepare(otx_run *run, const otx_scene *scene, const otx_overlay *overlay)
{
    otx_overlay_index index;

    if (otx_overlay_prepare(run, scene, overlay, &index) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return index;
}

/* The red of a white face after the overlay. */
static float
red_at(const otx_overlay_index *index, double x, double y, float *blue)
{
    float rgb[3] = {1.0f, 1.0f, 1.0f};

    otx_overlay_draw(index, 0, (otx_vec3){x, y, 0}, RIGHT, UP, rgb);
    if (blue)
        *blue = rgb[2];
    return rgb[0];
}

static void
lines_are_as_wide_as_asked(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    const otx_overlay_line line = {0, {{-1, 0, 0}, {1, 0, 0}}, {0, 2}};
    const otx_overlay overlay = {
        .line_count = 1, .lines = &line, .line_width = 0.2};
    const otx_overlay_index index = prepare(run, &scene, &overlay);

    (void)state;
    assert_true(red_at(&index, 0.5, 0.0, NULL) < 0.1f);
    assert_true(red_at(&index, 0.5, 0.09, NULL) < 0.1f);
    assert_true(red_at(&index, 0.5, 0.11, NULL) == 1.0f);
    test_run_destroy(run);
}

static void
arrows_darken_along_their_way(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    const otx_overlay_line line = {0, {{-1, 0, 0}, {1, 0, 0}}, {0, 2}};
    const otx_overlay overlay = {
        .line_count = 1, .lines = &line, .line_width = 0.2, .period = 2.1};
    const otx_overlay_index index = prepare(run, &scene, &overlay);

    (void)state;
    for (double x = -0.95; x < 0.9; x += 0.1)
        assert_true(
            red_at(&index, x, 0, NULL) > red_at(&index, x + 0.1, 0, NULL));
    test_run_destroy(run);
}

static void
dots_show_their_sign(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    const otx_overlay_dot dots[] = {{{-0.5, 0, 0}, 2}, {{0.5, 0, 0}, -1}};
    const otx_overlay overlay = {
        .dot_count = 2, .dots = dots, .dot_radius = 0.3};
    const otx_overlay_index index = prepare(run, &scene, &overlay);
    float blue;

    (void)state;
    assert_true(red_at(&index, -0.4, 0.1, &blue) > blue);
    assert_true(red_at(&index, 0.6, 0.1, &blue) < blue);
    /* The upright stroke of the plus, which the minus lacks. */
    assert_true(red_at(&index, -0.5, 0.12, &blue) == blue);
    assert_true(red_at(&index, 0.5, 0.12, &blue) < blue);
    assert_true(red_at(&index, 0.0, 0.9, NULL) == 1.0f);
    test_run_destroy(run);
}

static void
a_line_beside_the_model_is_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    const otx_overlay_line line = {.face = 1};
    const otx_overlay overlay = {
        .line_count = 1, .lines = &line, .line_width = 0.2};
    otx_overlay_index index;

    (void)state;
    assert_int_equal(
        otx_overlay_prepare(run, &scene, &overlay, &index),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

static void
without_an_overlay_there_is_no_field_to_show(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_quad(NULL);
    otx_render_options options = otx_render_defaults();
    otx_image out;

    (void)state;
    options.show = OTX_SHOW_FIELD;
    assert_int_equal(
        otx_render(run, &scene, &options, &out), OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(run), "no direction field"));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_as_wide_as_asked),
        cmocka_unit_test(arrows_darken_along_their_way),
        cmocka_unit_test(dots_show_their_sign),
        cmocka_unit_test(a_line_beside_the_model_is_refused),
        cmocka_unit_test(without_an_overlay_there_is_no_field_to_show),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
