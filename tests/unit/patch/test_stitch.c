/* test_stitch.c -- cutting and relaxing lower what they are for, and leave
 * nothing uncovered. */
#include "unit/patch/mosaics.h"

static void
both_lower_the_energy(void **state)
{
    otx_run *run = test_run_create();
    otx_mosaic *m = mosaic_begin(run, "torus", OTX_PATCH_GROWN);
    const otx_level *leaf = m->job.leaves.level;

    (void)state;
    m->job.settings.sweeps = 3;
    m->job.settings.relax_rounds = 6;
    m->job.settings.stiffness = 0.3;
    mosaic_fit(m);
    assert_int_equal(otx_stitch_run(m), OSDTEX_OK);
    assert_true(m->tally.cut_before > 0.0);
    assert_true(m->tally.cut_after < m->tally.cut_before);
    assert_true(m->tally.relax_after < m->tally.relax_before);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        assert_true(
            m->cover.face_patch[f] >= 0 &&
            m->cover.face_patch[f] < m->cover.patch_count);
    for (int32_t i = 0; i < m->forest.count; ++i)
        assert_null(m->forest.nodes[i].arena);
    test_run_destroy(run);
}

/* What is switched off changes nothing. */
static void
without_either_all_stays(void **state)
{
    otx_run *run = test_run_create();
    otx_mosaic *m = mosaic_begin(run, "torus", OTX_PATCH_GROWN);
    const otx_level *leaf = m->job.leaves.level;
    const size_t bytes = (size_t)leaf->corner_count * sizeof(otx_vec2);
    otx_vec2 *before = OTX_NEW(run->arena, otx_vec2, leaf->corner_count);

    (void)state;
    m->job.settings.cut = OTX_PATCH_OFF;
    m->job.settings.relax = OTX_PATCH_RELAX_OFF;
    mosaic_fit(m);
    memcpy(before, m->cover.uvs, bytes);
    assert_int_equal(otx_stitch_run(m), OSDTEX_OK);
    assert_memory_equal(before, m->cover.uvs, bytes);
    assert_true(m->tally.cut_before == 0.0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_lower_the_energy),
        cmocka_unit_test(without_either_all_stays),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
