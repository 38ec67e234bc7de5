/* test_nudge.c -- a patch beside a textured one closes the gap, within limits,
 * and the neighbour stays where it is. */
#include "grid.h"
#include "unit/flatten/charts.h"

#include "image/view.h"
#include "relax/nudge.h"

enum
{
    DENSITY = 64, /* texels per cage face */
    LEVEL = 3
};

typedef struct scene
{
    otx_run *run;
    otx_surface surface;
    otx_exemplar *exemplar;
    chart_bench *bench;
    int32_t *patch;
    otx_vec2 *uvs;
    otx_chart chart;
    otx_cluster cluster;
    int32_t face;
    otx_vec2 *uv;
    double error;
} scene;

static void
draw_waves(otx_exemplar *e)
{
    for (int32_t y = 0; y < e->match.height; ++y)
        for (int32_t x = 0; x < e->match.width; ++x)
        {
            float *p = otx_image_at(&e->match, x, y);

            p[0] = (float)(50.0 + 40.0 * sin(2.0 * OTX_PI * x / 32.0));
            p[1] = (float)(50.0 + 40.0 * sin(2.0 * OTX_PI * y / 32.0));
            p[2] = (float)(50.0 + 20.0 * sin(2.0 * OTX_PI * (x + y) / 16.0));
        }
    e->match_sigma = sqrt(2.0 * (800.0 + 800.0 + 200.0));
}

/* Three cage faces in a row, the first textured; the second is placed `off`
 * texels away from where it would continue. */
static scene *
make_scene(bool wrap, bool recursive, otx_vec2 off)
{
    otx_run *run = test_run_create();
    scene *s = OTX_ZNEW(run->arena, scene, 1);
    const otx_cage_input in = mesh_grid(run, 3);
    const otx_level *leaf;

    s->run = run;
    s->surface = sheet_refine(run, &in, OTX_SCHEME_BILINEAR, LEVEL);
    leaf = otx_surface_leaf(&s->surface);
    s->exemplar = test_exemplar_create(run->arena, 256, 256, wrap, 5);
    draw_waves(s->exemplar);
    s->bench = chart_bench_create(run, &s->surface, DENSITY, 20.0);
    s->patch = OTX_NEW(run->arena, int32_t, leaf->face_count);
    s->uvs = OTX_ZNEW(run->arena, otx_vec2, leaf->corner_count);
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const otx_vec3 p =
            otx_vec3_load(s->surface.points, leaf->face_verts[c]);

        s->uvs[c] = (otx_vec2){DENSITY * p.x + 10.0, DENSITY * p.y + 10.0};
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        s->patch[f] = leaf->face_cage[f] == 3 ? 0 : -1;
    s->face = 4;
    s->cluster = (otx_cluster){0, 1, &s->face, 1.0, -1};
    s->chart = recursive ? chart_recursive(s->bench, 0, 4)
                         : chart_joint(s->bench, &s->cluster);
    s->uv = OTX_NEW(run->arena, otx_vec2, s->chart.vert_count);
    for (int32_t v = 0; v < s->chart.vert_count; ++v)
    {
        const otx_vec3 p = otx_vec3_load(s->surface.points, s->chart.verts[v]);

        s->uv[v] = otx_vec2_add(
            off, (otx_vec2){DENSITY * p.x + 10.0, DENSITY * p.y + 10.0});
    }
    return s;
}

static void
relax(scene *s, uint64_t seed)
{
    const otx_nudge_request request = {
        .surface = &s->surface,
        .exemplar = s->exemplar,
        .texels = DENSITY,
        .face_patch = s->patch,
        .uvs = s->uvs,
        .seed = seed};

    assert_int_equal(
        otx_nudge_run(
            &request, &s->cluster, &s->chart, s->bench->space.vert_slot,
            s->run->scratch, s->uv, &s->error),
        OSDTEX_OK);
    chart_check_space(s->bench);
}

/* Area of each fan triangle in the exemplar, over that on the surface. */
static void
check_areas(const scene *s)
{
    const double area = DENSITY * DENSITY / 64.0 / 2.0;

    for (int32_t i = 0; i < s->chart.core_count; ++i)
        for (int k = 1; k < 3; ++k)
        {
            const int32_t *c = s->chart.corners + s->chart.first[i];
            const double ratio =
                0.5 *
                otx_vec2_cross(
                    otx_vec2_sub(s->uv[c[k]], s->uv[c[0]]),
                    otx_vec2_sub(s->uv[c[k + 1]], s->uv[c[0]])) /
                area;

            assert_true(ratio > 1.0 / 1.6001 && ratio < 1.6001);
        }
}

