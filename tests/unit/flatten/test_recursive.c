/* test_recursive.c -- patches below control polygons: exact on the plane, the
 * same along a common edge, for every cage. */
#include "unit/flatten/charts.h"

#include "flatten/descent.h"

static const char *const names[] = {"creature",      "torus",
                                    "double_torus",  "sphere",
                                    "hole",          "jack",
                                    "loop_open",     "loop_closed",
                                    "open_boundary", "high_valence",
                                    "plane",         "corner",
                                    "semi_sharp",    "ngons_and_triangles"};

static void
the_plane_comes_out_exactly(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const otx_surface s = sheet_refine(run, &in, OTX_SCHEME_BILINEAR, 3);
    chart_bench *b = chart_bench_create(run, &s, 16.0, 1000.0);

    (void)state;
    for (int32_t f = 0; f < 16; ++f)
    {
        const otx_chart chart = chart_recursive(b, 0, f);

        chart_check(b, &chart);
        assert_int_equal(chart.core_count, 64);
        assert_true(chart_worst(b, &chart) < 1.0 + 1e-6);
        assert_true(fabs(chart.distortion - 1.0) < 1e-6);
    }
    test_run_destroy(run);
}

/* On a square grid the position value is the distance from the edge. */
static void
reach_is_the_position_value(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 3);
    const otx_surface s = sheet_refine(run, &in, OTX_SCHEME_BILINEAR, 2);
    chart_bench *b = chart_bench_create(run, &s, 8.0, 5.0);
    const otx_chart chart = chart_recursive(b, 0, 4);
    const double low = 8.0, high = 16.0;

    (void)state;
    /* Leaves are 2 texels wide: those that begin at 0, 2 and 4. */
    assert_int_equal(chart.face_count, 16 + 4 * 12);
    for (int32_t v = 0; v < chart.vert_count; ++v)
    {
        const otx_vec3 p = otx_vec3_load(s.points, chart.verts[v]);
        const double x = 8.0 * p.x, y = 8.0 * p.y;
        const double away =
            fmax(fmax(low - x, x - high), fmax(low - y, y - high));

        assert_true(fabs(chart.vert_reach[v] - fmax(away, 0.0)) < 1e-4);
    }
    test_run_destroy(run);
}

/* The edge rule: a neighbour that was flattened alone meets the core at every
 * vertex of the common edge, so faces at it are not torn. */
static void
neighbours_meet_at_the_common_edge(void **state)
{
    (void)state;
    for (int32_t i = 0; i < COUNT(names); ++i)
    {
        otx_run *run = test_run_create();
        char path[128];
        otx_surface s;
        chart_bench *b;

        snprintf(path, sizeof path, "models/cages/%s.obj", names[i]);
        s = sheet_from_file(run, path, 3);
        b = chart_bench_create(run, &s, 50.0, 1e9);
        for (int32_t f = 0; f < s.levels[1].face_count; f += 7)
        {
            otx_chart chart, other;

            if (s.levels[1].face_hole[f])
                continue;
            chart = chart_recursive(b, 1, f);
            chart_check(b, &chart);
            for (int32_t k = 0; k < otx_level_face_size(&s.levels[1], f); ++k)
            {
                const int32_t next = otx_level_neighbour(&s.levels[1], f, k);
                int32_t first, end;

                if (next < 0 || s.levels[1].face_hole[next])
                    continue;
                other = chart_recursive(b, 1, next);
                otx_surface_leaves(&s, 1, next, &first, &end);
                /* Stretch of the placed collar = stretch of its own chart. */
                for (int32_t c = 0; c < chart.face_count; ++c)
                {
                    double a[2], d[2];

                    if (chart.faces[c] < first || chart.faces[c] >= end)
                        continue;
                    otx_chart_face_stretch(&chart, &s, 50.0, c, a);
                    otx_chart_face_stretch(
                        &other, &s, 50.0, chart.faces[c] - first, d);
                    assert_true(
                        fabs(fmax(a[0], 1.0 / a[1]) - fmax(d[0], 1.0 / d[1])) <
                        1e-6);
                }
            }
        }
        test_run_destroy(run);
    }
}

static void
splitting_makes_patches_flat(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_from_file(run, "models/cages/sphere.obj", 4);
    chart_bench *b = chart_bench_create(run, &s, 50.0, 10.0);
    double before = INFINITY;

    (void)state;
    for (int32_t l = 0; l < 4; ++l)
    {
        const double now = chart_recursive(b, l, 0).distortion - 1.0;

        /* E_flat falls with the square of the size. */
        assert_true(now >= 0.0 && now < 0.5 * before);
        before = now;
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_plane_comes_out_exactly),
        cmocka_unit_test(reach_is_the_position_value),
        cmocka_unit_test(neighbours_meet_at_the_common_edge),
        cmocka_unit_test(splitting_makes_patches_flat),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
