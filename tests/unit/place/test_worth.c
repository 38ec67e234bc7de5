/* test_worth.c -- what charts are worth, of charts that were bent on purpose.
 */
#include "bent.h"

#include "place/ground.h"
#include "place/worth.h"

/* A chart of a plane, whose vertices are then moved. */
typedef struct stage
{
    otx_footprint_ask ask;
    otx_footprint_space space;
    otx_footprint chart;
    otx_ground ground;
} stage;

static stage *
set(otx_run *run, double reach)
{
    const otx_surface *surface = bent_create(run->arena, 0.0, false);
    stage *s = OTX_ZNEW(run->arena, stage, 1);

    s->ask = bent_ask(surface, (otx_vec3){0.5, 0.5, 0}, 0.4);
    s->space = bent_space(run->arena, surface);
    s->ground =
        (otx_ground){&s->ask, &s->space, run->arena, &s->chart, NULL, NULL};
    assert_int_equal(otx_ground_begin(&s->ground), OSDTEX_OK);
    assert_int_equal(otx_ground_grow(&s->ground, reach), OSDTEX_OK);
    for (int32_t v = 0; v < s->chart.vert_count; ++v)
    {
        const otx_vec3 p = otx_vec3_load(surface->points, s->chart.verts[v]);

        s->chart.flat[v] = (otx_vec2){(p.x - 0.5) / 0.4, (p.y - 0.5) / 0.4};
    }
    return s;
}

static void
judge(otx_run *run, stage *s)
{
    assert_int_equal(
        otx_worth_judge(run->arena, &s->ask, &s->space, &s->chart), OSDTEX_OK);
}

static void
test_drawn_out_is_measured(void **state)
{
    otx_run *run = *state;
    stage *s = set(run, 0.2);

    judge(run, s);
    assert_true(fabs(s->chart.stretch_p95 - 1.0) < 1e-5);
    assert_false(s->chart.is_cut);
    for (int32_t v = 0; v < s->chart.vert_count; ++v)
        s->chart.flat[v].x *= 1.25;
    judge(run, s);
    assert_true(fabs(s->chart.stretch_p95 - 1.25) < 1e-5);
    assert_true(fabs(s->chart.stretch_mean - 1.25) < 1e-5);
    assert_true(fabs(s->chart.covered - 1.0) < 1e-5);
}

static void
test_folds_and_gaps_are_found(void **state)
{
    otx_run *run = *state;
    stage *s = set(run, 0.0);

    for (int32_t v = 0; v < s->chart.vert_count; ++v)
        s->chart.flat[v] = otx_vec2_scale(0.8, s->chart.flat[v]);
    judge(run, s);
    assert_true(s->chart.is_cut);
    assert_true(s->chart.covered < 0.9);
    for (int32_t v = 0; v < s->chart.vert_count; ++v)
        s->chart.flat[v].x *= -1.0;
    judge(run, s);
    assert_true(s->chart.stretch_p95 == (double)INFINITY);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(test_drawn_out_is_measured),
        test_with_run(test_folds_and_gaps_are_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
