/* test_plot.c -- texels of a chart: each has the facet that its middle is on,
 * and a step of it is as long as on the surface. */
#include "grid.h"

#include "territory/plot.h"

enum
{
    NX = 6,
    NY = 4
};

/* A grid of unit squares, and all of it as a chart of `texels` to a unit, by a
 * matrix (xx, xy, yx, yy) besides. */
typedef struct scene
{
    otx_surface *surface;
    otx_chart chart;
    otx_plot plot;
} scene;

static scene
make_scene(otx_run *run, double texels, const double m[4])
{
    scene s = {.surface = test_grid_create(run->arena, NX, NY, 1.0)};
    const otx_level *leaf = otx_surface_leaf(s.surface);
    int32_t *faces = OTX_NEW(run->arena, int32_t, leaf->face_count);
    otx_vec2 *flat = OTX_NEW(run->arena, otx_vec2, leaf->vert_count);

    for (int32_t f = 0; f < leaf->face_count; ++f)
        faces[f] = f;
    for (int32_t v = 0; v < leaf->vert_count; ++v)
    {
        const otx_vec3 p = otx_vec3_load(s.surface->points, v);

        flat[v] = (otx_vec2){
            texels * (m[0] * p.x + m[1] * p.y),
            texels * (m[2] * p.x + m[3] * p.y)};
    }
    s.chart = (otx_chart){
        .face_count = leaf->face_count,
        .core_count = leaf->face_count,
        .faces = faces,
        .first = (int32_t *)(uintptr_t)leaf->face_first,
        .corners = (int32_t *)(uintptr_t)leaf->face_verts,
        .vert_count = leaf->vert_count,
        .flat = flat};
    return s;
}

static void
build(otx_run *run, scene *s)
{
    assert_int_equal(
        otx_plot_build(run, s->surface, &s->chart, &s->plot), OSDTEX_OK);
}

static const double TURNED[4] = {0.8, -0.6, 0.6, 0.8};

static void
texels_have_the_facet_under_their_middle(void **state)
{
    scene s = make_scene(*state, 7.3, TURNED);
    const otx_level *leaf = otx_surface_leaf(s.surface);
    double shown = 0.0;

    build(*state, &s);
    assert_int_equal(s.plot.width % 16, 0);
    assert_int_equal(s.plot.height % 16, 0);
    for (int32_t y = 0; y < s.plot.height; ++y)
        for (int32_t x = 0; x < s.plot.width; ++x)
        {
            const int32_t id = s.plot.facets[y * s.plot.width + x];
            /* Turned back, where the middle is on the grid. */
            const otx_vec2 p =
                otx_vec2_add(s.plot.origin, (otx_vec2){x + 0.5, y + 0.5});
            const double u = (0.8 * p.x + 0.6 * p.y) / 7.3;
            const double v = (-0.6 * p.x + 0.8 * p.y) / 7.3;
            const bool on = u >= 0.0 && v >= 0.0 && u < NX && v < NY;
            otx_plot_facet f;
            double at[3];
            otx_vec3 q = {0, 0, 0};

            if (id < 0)
            {
                assert_false(on && fabs(u - round(u)) > 1e-6);
                continue;
            }
            shown += 1.0;
            assert_true(otx_plot_facet_of(
                &s.plot, s.surface, 7.3, id / OTX_PLOT_FACETS,
                id % OTX_PLOT_FACETS, &f));
            otx_plot_at(&f, x, y, at);
            for (int k = 0; k < 3; ++k)
            {
                assert_true(at[k] >= -1e-6);
                q = otx_vec3_mix(
                    1.0, q, at[k],
                    otx_vec3_load(
                        s.surface->points,
                        leaf->face_verts[f.facet.corners[k]]));
            }
            assert_float_equal(at[0] + at[1] + at[2], 1.0, 1e-9);
            assert_float_equal(q.x, u, 1e-5);
            assert_float_equal(q.y, v, 1e-5);
        }
    /* As many texels as the grid has area. */
    assert_float_equal(shown, NX * NY * 7.3 * 7.3, 0.03 * shown);
}

/* The root of the first fundamental form: squared, it says how long steps of
 * the plot are on the surface, in whatever direction. */