/* RMS difference along the border x = 1 as it is placed, by its definition. */
static double
gap_error(const scene *s)
{
    const otx_vec2 own = s->uv[0];
    const otx_vec3 p = otx_vec3_load(s->surface.points, s->chart.verts[0]);
    double sum = 0.0;

    for (int32_t i = 0; i < DENSITY; ++i)
    {
        const double y = DENSITY + i + 0.5;
        const otx_vec2 there = {DENSITY + 10.0, y + 10.0};
        const otx_vec2 here = {
            own.x + DENSITY - DENSITY * p.x, own.y + y - DENSITY * p.y};
        float a[3], b[3];

        otx_view_value(otx_view_of(&s->exemplar->match, true, true), there, a);
        otx_view_value(otx_view_of(&s->exemplar->match, true, true), here, b);
        for (int c = 0; c < 3; ++c)
            sum += ((double)a[c] - b[c]) * ((double)a[c] - b[c]);
    }
    return sqrt(sum / DENSITY) / s->exemplar->match_sigma;
}

static void
gaps_are_narrowed(void **state)
{
    (void)state;
    for (int k = 0; k < 8; ++k)
    {
        const otx_vec2 off =
            otx_vec2_scale(3.0, otx_vec2_polar(0.25 * OTX_PI * k));
        scene *s = make_scene(true, k % 2, off);
        const double before = gap_error(s);

        relax(s, 1);
        assert_true(before > 0.1);
        assert_true(s->error < 0.5 * before);
        check_areas(s);
        test_run_destroy(s->run);
    }
}

static void
what_fits_is_left_alone(void **state)
{
    scene *s = make_scene(true, true, (otx_vec2){0, 0});
    otx_vec2 *before = OTX_NEW(s->run->arena, otx_vec2, s->chart.vert_count);

    (void)state;
    memcpy(before, s->uv, (size_t)s->chart.vert_count * sizeof *before);
    relax(s, 1);
    assert_true(s->error < 1e-4);
    for (int32_t v = 0; v < s->chart.vert_count; ++v)
        assert_true(otx_vec2_length(otx_vec2_sub(before[v], s->uv[v])) < 1e-9);
    test_run_destroy(s->run);
}

static void
only_the_core_moves(void **state)
{
    scene *s = make_scene(true, false, (otx_vec2){2.0, 2.0});
    const int32_t corners = s->chart.first[s->chart.core_count];
    uint8_t *core = OTX_ZNEW(s->run->arena, uint8_t, s->chart.vert_count);
    otx_vec2 *before = OTX_NEW(s->run->arena, otx_vec2, s->chart.vert_count);
    bool any = false;

    (void)state;
    memcpy(before, s->uv, (size_t)s->chart.vert_count * sizeof *before);
    for (int32_t c = 0; c < corners; ++c)
        core[s->chart.corners[c]] = 1;
    relax(s, 1);
    for (int32_t v = 0; v < s->chart.vert_count; ++v)
    {
        const bool same = memcmp(&before[v], &s->uv[v], sizeof *before) == 0;

        assert_true(core[v] || same);
        any = any || !same;
    }
    assert_true(any);
    test_run_destroy(s->run);
}

static void
without_a_textured_border_nothing_happens(void **state)
{
    scene *s = make_scene(true, true, (otx_vec2){2.0, 2.0});
    const otx_level *leaf = otx_surface_leaf(&s->surface);
    const otx_vec2 first = s->uv[0];

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        s->patch[f] = -1;
    relax(s, 1);
    assert_true(s->error == 0.0);
    assert_memory_equal(&first, &s->uv[0], sizeof first);
    test_run_destroy(s->run);
}

static void
what_does_not_tile_is_not_left(void **state)
{
    /* The chart's right border ends half a texel inside. */
    scene *s = make_scene(
        false, true, (otx_vec2){255.5 - (2.0 * DENSITY + 10.0), 2.0});

    (void)state;
    relax(s, 1);
    for (int32_t c = 0; c < s->chart.first[s->chart.core_count]; ++c)
        assert_true(s->uv[s->chart.corners[c]].x <= 255.5);
    test_run_destroy(s->run);
}

static void
draws_depend_on_the_seed_alone(void **state)
{
    scene *a = make_scene(true, true, (otx_vec2){2.0, 1.0});
    scene *b = make_scene(true, true, (otx_vec2){2.0, 1.0});
    scene *c = make_scene(true, true, (otx_vec2){2.0, 1.0});
    const size_t bytes = (size_t)a->chart.vert_count * sizeof *a->uv;

    (void)state;
    relax(a, 1);
    relax(b, 1);
    relax(c, 2);
    assert_memory_equal(a->uv, b->uv, bytes);
    assert_memory_not_equal(a->uv, c->uv, bytes);
    test_run_destroy(a->run);
    test_run_destroy(b->run);
    test_run_destroy(c->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaps_are_narrowed),
        cmocka_unit_test(what_fits_is_left_alone),
        cmocka_unit_test(only_the_core_moves),
        cmocka_unit_test(without_a_textured_border_nothing_happens),
        cmocka_unit_test(what_does_not_tile_is_not_left),
        cmocka_unit_test(draws_depend_on_the_seed_alone),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
