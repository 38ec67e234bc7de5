/* test_seam.c -- what counts as a seam, and what is seen along it. */
#include "grid.h"

#include "mapping/seam.h"

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

/* The quick path inside the picture, the wrapping and the clamping one all
 * equal the sampler of image.c. */
static void
samples_equal_those_of_the_picture(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 16, 12, true, 2);
    const otx_image *image = &exemplar->lab;

    (void)state;
    for (uint64_t i = 0; i < 400; ++i)
    {
        otx_vec2 side[2];
        float colors[3 * 5], expected[3];
        const bool wrap = i % 2 == 0;

        for (uint64_t k = 0; k < 2; ++k)
            side[k] = (otx_vec2){
                60.0 * otx_random_unit(1, 1, 4 * i + k) - 20.0,
                60.0 * otx_random_unit(1, 1, 4 * i + k + 2) - 20.0};
        if (i % 5 == 0)
            side[1] = otx_vec2_lerp(side[0], side[1], 0.02);
        otx_seam_sample(image, wrap, wrap, side, 0.0, 5, colors);
        for (int k = 0; k < 5; ++k)
        {
            otx_image_sample(
                image, wrap, wrap,
                otx_vec2_lerp(side[0], side[1], (k + 0.5) / 5), expected);
            for (int c = 0; c < 3; ++c)
                assert_float_equal(colors[3 * k + c], expected[c], 1e-3);
        }
    }
    test_run_destroy(run);
}

static void
an_offset_lies_to_the_left(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar *exemplar = test_exemplar_create(run->arena, 8, 8, false, 2);
    const otx_vec2 side[2] = {{2.0, 3.0}, {6.0, 3.0}};
    float colors[3];

    (void)state;
    for (int32_t i = 0; i < 64; ++i)
        exemplar->lab.pixels[3 * i] = (float)(i / 8 + 0.5);
    otx_seam_sample(&exemplar->lab, false, false, side, 1.25, 1, colors);
    assert_float_equal(colors[0], 4.25, 1e-5);
    test_run_destroy(run);
}

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
        cmocka_unit_test(corners_of_an_edge_follow_the_edge),
        cmocka_unit_test(whole_pictures_are_no_seam_where_it_tiles),
        cmocka_unit_test(samples_equal_those_of_the_picture),
        cmocka_unit_test(an_offset_lies_to_the_left),
        cmocka_unit_test(one_chart_has_no_seam_and_a_moved_face_has_four),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
