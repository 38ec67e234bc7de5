/* test_fit.c -- looking clusters up changes nothing, and a patch is made of a
 * cluster's own leaves, as its chart has them. */
#include "unit/patch/mosaics.h"

static void
looking_up_changes_nothing_that_is_textured(void **state)
{
    otx_run *run = test_run_create();
    otx_mosaic *m = mosaic_begin(run, "torus", OTX_PATCH_GROWN);
    const otx_level *leaf = m->job.leaves.level;
    const size_t bytes = (size_t)leaf->corner_count * sizeof(otx_vec2);
    otx_fit fits[2] = {{.node = 0}, {.node = 1}};
    otx_vec2 *before = OTX_NEW(run->arena, otx_vec2, leaf->corner_count);

    (void)state;
    assert_int_equal(otx_forest_settle(m, 0), OSDTEX_OK);
    memcpy(before, m->cover.uvs, bytes);
    assert_int_equal(otx_fit_find(m, fits, 2), OSDTEX_OK);
    assert_memory_equal(before, m->cover.uvs, bytes);
    assert_int_equal(m->cover.patch_count, 0);
    assert_true(fits[0].found && !fits[0].searched);
    test_run_destroy(run);
}

static void
a_patch_is_its_chart_moved_rigidly(void **state)
{
    otx_run *run = test_run_create();
    otx_mosaic *m = mosaic_begin(run, "torus", OTX_PATCH_GROWN);
    const otx_level *leaf = m->job.leaves.level;
    int32_t node = 0, covered = 0;
    const otx_chart *chart;

    (void)state;
    assert_int_equal(otx_forest_settle(m, 0), OSDTEX_OK);
    while (m->forest.nodes[node].retired)
        ++node;

    otx_fit fit = {.node = node};

    assert_int_equal(otx_fit_find(m, &fit, 1), OSDTEX_OK);
    assert_true(otx_fit_commit(m, &fit));
    chart = &m->forest.nodes[node].chart;
    for (int32_t i = 0; i < chart->core_count; ++i)
        for (int32_t c = chart->first[i] + 1; c < chart->first[i + 1]; ++c)
        {
            const int32_t at = leaf->face_first[chart->faces[i]];
            const otx_vec2 flat = otx_vec2_sub(
                chart->flat[chart->corners[c]],
                chart->flat[chart->corners[chart->first[i]]]);
            const otx_vec2 uv = otx_vec2_sub(
                m->cover.uvs[at + c - chart->first[i]], m->cover.uvs[at]);

            assert_float_equal(
                otx_vec2_length(uv), otx_vec2_length(flat), 1e-9);
        }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        covered += m->cover.face_patch[f] == 0;
    assert_int_equal(covered, m->forest.nodes[node].leaf_count);
    assert_float_equal(
        m->cover.done_area, m->forest.nodes[node].cluster.area, 1e-9);
    test_run_destroy(run);
}

static void
all_is_covered_in_the_end(void **state)
{
    static const char *const cages[] = {"torus", "hole", "open_boundary"};

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        otx_run *run = test_run_create();
        otx_mosaic *m = mosaic_begin(run, cages[i], OTX_PATCH_GROWN);
        const otx_level *leaf = m->job.leaves.level;

        mosaic_fit(m);
        for (int32_t f = 0; f < leaf->face_count; ++f)
            assert_int_equal(
                m->cover.face_patch[f] < 0, leaf->face_hole[f] != 0);
        assert_true(m->tally.fits > 0);
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looking_up_changes_nothing_that_is_textured),
        cmocka_unit_test(a_patch_is_its_chart_moved_rigidly),
        cmocka_unit_test(all_is_covered_in_the_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
