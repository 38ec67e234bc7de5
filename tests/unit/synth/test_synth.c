/* test_synth.c -- the engine as a whole: what must come out, whatever else. */
#include "support.h"

#include "base/random.h"
#include "synth/synth.h"

enum
{
    SIDE = 96
};

/* Smooth noise over waves, which repeats nowhere; or waves that repeat every 24
 * texels and look alike from no other side. */
static void
paint(otx_image *lab, bool periodic)
{
    for (int32_t y = 0; y < lab->height; ++y)
        for (int32_t x = 0; x < lab->width; ++x)
            for (int c = 0; c < 3; ++c)
            {
                const double noise = otx_random_unit(
                    7, (uint32_t)c, (uint64_t)(y / 6 * 100 + x / 6));
                const double u = OTX_PI / 12.0 * (x + 0.5);
                const double v = OTX_PI / 12.0 * (y + 0.5);

                otx_image_at(lab, x, y)[c] =
                    (float)(periodic ? 40.0 + 20.0 * sin(u + c) + 15.0 * cos(v - 0.5 * c) + 10.0 * sin(2.0 * u + v) : 40.0 + 30.0 * sin(0.13 * x * (c + 1)) + 20.0 * noise);
            }
}

typedef struct scene
{
    otx_run *run;
    otx_pattern pattern;
    otx_synth_match matches[SIDE * SIDE];
    uint8_t kinds[SIDE * SIDE];
    float costs[SIDE * SIDE];
    otx_synth_chart chart;
    otx_synth_options options;
} scene;

static scene *
set_with(int32_t threads, bool periodic, int32_t size)
{
    otx_run *run = test_run_create_with(NULL, threads);
    scene *s = OTX_ZNEW(run->arena, scene, 1);
    otx_image lab;

    assert_int_equal(
        otx_image_create(run, run->arena, size, size, 3, &lab), OSDTEX_OK);
    paint(&lab, periodic);
    s->run = run;
    assert_int_equal(
        otx_pattern_build(
            run, run->arena,
            &(otx_pattern_input){
                .lab = &lab,
                .wrap_x = periodic,
                .wrap_y = periodic,
                .edge = 0.7,
                .levels = 3},
            &s->pattern),
        OSDTEX_OK);
    memset(s->kinds, OTX_SYNTH_FREE, sizeof s->kinds);
    s->chart = (otx_synth_chart){
        .width = SIDE,
        .height = SIDE,
        .kinds = s->kinds,
        .matches = s->matches,
        .costs = s->costs};
    s->options = otx_synth_mending();
    s->options.levels = 3;
    s->options.seed = 1;
    return s;
}

static otx_synth_match
place_at(double x, double y)
{
    return (otx_synth_match){(float)x, (float)y, 1.0f, 0.0f};
}

static void
make(scene *s)
{
    assert_int_equal(
        otx_synth_run(s->run, &s->pattern, &s->chart, 1, &s->options),
        OSDTEX_OK);
}

static void
a_continuous_plane_is_left_as_it_is(void **state)
{
    scene *s = set_with(2, false, SIDE);

    (void)state;
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        s->matches[i] = place_at(i % SIDE + 0.5, i / SIDE + 0.5);
    make(s);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        assert_float_equal(s->matches[i].x, (i % SIDE + 0.5), 1e-4);
        assert_float_equal(s->matches[i].y, (i / SIDE + 0.5), 1e-4);
        assert_float_equal(s->costs[i], 0.0, 1e-4);
    }
    test_run_destroy(s->run);
}

/* A picture that repeats, and a strip in the middle of its copy that is moved
 * along: what is frozen to the left and right of it goes on through it. */
static void
a_cut_through_a_periodic_picture_is_mended(void **state)
{
    scene *s = set_with(2, true, SIDE);
    double worst = 0.0;

    (void)state;
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const int32_t x = i % SIDE;

        const double by = x < SIDE / 2 ? 0.5 : 24.5;

        s->matches[i] = place_at(x + by, i / SIDE + by);
        s->kinds[i] =
            abs(x - SIDE / 2) < 20 ? OTX_SYNTH_FREE : OTX_SYNTH_FROZEN;
        if (abs(x - SIDE / 2) < 6)
            s->matches[i].y += 3.0f;
    }
    make(s);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        if (s->kinds[i] == OTX_SYNTH_FREE && s->costs[i] > worst)
            worst = s->costs[i];
    assert_true(worst < 1e-3);
    test_run_destroy(s->run);
}

/* A hole in a copy of the exemplar, filled from nothing, is the copy. */
static void
a_planted_copy_is_found(void **state)
{
    scene *s = set_with(2, false, SIDE);
    int32_t wrong = 0;

    (void)state;
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const int32_t x = i % SIDE, y = i / SIDE;
        const bool hole = abs(x - SIDE / 2) < 12 && abs(y - SIDE / 2) < 12;

        s->matches[i] = place_at(x + 0.5, y + 0.5);
        s->kinds[i] = hole ? OTX_SYNTH_FREE : OTX_SYNTH_FROZEN;
    }
    s->options.given = false;
    s->options.starts = 4;
    make(s);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        wrong += fabs(s->matches[i].x - (i % SIDE + 0.5)) > 0.25 ||
                 fabs(s->matches[i].y - (i / SIDE + 0.5)) > 0.25;
    assert_int_equal(wrong, 0);
    test_run_destroy(s->run);
}

