/* test_collar.c -- what charts read from each other: a plane that is cut in
 * charts is read as the plane, at every level. */
#include "unit/synth/canvases.h"

#include "synth/collar.h"

enum
{
    SIDE = 64,
    OWN = 40, /* columns of the first chart; the second has the others */
    LEVELS = 3,
    COUNT = SIDE * SIDE
};

/* How far the texels of one chart are from those of the other. */
static const double OFF_X = 0.25, OFF_Y = -0.125;

/* Two charts of one plane of SIDE x SIDE texels. The second is turned: what the
 * first sees at (x, y) it sees at (y + OFF_X, SIDE - x + OFF_Y). */
typedef struct scene
{
    otx_run *run;
    uint8_t kinds[2][COUNT];
    otx_synth_place places[2][COUNT];
    otx_synth_match matches[2][COUNT];
    otx_synth_chart charts[2];
    otx_canvas_stack *stacks[2];
    otx_canvas *finest[2];
} scene;

static scene *
make_scene(otx_run *run)
{
    scene *s = OTX_ZNEW(run->arena, scene, 1);
    const otx_pattern *pattern = make_pattern(run, LEVELS, true);

    s->run = run;
    for (int32_t i = 0; i < COUNT; ++i)
    {
        const int32_t x = i % SIDE, y = i / SIDE;

        s->kinds[0][i] = x < OWN ? OTX_SYNTH_FREE : OTX_SYNTH_COLLAR;
        s->places[0][i] = (otx_synth_place){
            1, (float)(y + 0.5 + OFF_X), (float)(SIDE - x - 0.5 + OFF_Y), 0.0f,
            -1.0f};
        s->matches[0][i] = plain_match(x, y);
        s->kinds[1][i] =
            SIDE - 1 - y >= OWN ? OTX_SYNTH_FREE : OTX_SYNTH_COLLAR;
        s->places[1][i] = (otx_synth_place){
            0, (float)(SIDE - y - 0.5 + OFF_Y), (float)(x + 0.5 - OFF_X), 0.0f,
            1.0f};
        s->matches[1][i] = plain_match(SIDE - 1 - y + OFF_Y, x - OFF_X);
        s->matches[1][i].c = 0.0f;
        s->matches[1][i].s = 1.0f;
    }
    for (int k = 0; k < 2; ++k)
    {
        s->charts[k] = (otx_synth_chart){
            .width = SIDE,
            .height = SIDE,
            .kinds = s->kinds[k],
            .places = s->places[k],
            .matches = s->matches[k]};
        s->stacks[k] = make_canvases(run, pattern, &s->charts[k], LEVELS);
        s->finest[k] = &s->stacks[k]->levels[0];
    }
    return s;
}

/* Links of a level; matches of collars are forgotten first. */
static void
link_up(scene *s, otx_canvas *canvases[2], otx_collar collars[2])
{
    assert_int_equal(
        otx_collar_link_up(s->run, s->charts, s->finest, canvases, 2, collars),
        OSDTEX_OK);
    for (int k = 0; k < 2; ++k)
        for (int32_t i = 0; i < collars[k].count; ++i)
            canvases[k]->matches[collars[k].links[i].at] =
                (otx_synth_match){3.0f, 3.0f, -1.0f, 0.0f};
}

/* What chart k shows at (x, y), texels of the pattern, wherever it is read. */
static void
check_plane(const otx_canvas *c, int32_t k, int32_t x, int32_t y)
{
    const otx_synth_match m = c->matches[otx_canvas_index(c, x, y)];
    const double u = (x + 0.5) * c->step_x, v = (y + 0.5) * c->step_y;

    assert_float_equal(m.x, k == 0 ? u : SIDE - v + OFF_Y, 1e-3);
    assert_float_equal(m.y, k == 0 ? v : u - OFF_X, 1e-3);
    assert_float_equal(m.c, k == 0 ? 1.0 : 0.0, 1e-6);
    assert_float_equal(m.s, k == 0 ? 0.0 : 1.0, 1e-6);
}

static void
a_plane_is_read_as_it_is(void **state)
{
    scene *s = make_scene(*state);

    for (int32_t l = 0; l < LEVELS; ++l)
    {
        otx_canvas *canvases[2] = {
            &s->stacks[0]->levels[l], &s->stacks[1]->levels[l]};
        otx_collar collars[2];

        link_up(s, canvases, collars);
        assert_int_equal(
            otx_collar_exchange(s->run, canvases, collars, 2), OSDTEX_OK);
        for (int32_t k = 0; k < 2; ++k)
            for (int32_t y = 0; y < canvases[k]->height; ++y)
                for (int32_t x = 0; x < canvases[k]->width; ++x)
                    if (canvases[k]
                            ->uses[otx_canvas_index(canvases[k], x, y)] !=
                        OTX_CANVAS_NONE)
                        check_plane(canvases[k], k, x, y);
    }
}