static void
steps_are_as_long_as_on_the_surface(void **state)
{
    const double shear[4] = {1.2, 0.4, -0.1, 0.7};
    const double det = 1.2 * 0.7 + 0.4 * 0.1;
    scene s = make_scene(*state, 5.0, shear);

    build(*state, &s);
    for (int32_t slot = 0; slot < NX * NY; ++slot)
        for (int32_t i = 0; i < 2; ++i)
        {
            otx_plot_facet f;

            assert_true(
                otx_plot_facet_of(&s.plot, s.surface, 5.0, slot, i, &f));
            assert_float_equal(otx_vec2_length(f.rotation), 1.0, 1e-9);
            for (int k = 0; k < 12; ++k)
            {
                const otx_vec2 d = otx_vec2_polar(0.5 * k);
                /* Back through the shear. */
                const otx_vec2 on = {
                    (0.7 * d.x - 0.4 * d.y) / det,
                    (0.1 * d.x + 1.2 * d.y) / det};
                const otx_vec2 step = {
                    f.metric[0] * d.x + f.metric[1] * d.y,
                    f.metric[1] * d.x + f.metric[2] * d.y};

                assert_float_equal(
                    otx_vec2_length(step), otx_vec2_length(on), 1e-6);
            }
        }
}

/* Facets keep to their box, and nothing of the chart is at the plot's rim. */
static void
boxes_hold_their_facets(void **state)
{
    scene s = make_scene(*state, 4.0, TURNED);

    build(*state, &s);
    for (int32_t y = 0; y < s.plot.height; ++y)
        for (int32_t x = 0; x < s.plot.width; ++x)
        {
            const int32_t id = s.plot.facets[y * s.plot.width + x];
            otx_plot_facet f;
            int32_t box[4];

            if (id < 0)
                continue;
            assert_true(
                x > 0 && y > 0 && x + 1 < s.plot.width &&
                y + 1 < s.plot.height);
            assert_true(otx_plot_facet_of(
                &s.plot, s.surface, 4.0, id / OTX_PLOT_FACETS,
                id % OTX_PLOT_FACETS, &f));
            otx_plot_box(&s.plot, &f, box);
            assert_true(x >= box[0] && y >= box[1] && x < box[2] && y < box[3]);
        }
}

static void
what_is_near_a_seam_is_marked(void **state)
{
    const double plain[4] = {1.0, 0.0, 0.0, 1.0};
    otx_run *run = *state;
    scene s = make_scene(run, 8.0, plain);
    const otx_level *leaf = otx_surface_leaf(s.surface);
    uint8_t *seam = OTX_ZNEW(run->arena, uint8_t, leaf->edge_count);

    build(run, &s);
    otx_plot_mark(s.surface, seam, 5.0, &s.plot);
    for (int32_t i = 0; i < s.plot.width * s.plot.height; ++i)
        assert_int_equal(s.plot.near[i], 0);
    /* The right side of face (2, 1): from (3, 1) to (3, 2). */
    seam[leaf->face_edges[4 * (NX + 2) + 1]] = 1;
    otx_plot_mark(s.surface, seam, 5.0, &s.plot);
    for (int32_t y = 0; y < s.plot.height; ++y)
        for (int32_t x = 0; x < s.plot.width; ++x)
        {
            const double px = x + 0.5 + s.plot.origin.x - 24.0;
            const double py = y + 0.5 + s.plot.origin.y;
            const double beyond = fmax(fmax(8.0 - py, py - 16.0), 0.0);

            assert_int_equal(
                s.plot.near[y * s.plot.width + x], hypot(px, beyond) <= 5.0);
        }
}

static void
a_chart_too_large_for_a_picture_has_none(void **state)
{
    const double plain[4] = {1.0, 0.0, 0.0, 1.0};
    scene s = make_scene(*state, 1e7, plain);
    const uint8_t seam[64] = {1, 1, 1};

    build(*state, &s);
    assert_int_equal(s.plot.width, 0);
    assert_int_equal(s.plot.height, 0);
    otx_plot_mark(s.surface, seam, 5.0, &s.plot);
    s.chart.face_count = 0;
    build(*state, &s);
    assert_int_equal(s.plot.width, 0);
}

/* Faces of no area in the plane have no facets, and those that are turned over
 * neither. */
static void
what_is_flat_or_turned_over_is_not_shown(void **state)
{
    const double mirrored[4] = {-1.0, 0.0, 0.0, 1.0};
    const double squashed[4] = {1.0, 0.0, 0.0, 0.0};
    scene a = make_scene(*state, 5.0, mirrored);
    scene b = make_scene(*state, 5.0, squashed);

    build(*state, &a);
    build(*state, &b);
    for (int32_t i = 0; i < a.plot.width * a.plot.height; ++i)
        assert_int_equal(a.plot.facets[i], -1);
    for (int32_t i = 0; i < b.plot.width * b.plot.height; ++i)
        assert_int_equal(b.plot.facets[i], -1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(texels_have_the_facet_under_their_middle),
        test_with_run(steps_are_as_long_as_on_the_surface),
        test_with_run(boxes_hold_their_facets),
        test_with_run(what_is_near_a_seam_is_marked),
        test_with_run(a_chart_too_large_for_a_picture_has_none),
        test_with_run(what_is_flat_or_turned_over_is_not_shown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
