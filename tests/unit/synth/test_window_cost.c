/* test_window_cost.c -- the distance of windows, against one that is summed
 * texel by texel in double. */
#include "support.h"

#include "base/random.h"
#include "image/view.h"
#include "synth/window_cost.h"

enum
{
    SIDE = 64,
    RADIUS = 3
};

static void
paint(otx_image *image, uint32_t what)
{
    for (int32_t i = 0; i < SIDE * SIDE * image->channels; ++i)
        image->pixels[i] =
            (float)(50.0 * otx_random_unit(3, what, (uint64_t)i));
}

/* Of the window at (x, y), the way that the note says it; of a whole one where
 * that is sparse, of every other texel. */
static double
slow(
    const otx_image *lab, const otx_image *guide, const otx_canvas *c,
    int32_t x, int32_t y, otx_synth_match m)
{
    const bool sparse = c->sparse && c->masses[otx_canvas_index(c, x, y)] ==
                                         (2 * RADIUS + 1) * (2 * RADIUS + 1);
    double sum = 0.0, mass = 0.0;

    for (int32_t j = -RADIUS; j <= RADIUS; ++j)
        for (int32_t i = -RADIUS; i <= RADIUS; ++i)
        {
            const ptrdiff_t at = otx_canvas_index(c, x + i, y + j);
            const double weight = c->weights[at];
            const otx_vec2 to = {
                m.x + m.c * i - m.s * j, m.y + m.s * i + m.c * j};
            float a[3], b[2];

            if (sparse && ((i + j) & 1))
                continue;
            otx_view_value(otx_view_of(lab, true, true), to, a);
            otx_view_value(otx_view_of(guide, true, true), to, b);
            for (int k = 0; k < 3; ++k)
                sum += weight * pow(a[k] - c->colors[2 * at][k], 2.0);
            for (int k = 0; k < 2; ++k)
                sum += weight * pow(b[k] - c->colors[2 * at + 1][k], 2.0);
            mass += weight;
        }
    return sum / mass;
}

/* A pattern of noise with a guide, and a canvas of other noise with
 * holes: `voids` of five texels. */
typedef struct scene
{
    otx_image lab, guide;
    otx_pattern pattern;
    otx_canvas_stack stack;
} scene;

static scene *
make_scene(otx_run *run, uint64_t voids)
{
    scene *s = OTX_ZNEW(run->arena, scene, 1);
    otx_synth_match *start = OTX_ZNEW(run->arena, otx_synth_match, SIDE * SIDE);
    uint8_t *kinds = OTX_NEW(run->arena, uint8_t, SIDE * SIDE);
    const otx_synth_options options = otx_synth_mending();
    const otx_synth_chart chart = {
        .width = SIDE, .height = SIDE, .kinds = kinds, .matches = start};

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &s->lab), OSDTEX_OK);
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 2, &s->guide), OSDTEX_OK);
    paint(&s->lab, 1);
    paint(&s->guide, 2);
    /* Edges are left out, so that the slow one need not know them. */
    assert_int_equal(
        otx_pattern_build(
            run, run->arena,
            &(otx_pattern_input){&s->lab, &s->guide, true, true, 0.0, 1},
            &s->pattern),
        OSDTEX_OK);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const uint64_t bits = otx_random_bits(5, 1, (uint64_t)i);

        kinds[i] = bits % 5 < voids ? OTX_SYNTH_VOID : OTX_SYNTH_FREE;
        start[i] = (otx_synth_match){
            (float)(bits >> 8 & 63), (float)(bits >> 16 & 63), 1.0f, 0.0f};
    }
    assert_int_equal(
        otx_canvas_build(run, &s->pattern, &chart, &options, 1, &s->stack),
        OSDTEX_OK);
    return s;
}

static void
compare(otx_run *run, uint64_t voids, bool sparse)
{
    scene *s = make_scene(run, voids);
    const otx_canvas *c = &s->stack.levels[0];

    s->stack.levels[0].sparse = sparse;
    for (int32_t k = 0; k < 200; ++k)
    {
        const uint64_t bits = otx_random_bits(5, 2, (uint64_t)k);
        const double angle = 0.1 * k;
        const int32_t x = 4 + (int32_t)(bits % 56);
        const int32_t y = 4 + (int32_t)(bits >> 8 & 31) + 14;
        const otx_synth_match m = {
            (float)(bits >> 20 & 63) + 0.3f, (float)(bits >> 30 & 63) + 0.6f,
            (float)cos(angle), (float)sin(angle)};
        const ptrdiff_t at = otx_canvas_index(c, x, y);
        const otx_window_frame frame = otx_window_frame_of(c, at, m);
        const float fast = otx_window_cost(c, at, frame, INFINITY);
        const double wanted = slow(&s->lab, &s->guide, c, x, y, m);

        assert_float_equal(fast, wanted, 2e-3 * wanted);
        /* Ended early it is above the limit. */
        assert_true(otx_window_cost(c, at, frame, 0.5f * fast) > 0.5f * fast);
    }
}

static void
distances_are_those_of_the_definition(void **state)
{
    compare(*state, 1, true);
    compare(*state, 0, false);
}

static void
whole_windows_are_compared_by_half(void **state)
{
    compare(*state, 0, true);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            distances_are_those_of_the_definition, test_run_setup,
            test_run_teardown),
        cmocka_unit_test_setup_teardown(
            whole_windows_are_compared_by_half, test_run_setup,
            test_run_teardown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
