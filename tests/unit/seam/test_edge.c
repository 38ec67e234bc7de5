/* test_edge.c -- which corners an edge has, and what counts as a seam. */
#include "grid.h"

#include "seam/edge.h"
#include "seam/unit.h"

static void
corners_of_an_edge_follow_the_edge(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, 3, 3, 1.0);
    const otx_level *leaf = otx_surface_leaf(surface);

    (void)state;
    for (int32_t e = 0; e < leaf->edge_count; ++e)
        for (int f = 0; f < 2 && leaf->edge_faces[2 * e + f] >= 0; ++f)
        {
            int32_t corners[2];

            otx_seam_corners(leaf, e, leaf->edge_faces[2 * e + f], corners);
            for (int k = 0; k < 2; ++k)
                assert_int_equal(
                    leaf->face_verts[corners[k]], leaf->edge_verts[2 * e + k]);
        }
    test_run_destroy(run);
}

static void
whole_pictures_are_no_seam_where_it_tiles(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar *exemplar = test_exemplar_create(run->arena, 32, 16, true, 1);
    const otx_vec2 a[2] = {{1.0, 2.0}, {5.0, 2.0}};
    const otx_vec2 b[2] = {{33.0, -14.0}, {37.0, -14.0}};
    const otx_vec2 torn[2] = {{33.0, -14.0}, {5.0, 2.0}};
    const otx_vec2 nan[2] = {{NAN, 2.0}, {5.0, 2.0}};

    (void)state;
    assert_true(otx_seam_continuous(exemplar, a, a));
    assert_true(otx_seam_continuous(exemplar, a, b));
    assert_false(otx_seam_continuous(exemplar, a, torn));
    assert_false(otx_seam_continuous(exemplar, a, nan));
    exemplar->wrap_y = false;
    assert_false(otx_seam_continuous(exemplar, a, b));
    exemplar->wrap_x = false;
    assert_true(otx_seam_continuous(exemplar, a, a));
    test_run_destroy(run);
}

static void
samples_are_one_a_texel(void **state)
{
    (void)state;
    assert_int_equal(otx_seam_sample_count(NAN), 2);
    assert_int_equal(otx_seam_sample_count(0.0), 2);
    assert_int_equal(otx_seam_sample_count(7.2), 8);
    assert_int_equal(otx_seam_sample_count(1e30), OTX_SEAM_SAMPLES_MAX);
}

static void
scale_and_texels_are_inverse(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 32, 16, true, 1);

    (void)state;
    assert_float_equal(otx_unit_texels(exemplar, 8.0), 4.0, 0.0);
    assert_float_equal(
        otx_unit_scale(exemplar, otx_unit_texels(exemplar, 3.7)), 3.7, 1e-12);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_of_an_edge_follow_the_edge),
        cmocka_unit_test(whole_pictures_are_no_seam_where_it_tiles),
        cmocka_unit_test(samples_are_one_a_texel),
        cmocka_unit_test(scale_and_texels_are_inverse),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
