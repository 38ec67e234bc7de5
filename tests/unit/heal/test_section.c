/* test_section.c -- seams of a plane in pieces, and windows by the piece that
 * they are near. */
#include "grid.h"

#include "heal/section.h"

enum
{
    SIDE = 96,  /* texels of the exemplar */
    FACES = 24, /* along each side of the plane */
    STEP = 8    /* texels of a face */
};

typedef struct scene
{
    otx_surface *surface;
    otx_seam_list seams;
    otx_target_set set;
} scene;

/* What the right half shows is moved along; the upper right quarter once more,
 * so that three seams meet in the middle. */
static void
set_up(otx_run *run, scene *s)
{
    otx_mapping *mapping;
    otx_exemplar *exemplar;

    s->surface = test_grid_create(run->arena, FACES, FACES, STEP);
    exemplar = test_exemplar_create(run->arena, SIDE, SIDE, true, 1);
    mapping = test_mapping_create(run->arena, s->surface, exemplar, 1.0, 0);
    for (int32_t c = 0; c < otx_surface_leaf(s->surface)->corner_count; ++c)
    {
        const int32_t face = c / 4;
        const bool right = face % FACES >= FACES / 2;
        const bool upper = face / FACES >= FACES / 2;

        mapping->uvs[2 * c + 1] += right ? upper ? 0.4f : 0.2f : 0.0f;
    }
    s->set = (otx_target_set){
        .run = run,
        .mapping = mapping,
        .exemplars = exemplar,
        .texels = otx_seam_texels_per_unit(mapping, exemplar)};
    assert_int_equal(
        otx_seam_collect(run, mapping, exemplar, &s->seams), OSDTEX_OK);
}

static void
pieces_end_where_three_seams_meet(void **state)
{
    otx_run *run = *state;
    scene s;
    otx_section_list list;
    double sum = 0.0;

    set_up(run, &s);
    assert_int_equal(
        otx_section_find(
            run, otx_surface_leaf(s.surface), &s.seams, 1e9, &list),
        OSDTEX_OK);
    assert_int_equal(list.count, 3);
    for (int32_t i = 0; i < list.count; ++i)
    {
        assert_float_equal(list.lengths[i], FACES / 2 * STEP, 1e-3);
        sum += list.lengths[i];
    }
    assert_float_equal(sum, s.seams.total_length, 1e-3);
    for (int32_t i = 0; i < s.seams.edge_count; ++i)
        assert_in_range(list.of_edge[s.seams.edges[i]], 0, list.count - 1);
}

static void
pieces_are_no_longer_than_asked(void **state)
{
    otx_run *run = *state;
    scene s;
    otx_section_list list;

    set_up(run, &s);
    assert_int_equal(
        otx_section_find(
            run, otx_surface_leaf(s.surface), &s.seams, 33.0, &list),
        OSDTEX_OK);
    assert_in_range(list.count, 9, 3 * FACES / 2);
    for (int32_t i = 0; i < list.count; ++i)
        assert_true(list.lengths[i] <= 33.0);
}

/* Windows say how far they are from the left of their chart: each is counted
 * for the pieces within reach, or beyond all. */
static void
windows_go_to_the_pieces_that_are_near(void **state)
{
    otx_run *run = *state;
    scene s;
    otx_section_list list;
    int64_t near_all = 0, beyond_all = 0, windows = 0;
    otx_section_sum *sums;

    set_up(run, &s);
    assert_int_equal(
        otx_section_find(
            run, otx_surface_leaf(s.surface), &s.seams, 1e9, &list),
        OSDTEX_OK);
    assert_int_equal(otx_target_set_lay_out(&s.set, 400.0, 20.0), OSDTEX_OK);
    sums = OTX_ZNEW(run->arena, otx_section_sum, list.count);
    for (int32_t k = 0; k < s.set.territory.count; ++k)
    {
        const otx_plot *plot = &s.set.plots[k];
        otx_judged j = {plot->width / 4, plot->height / 4, 4.0f, 4.0f, NULL};
        double *beyond;
        int64_t count;

        j.distances = OTX_NEW(run->arena, float, j.width *j.height);
        beyond = OTX_NEW(run->arena, double, j.width *j.height);
        for (int32_t i = 0; i < j.width * j.height; ++i)
        {
            const int32_t at =
                (4 * (i / j.width) + 2) * plot->width + 4 * (i % j.width) + 2;
            const bool own =
                plot->facets[at] >= 0 &&
                plot->facets[at] / OTX_PLOT_FACETS < plot->chart->core_count;

            j.distances[i] = own ? 2.0f : -1.0f;
            windows += own;
        }
        assert_int_equal(
            otx_section_measure(&s.set, k, &j, &list, 16.0, sums), OSDTEX_OK);
        assert_int_equal(
            otx_section_beyond(&s.set, k, &j, &list, 16.0, beyond, &count),
            OSDTEX_OK);
        beyond_all += count;
    }
    for (int32_t i = 0; i < list.count; ++i)
    {
        assert_float_equal(sums[i].sum, 2.0 * (double)sums[i].count, 1e-9);
        /* A piece of 96 texels has 96 * 32 around it, and half a disc. */
        assert_in_range(sums[i].count, 160, 260);
        near_all += sums[i].count;
    }
    /* Where pieces meet windows count for each. */
    assert_in_range(near_all, windows - beyond_all, windows - beyond_all + 120);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            pieces_end_where_three_seams_meet, test_run_setup,
            test_run_teardown),
        cmocka_unit_test_setup_teardown(
            pieces_are_no_longer_than_asked, test_run_setup, test_run_teardown),
        cmocka_unit_test_setup_teardown(
            windows_go_to_the_pieces_that_are_near, test_run_setup,
            test_run_teardown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
