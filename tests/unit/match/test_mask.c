/* test_mask.c -- every pixel once, sources and weights linear. */
#include "scene.h"

enum
{
    SIDE = 96
};

typedef struct canvas
{
    int hits[SIDE][SIDE];
    otx_vec2 rotation;
    otx_vec2 shift;
} canvas;

static void
hit(void *context, const otx_mask_span *span)
{
    canvas *c = context;

    for (int32_t n = 0; n < span->count; ++n)
        ++c->hits[span->y + SIDE / 2][span->x + n + SIDE / 2];
}

/* The same map as the frame: the source is the pixel itself. */
static void
source_is_pixel(void *context, const otx_mask_span *span)
{
    (void)context;
    for (int32_t n = 0; n < span->count; ++n)
    {
        assert_true(
            fabs(
                span->source.x + n * span->source_step.x -
                (span->x + n + 0.5)) < 1e-9);
        assert_true(
            fabs(span->source.y + n * span->source_step.y - (span->y + 0.5)) <
            1e-9);
        assert_true(fabs(span->weight + n * span->weight_step - 1.0) < 1e-12);
    }
}

static void
shared_edges_are_counted_once(void **state)
{
    scene_mask scene;

    (void)state;
    scene_mask_make(
        &scene, (otx_vec2){-20.0, -17.0}, 6.5, 0.0, (otx_vec2){0.0, 0.0});
    for (int k = 0; k < 40; ++k)
    {
        const double angle = k * OTX_PI / 20.0;
        const otx_mask_frame frame = {
            .rotation = otx_vec2_polar(angle),
            .shift = {0.5 * (k % 2), 0.25 * (k % 3)},
            .pixel = {1.0, 1.0}};
        canvas c = {{{0}}, {0.0, 0.0}, {0.0, 0.0}};
        int total = 0;

        otx_mask_draw(&scene.mask, &frame, hit, &c);
        for (int y = 0; y < SIDE; ++y)
            for (int x = 0; x < SIDE; ++x)
            {
                assert_in_range(c.hits[y][x], 0, 1);
                total += c.hits[y][x];
            }
        /* The area, up to the pixels along the outline. */
        assert_true(fabs(total - otx_mask_area(&scene.mask)) < 60.0);
    }
}

static void
the_inside_of_a_square_is_covered_exactly(void **state)
{
    const otx_mask_triangle triangles[2] = {
        {.flat = {{0, 0}, {8, 0}, {8, 8}}, .weight = {1, 1, 1}},
        {.flat = {{0, 0}, {8, 8}, {0, 8}}, .weight = {1, 1, 1}}};
    const otx_mask mask = {triangles, 2};
    const otx_mask_frame frame = {.rotation = {1, 0}, .pixel = {1, 1}};
    canvas c = {{{0}}, {0.0, 0.0}, {0.0, 0.0}};

    (void)state;
    otx_mask_draw(&mask, &frame, hit, &c);
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE; ++x)
        {
            const int i = x - SIDE / 2, j = y - SIDE / 2;

            assert_int_equal(c.hits[y][x], i >= 0 && i < 8 && j >= 0 && j < 8);
        }
}

static void
sources_follow_the_frame(void **state)
{
    const double angle = 0.7;
    const otx_vec2 shift = {3.25, -8.5};
    const otx_mask_frame frame = {
        .rotation = otx_vec2_polar(angle), .shift = shift, .pixel = {1, 1}};
    scene_mask scene;

    (void)state;
    scene_mask_make(&scene, (otx_vec2){-5.0, 2.0}, 4.3, angle, shift);
    otx_mask_draw(&scene.mask, &frame, source_is_pixel, NULL);
}

static void
bad_numbers_are_refused(void **state)
{
    scene_mask scene;

    (void)state;
    scene_mask_make(
        &scene, (otx_vec2){0.0, 0.0}, 4.0, 0.0, (otx_vec2){0.0, 0.0});
    assert_true(otx_mask_is_valid(&scene.mask));
    scene.triangles[3].source[1].y = NAN;
    assert_false(otx_mask_is_valid(&scene.mask));
    scene.triangles[3].source[1].y = 1e12;
    assert_false(otx_mask_is_valid(&scene.mask));
    scene.triangles[3].source[1].y = 1.0;
    scene.triangles[0].weight[2] = -1.0f;
    assert_false(otx_mask_is_valid(&scene.mask));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shared_edges_are_counted_once),
        cmocka_unit_test(the_inside_of_a_square_is_covered_exactly),
        cmocka_unit_test(sources_follow_the_frame),
        cmocka_unit_test(bad_numbers_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
