/* test_seam.c -- what counts as a seam, and what is seen along it. */
#include "grid.h"

#include "mapping/seam.h"

static void
one_chart_has_no_seam_and_a_moved_face_has_four(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 3, 3, 0.5);
    otx_exemplar *exemplar = test_exemplar_create(run->arena, 64, 64, true, 3);
    otx_mapping *mapping =
        test_mapping_create(run->arena, surface, exemplar, 16.0, 50.0);
    otx_seam_list list;

    (void)state;
    assert_int_equal(
        otx_seam_collect(run, mapping, exemplar, &list), OSDTEX_OK);
    assert_int_equal(list.edge_count, 0);
    assert_float_equal(list.interior_length, 12 * 8.0, 1e-4);

    /* Left half black, right half Delta E 10: the middle face looks up the
     * other half. */
    for (int32_t i = 0; i < 64 * 64; ++i)
    {
        float *texel = exemplar->lab.pixels + 3 * i;

        texel[0] = i % 64 < 32 ? 0.0f : 6.0f;
        texel[1] = 0.0f;
        texel[2] = i % 64 < 32 ? 0.0f : 8.0f;
    }
    mapping = test_mapping_create(run->arena, surface, exemplar, 16.0, 4.0);
    for (int32_t c = 16; c < 20; ++c)
        mapping->uvs[2 * c] += 0.5f;
    assert_int_equal(
        otx_seam_collect(run, mapping, exemplar, &list), OSDTEX_OK);
    assert_int_equal(list.edge_count, 4);
    assert_float_equal(list.total_length, 4 * 8.0, 1e-4);
    assert_int_equal(list.sample_first[4], 4 * 8);
    for (int32_t i = 0; i < 32; ++i)
        assert_float_equal(list.samples[i], 10.0, 1e-4);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_chart_has_no_seam_and_a_moved_face_has_four),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
