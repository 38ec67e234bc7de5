/* test_region.c -- regions laid out below their control polygons: exact on the
 * plane, whatever their borders look like, and whole on every cage. */
#include "unit/flatten/charts.h"

typedef struct region_bench
{
    otx_surface surface;
    otx_dual dual;
    otx_cluster_tree tree;
    otx_controls controls;
} region_bench;

static region_bench *
regions(otx_run *run, otx_surface surface, int32_t level, double count)
{
    region_bench *b = OTX_ZNEW(run->arena, region_bench, 1);
    const otx_cluster_part part = {
        sheet_all(run, &surface, level), surface.area / count};

    b->surface = surface;
    b->dual = sheet_dual(run, &b->surface, level);
    assert_int_equal(
        otx_cluster_tree_create(
            run, &b->surface, &b->dual, 1.0, &part, 1, &b->tree),
        OSDTEX_OK);
    assert_int_equal(otx_controls_find(run, &b->tree, &b->controls), OSDTEX_OK);
    return b;
}

static otx_chart
flatten(chart_bench *b, const region_bench *r, int32_t node)
{
    const otx_cluster cluster = otx_cluster_tree_node(&r->tree, node);
    otx_chart chart;

    assert_int_equal(
        otx_recursive_build(
            &b->request, &r->controls, &cluster, &b->space, b->run->scratch,
            b->run->arena, &chart),
        OSDTEX_OK);
    chart_check_space(b);
    return chart;
}

static void
regions_of_a_plane_come_out_exactly(void **state)
{
    otx_run *run = test_run_create();
    const region_bench *r =
        regions(run, sheet_create(run, 24, 20, SHEET_FLAT), 0, 7.0);
    chart_bench *b = chart_bench_create(run, &r->surface, 16.0, 50.0);

    (void)state;
    for (int32_t i = 1; i < r->tree.count; ++i)
    {
        const otx_chart chart = flatten(b, r, i);

        chart_check(b, &chart);
        assert_int_equal(
            chart.core_count, r->tree.nodes[i].end - r->tree.nodes[i].first);
        assert_true(chart_worst(b, &chart) < 1.0 + 1e-5);
        assert_true(fabs(chart.distortion - 1.0) < 1e-5);
    }
    test_run_destroy(run);
}

/* Control vertices are those that three clusters share, and at least three. */
static void
regions_have_control_polygons(void **state)
{
    static const char *const cages[] = {
        "creature", "torus", "sphere", "open_boundary", "several_components"};

    (void)state;
    for (int32_t c = 0; c < COUNT(cages); ++c)
    {
        otx_run *run = test_run_create();
        char path[128];
        region_bench *r;

        snprintf(path, sizeof path, "models/cages/%s.obj", cages[c]);
        r = regions(run, sheet_from_file(run, path, 2), 1, 12.0);
        for (int32_t i = 1; i < r->tree.count; ++i)
        {
            const otx_cluster_node *n = &r->tree.nodes[i];
            otx_outline o;

            if (n->end - n->first == 1)
                continue;
            assert_int_equal(
                otx_outline_trace(&r->controls, i, n->level, run->scratch, &o),
                OSDTEX_OK);
            assert_true(o.control_count >= 3);
            assert_int_equal(o.controls[0], 0);
            /* Between two control vertices there is one neighbour. */
            for (int32_t k = 1; k < o.count; ++k)
                if (r->controls.vert_level[o.verts[k]] > n->level)
                    assert_int_equal(
                        otx_controls_cluster(
                            &r->controls, o.outside[k - 1], n->level),
                        otx_controls_cluster(
                            &r->controls, o.outside[k], n->level));
        }
        test_run_destroy(run);
    }
}

/* All of a region is laid out, and small regions are laid out well. */
static void
smaller_regions_are_flatter(void **state)
{
    otx_run *run = test_run_create();
    const region_bench *r = regions(
        run, sheet_from_file(run, "models/cages/sphere.obj", 4), 3, 40.0);
    chart_bench *b = chart_bench_create(run, &r->surface, 100.0, 10.0);
    double sum[2] = {0.0, 0.0};
    int32_t count[2] = {0, 0};

    (void)state;
    for (int32_t i = 1; i < r->tree.count; ++i)
    {
        const int32_t level = r->tree.nodes[i].level;

        if (level != 1 && level != 3)
            continue;
        sum[level == 3] += fmin(1.0, flatten(b, r, i).distortion - 1.0);
        ++count[level == 3];
    }
    assert_true(count[0] > 20 && count[1] > 80);
    assert_true(sum[0] / count[0] < 0.15);
    assert_true(sum[1] / count[1] < 0.5 * sum[0] / count[0]);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_of_a_plane_come_out_exactly),
        cmocka_unit_test(regions_have_control_polygons),
        cmocka_unit_test(smaller_regions_are_flatter),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