static void
run_from_nothing(int32_t threads, bool wrap, otx_synth_match *out)
{
    scene *s = set_with(threads, false, 64);

    s->options = otx_synth_making();
    s->options.levels = 3;
    s->options.starts = 2;
    s->chart.wrap_x = s->chart.wrap_y = wrap;
    s->chart.kinds = NULL;
    make(s);
    memcpy(out, s->matches, sizeof s->matches);
    test_run_destroy(s->run);
}

static void
bytes_do_not_depend_on_threads(void **state)
{
    static otx_synth_match one[SIDE * SIDE], other[SIDE * SIDE];

    (void)state;
    run_from_nothing(1, true, one);
    run_from_nothing(2, true, other);
    assert_memory_equal(one, other, sizeof one);
    run_from_nothing(8, true, other);
    assert_memory_equal(one, other, sizeof one);
}

static void
matches_keep_to_a_field(void **state)
{
    scene *s = set_with(2, false, SIDE);
    float *field = OTX_NEW(s->run->arena, float, 2 * SIDE * SIDE);
    const double limit = cos(s->options.tolerance = OTX_PI / 18.0);

    (void)state;
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        field[2 * i] = (float)cos(0.01 * (i % SIDE));
        field[2 * i + 1] = (float)sin(0.01 * (i % SIDE));
    }
    s->chart.field = field;
    s->options.given = false;
    make(s);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        assert_true(
            s->matches[i].c * field[2 * i] +
                s->matches[i].s * field[2 * i + 1] >
            limit - 0.02);
    test_run_destroy(s->run);
}

/* Two charts of one plane, the second turned by a right angle: where one ends
 * the other goes on. */
static void
charts_go_on_where_others_end(void **state)
{
    enum
    {
        OWN = 48,
        SIZE = SIDE * SIDE
    };
    scene *s = set_with(2, false, SIDE);
    otx_synth_match *matches = OTX_ZNEW(s->run->arena, otx_synth_match, SIZE);
    uint8_t *kinds = OTX_ZNEW(s->run->arena, uint8_t, 2 * SIZE);
    otx_synth_place *places =
        OTX_ZNEW(s->run->arena, otx_synth_place, 2 * SIZE);
    otx_synth_chart charts[2];
    int32_t steps = 0;

    (void)state;
    /* The plane is (x, y); the second chart has (y, SIDE - x) there. */
    for (int32_t i = 0; i < SIZE; ++i)
    {
        const int32_t x = i % SIDE, y = i / SIDE;

        kinds[i] = x < OWN ? OTX_SYNTH_FREE : OTX_SYNTH_COLLAR;
        places[i] = (otx_synth_place){
            1, (float)(y + 0.5), (float)(SIDE - x - 0.5), 0.0f, -1.0f};
        kinds[SIZE + i] =
            SIDE - 1 - y >= OWN ? OTX_SYNTH_FREE : OTX_SYNTH_COLLAR;
        places[SIZE + i] = (otx_synth_place){
            0, (float)(SIDE - y - 0.5), (float)(x + 0.5), 0.0f, 1.0f};
    }
    for (int32_t k = 0; k < 2; ++k)
    {
        charts[k] = s->chart;
        charts[k].kinds = kinds + k * SIZE;
        charts[k].places = places + k * SIZE;
        charts[k].costs = NULL;
    }
    charts[1].matches = matches;
    s->options.given = false;
    s->options.histogram = 0.7;
    s->options.usage = 1.0;
    assert_int_equal(
        otx_synth_run(s->run, &s->pattern, charts, 2, &s->options), OSDTEX_OK);
    for (int32_t y = 4; y < SIDE - 4; ++y)
    {
        const otx_synth_match *a = &s->matches[y * SIDE + OWN - 1];
        const otx_synth_match *b = &matches[(SIDE - 1 - OWN) * SIDE + y];
        /* (1, 0) of the plane is (0, -1) in the second chart. */
        const double c = b->s, t = -b->c;

        steps += hypot(a->x + a->c - b->x, a->y + a->s - b->y) > 0.75 ||
                 hypot(a->c - c, a->s - t) > 0.2;
    }
    assert_true(steps < (SIDE - 8) / 3);
    test_run_destroy(s->run);
}

static bool
never(void *user, const char *stage, double fraction)
{
    (void)user;
    (void)stage;
    return fraction < 0.1;
}

static void
it_can_be_stopped(void **state)
{
    scene *s = set_with(2, false, SIDE);

    (void)state;
    s->options.given = false;
    s->run->progress = never;
    assert_int_equal(
        otx_synth_run(s->run, &s->pattern, &s->chart, 1, &s->options),
        OSDTEX_ERROR_CANCELLED);
    test_run_destroy(s->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_continuous_plane_is_left_as_it_is),
        cmocka_unit_test(a_cut_through_a_periodic_picture_is_mended),
        cmocka_unit_test(a_planted_copy_is_found),
        cmocka_unit_test(bytes_do_not_depend_on_threads),
        cmocka_unit_test(matches_keep_to_a_field),
        cmocka_unit_test(charts_go_on_where_others_end),
        cmocka_unit_test(it_can_be_stopped),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
