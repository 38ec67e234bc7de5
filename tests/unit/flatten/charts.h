/* charts.h -- building charts in tests, and checking what holds for all. */
#ifndef OTX_TESTS_CHARTS_H
#define OTX_TESTS_CHARTS_H

#include "unit/cluster/sheets.h"

#include "flatten/chart.h"
#include "flatten/recursive.h"

typedef struct chart_bench
{
    otx_run *run;
    const otx_surface *surface;
    otx_dual leaves;
    otx_chart_space space;
    otx_chart_request request;
} chart_bench;

static inline chart_bench *
chart_bench_create(
    otx_run *run, const otx_surface *surface, double texels, double collar)
{
    chart_bench *b = OTX_ZNEW(run->arena, chart_bench, 1);

    b->run = run;
    b->surface = surface;
    b->leaves = sheet_dual(run, surface, surface->level_count - 1);
    assert_int_equal(
        otx_chart_space_create(run, run->arena, surface, &b->space), OSDTEX_OK);
    b->request = (otx_chart_request){
        .surface = surface,
        .leaves = &b->leaves,
        .texels = texels,
        .collar = collar,
        .bend = 1.0,
        .rounds = 5,
    };
    return b;
}

static inline void
chart_check_space(const chart_bench *b)
{
    const otx_level *leaf = otx_surface_leaf(b->surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
        assert_int_equal(b->space.face_slot[f], -1);
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        assert_int_equal(b->space.vert_slot[v], -1);
}

static inline otx_chart
chart_joint(chart_bench *b, const otx_cluster *cluster)
{
    int32_t count;
    const int32_t *core =
        otx_cluster_leaves(b->run->arena, b->surface, cluster, &count);
    otx_chart chart;

    assert_int_equal(
        otx_chart_build(
            &b->request, core, count, &b->space, b->run->scratch, b->run->arena,
            &chart),
        OSDTEX_OK);
    chart_check_space(b);
    return chart;
}

static inline otx_chart
chart_recursive(chart_bench *b, int32_t level, int32_t face)
{
    otx_chart chart;

    const otx_cluster cluster = {level, 1, &face, 1.0, -1};

    assert_int_equal(
        otx_recursive_build(
            &b->request, NULL, &cluster, &b->space, b->run->scratch,
            b->run->arena, &chart),
        OSDTEX_OK);
    chart_check_space(b);
    return chart;
}

/* Corners name the vertices of their leaves, no leaf comes twice, the core
 * comes first and reaches nowhere. */
static inline void
chart_check(const chart_bench *b, const otx_chart *chart)
{
    const otx_level *leaf = otx_surface_leaf(b->surface);
    uint8_t *seen = OTX_ZNEW(b->run->scratch, uint8_t, leaf->face_count);

    for (int32_t i = 0; i < chart->face_count; ++i)
    {
        const int32_t face = chart->faces[i];

        assert_false(seen[face]);
        seen[face] = 1;
        assert_int_equal(
            chart->first[i + 1] - chart->first[i],
            otx_level_face_size(leaf, face));
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
        {
            assert_in_range(chart->corners[c], 0, chart->vert_count - 1);
            assert_int_equal(
                chart->verts[chart->corners[c]],
                leaf->face_verts[leaf->face_first[face] + c - chart->first[i]]);
        }
        if (i < chart->core_count)
            assert_true(chart->reach[i] == 0.0f);
        else
            assert_true(chart->reach[i] > 0.0f);
    }
    for (int32_t v = 0; v < chart->vert_count; ++v)
        assert_true(isfinite(chart->flat[v].x) && isfinite(chart->flat[v].y));
}

/* The larger of stretch and its inverse over all faces. */
static inline double
chart_worst(const chart_bench *b, const otx_chart *chart)
{
    double worst = 1.0;

    for (int32_t i = 0; i < chart->face_count; ++i)
    {
        double s[2];

        otx_chart_face_stretch(chart, b->surface, b->request.texels, i, s);
        worst = fmax(worst, s[1] > 0.0 ? fmax(s[0], 1.0 / s[1]) : INFINITY);
    }
    return worst;
}

#endif
