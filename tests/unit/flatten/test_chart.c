/* test_chart.c -- charts are discs, and exact where the surface allows it. */
#include "unit/flatten/charts.h"

#include "base/random.h"

/* Euler characteristic of the chart, through chart vertices and edges. */
static int32_t
euler(otx_run *run, const otx_chart *chart)
{
    const int32_t corners = chart->first[chart->face_count];
    int64_t *edges = OTX_NEW(run->scratch, int64_t, corners);
    int32_t distinct = 0;

    for (int32_t i = 0; i < chart->face_count; ++i)
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
        {
            const int32_t next =
                c + 1 < chart->first[i + 1] ? c + 1 : chart->first[i];
            const int64_t a = chart->corners[c], b = chart->corners[next];

            edges[c] = a < b ? (a << 32) + b : (b << 32) + a;
        }
    for (int32_t c = 0; c < corners; ++c)
    {
        bool known = false;

        for (int32_t d = 0; d < c && !known; ++d)
            known = edges[d] == edges[c];
        distinct += !known;
    }
    return chart->vert_count - distinct + chart->face_count;
}

static void
charts_stay_discs_where_the_surface_closes(void **state)
{
    static const char *const names[] = {"torus",        "double_torus",
                                        "high_valence", "creature",
                                        "sphere",       "several_components"};

    (void)state;
    for (int32_t i = 0; i < COUNT(names); ++i)
    {
        otx_run *run = test_run_create();
        char path[128];
        otx_surface s;
        chart_bench *b;

        snprintf(path, sizeof path, "models/cages/%s.obj", names[i]);
        s = sheet_from_file(run, path, 1);
        /* A collar that would go all around. */
        b = chart_bench_create(run, &s, 1.0, 10.0 * sqrt(s.area));
        for (int32_t k = 0; k < 6; ++k)
        {
            const int32_t face =
                (int32_t)(otx_random_unit(3, 0, (uint64_t)k) * s.levels[0].face_count);
            const otx_cluster c = {0, 1, &face, 1.0, -1};
            const otx_chart chart = chart_joint(b, &c);

            chart_check(b, &chart);
            assert_int_equal(euler(run, &chart), 1);
        }
        test_run_destroy(run);
    }
}

static void
developable_sheets_flatten_without_stretch(void **state)
{
    (void)state;
    for (int kind = SHEET_FLAT; kind <= SHEET_FOLDED; ++kind)
    {
        otx_run *run = test_run_create();
        const otx_surface s = sheet_create(run, 14, 9, kind);
        chart_bench *b = chart_bench_create(run, &s, 7.0, 40.0);
        const int32_t faces[] = {61, 62, 63, 64, 75, 76, 77, 78};
        const otx_cluster c = {0, COUNT(faces), faces, 8.0, -1};
        const otx_chart chart = chart_joint(b, &c);

        chart_check(b, &chart);
        assert_true(chart.face_count > 40);
        assert_true(chart_worst(b, &chart) < 1.001);
        assert_true(chart.distortion < 1.001);
        test_run_destroy(run);
    }
}

static void
the_collar_is_no_wider_than_asked(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 15, 15, SHEET_FLAT);
    chart_bench *b = chart_bench_create(run, &s, 10.0, 25.0);
    const int32_t face = 7 * 15 + 7;
    const otx_cluster c = {0, 1, &face, 1.0, -1};
    const otx_chart chart = chart_joint(b, &c);

    (void)state;
    /* Two steps across edges: a diamond of 13 squares. */
    assert_int_equal(chart.face_count, 13);
    for (int32_t i = 1; i < chart.face_count; ++i)
        assert_true(chart.reach[i] <= 25.0f);
    test_run_destroy(run);
}

static void
what_is_not_developable_says_so(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_from_file(run, "models/cages/sphere.obj", 1);
    chart_bench *b = chart_bench_create(run, &s, 50.0, 10.0);
    const otx_dual dual = sheet_dual(run, &s, 0);
    const otx_cluster all = sheet_all(run, &s, 0);
    otx_cluster_list few, many;

    (void)state;
    assert_int_equal(
        sheet_grow(run, &dual, &all, s.area / 2, 1, &few), OSDTEX_OK);
    assert_int_equal(
        sheet_grow(run, &dual, &all, s.area / 30, 1, &many), OSDTEX_OK);
    assert_true(
        chart_joint(b, &few.clusters[0]).distortion >
        chart_joint(b, &many.clusters[0]).distortion + 0.05);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(charts_stay_discs_where_the_surface_closes),
        cmocka_unit_test(developable_sheets_flatten_without_stretch),
        cmocka_unit_test(the_collar_is_no_wider_than_asked),
        cmocka_unit_test(what_is_not_developable_says_so),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