static void
links_lead_from_what_is_read_to_what_is_made(void **state)
{
    scene *s = make_scene(*state);

    for (int32_t l = 0; l < LEVELS; ++l)
    {
        otx_canvas *canvases[2] = {
            &s->stacks[0]->levels[l], &s->stacks[1]->levels[l]};
        otx_collar collars[2];

        link_up(s, canvases, collars);
        for (int32_t k = 0; k < 2; ++k)
        {
            assert_true(collars[k].count > 0);
            for (int32_t i = 0; i < collars[k].count; ++i)
            {
                const otx_collar_link *link = &collars[k].links[i];

                assert_int_equal(link->chart, 1 - k);
                assert_int_equal(canvases[k]->uses[link->at], OTX_CANVAS_READ);
                assert_int_equal(
                    canvases[1 - k]->kinds[link->from], OTX_SYNTH_FREE);
                /* No further than to the texel beside. */
                assert_true(fabsf(link->dx) <= 1.5f && fabsf(link->dy) <= 1.5f);
            }
        }
    }
}

/* Costs and trust go with the matches; what a chart owns stays. */
static void
what_is_read_is_trusted_as_its_owner_does(void **state)
{
    scene *s = make_scene(*state);
    otx_canvas *canvases[2] = {s->finest[0], s->finest[1]};
    otx_collar collars[2];

    link_up(s, canvases, collars);
    for (int32_t i = 0; i < canvases[1]->stride * canvases[1]->height; ++i)
    {
        canvases[1]->costs[i] = (float)i;
        canvases[1]->trust[i] = 1.0f / (float)(i + 1);
    }
    assert_int_equal(
        otx_collar_exchange(s->run, canvases, collars, 2), OSDTEX_OK);
    for (int32_t i = 0; i < collars[0].count; ++i)
    {
        const otx_collar_link *link = &collars[0].links[i];

        assert_float_equal(
            canvases[0]->costs[link->at], (float)link->from, 0.0);
        assert_float_equal(
            canvases[0]->trust[link->at], 1.0f / (float)(link->from + 1), 0.0);
    }
    for (int32_t i = 0; i < canvases[0]->stride * canvases[0]->height; ++i)
        if (canvases[0]->kinds[i] == OTX_SYNTH_FREE)
            assert_float_equal(canvases[0]->costs[i], 0.0, 0.0);
}

/* A collar texel whose owner has nothing there is not read, and no window
 * counts it. */
static void
what_nobody_makes_is_left_out(void **state)
{
    scene *s = make_scene(*state);
    otx_canvas *canvases[2] = {s->finest[0], s->finest[1]};
    otx_collar collars[2];
    int32_t lost = 0;

    for (int32_t y = 0; y < SIDE; ++y)
        s->places[0][y * SIDE + OWN].x = -50.0f;
    link_up(s, canvases, collars);
    for (int32_t y = 0; y < SIDE; ++y)
    {
        const ptrdiff_t at = otx_canvas_index(canvases[0], OWN, y);

        lost += canvases[0]->kinds[at] == OTX_SYNTH_VOID;
        assert_int_equal(canvases[0]->uses[at], OTX_CANVAS_NONE);
        assert_float_equal(canvases[0]->weights[at], 0.0, 0.0);
    }
    assert_int_equal(lost, SIDE);
    for (int32_t i = 0; i < collars[0].count; ++i)
        assert_int_not_equal(
            canvases[0]->kinds[collars[0].links[i].at], OTX_SYNTH_VOID);
}

static void
charts_without_places_have_no_collar(void **state)
{
    scene *s = make_scene(*state);
    otx_canvas *canvases[2] = {s->finest[0], s->finest[1]};
    otx_collar collars[2];

    s->charts[1].places = NULL;
    link_up(s, canvases, collars);
    assert_int_equal(collars[1].count, 0);
    assert_null(collars[1].links);
    assert_true(collars[0].count > 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(a_plane_is_read_as_it_is),
        test_with_run(links_lead_from_what_is_read_to_what_is_made),
        test_with_run(what_is_read_is_trusted_as_its_owner_does),
        test_with_run(what_nobody_makes_is_left_out),
        test_with_run(charts_without_places_have_no_collar),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
