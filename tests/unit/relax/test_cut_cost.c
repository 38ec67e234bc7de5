/* test_cut_cost.c -- the price of a seam is a metric over what is shown. */
#include "cuts.h"

static void
equal_offers_have_no_seams(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 8, 8, 1.0);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 64, 64, true, 4);
    const int32_t all[4] = {0, 0, 8, 8};
    const otx_offer offers[2] = {
        offer_rectangle(run->arena, surface, 8, all, 0.0, (otx_vec2){1.5, 2.5}),
        /* The same, one picture to the left. */
        offer_rectangle(
            run->arena, surface, 8, all, 0.0, (otx_vec2){-62.5, 2.5})};
    const otx_cut_options options = unit_options();
    int32_t labels[64];
    otx_cut_stats stats;

    (void)state;
    for (int32_t f = 0; f < 64; ++f)
        labels[f] = f % 2;
    assert_int_equal(
        otx_cut_run(
            run, surface, exemplar, offers, 2, &options, labels, &stats),
        OSDTEX_OK);
    assert_true(stats.energy_before == 0.0 && stats.energy_after == 0.0);
    assert_int_equal(stats.changed, 0);
    test_run_destroy(run);
}

/* Offers of one grid that show other places of the picture. */
static void
prices_are_a_metric(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 8, 8, 1.0);
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 64, 64, true, 4);
    const int32_t all[4] = {0, 0, 8, 8};
    const otx_cut_options options = unit_options();
    otx_offer offers[3];
    otx_cut_cost cost;

    (void)state;
    for (int i = 0; i < 3; ++i)
        offers[i] = offer_rectangle(
            run->arena, surface, 8, all, 0.3 * i,
            (otx_vec2){7.5 * i, 3.25 * i});
    cost = otx_cut_cost_create(surface, exemplar, offers, &options);
    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *f = leaf->edge_faces + 2 * e;
        int64_t v[3][3];

        if (f[1] < 0)
            continue;
        for (int32_t a = 0; a < 3; ++a)
            for (int32_t b = 0; b < 3; ++b)
                v[a][b] = otx_cut_cost_edge(
                    &cost, e, (otx_cut_view){a, f[0]}, (otx_cut_view){b, f[1]});
        for (int a = 0; a < 3; ++a)
        {
            assert_true(v[a][a] == 0);
            for (int b = 0; b < 3; ++b)
            {
                assert_true(v[a][b] == v[b][a] && v[a][b] >= 0);
                for (int c = 0; c < 3; ++c)
                    assert_true(v[a][b] <= v[a][c] + v[c][b]);
            }
        }
    }
    test_run_destroy(run);
}

static void
no_patch_costs_more_than_any_seam_around(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 4, 4, 1.0);
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 64, 64, true, 4);
    const int32_t all[4] = {0, 0, 4, 4};
    const otx_cut_options options = unit_options();
    const otx_offer offers[2] = {
        offer_rectangle(run->arena, surface, 4, all, 0.0, (otx_vec2){0, 0}),
        offer_rectangle(run->arena, surface, 4, all, 1.0, (otx_vec2){9, 5})};
    const otx_cut_cost cost =
        otx_cut_cost_create(surface, exemplar, offers, &options);

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int64_t none = otx_cut_cost_face(&cost, f, (otx_cut_view){-1, 0});
        int64_t around = otx_cut_cost_face(&cost, f, (otx_cut_view){0, f});

        for (int k = 0; k < 4; ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);
            const int32_t e = leaf->face_edges[4 * f + k];
            const bool first = leaf->edge_faces[2 * e] == f;
            const otx_cut_view here = {0, f}, there = {1, other};

            if (other >= 0)
                around += otx_cut_cost_edge(
                    &cost, e, first ? here : there, first ? there : here);
        }
        assert_true(none > around);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_offers_have_no_seams),
        cmocka_unit_test(prices_are_a_metric),
        cmocka_unit_test(no_patch_costs_more_than_any_seam_around),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
