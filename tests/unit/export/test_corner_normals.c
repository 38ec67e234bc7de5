/* test_corner_normals.c -- one normal a vertex, and one a side of what is
 * sharp. */
#include "export/corner_normals.h"
#include "unit/surface/meshes.h"

static otx_surface *
cube(otx_run *run, otx_scheme scheme, int32_t level)
{
    const otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface *s = OTX_NEW(run->arena, otx_surface, 1);

    options.scheme = scheme;
    *cage = mesh_build(run, &in, &options);
    *s = mesh_refine(run, cage, level);
    return s;
}

static void
smooth_corners_have_the_vertex_normal(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = cube(run, OTX_SCHEME_CATMARK, 2);
    const otx_level *leaf = otx_surface_leaf(s);
    otx_corner_normals out;

    (void)state;
    assert_int_equal(otx_corner_normals_build(run, s, &out), OSDTEX_OK);
    assert_int_equal(out.count, leaf->vert_count);
    for (int32_t c = 0; c < leaf->corner_count; ++c)
        for (int k = 0; k < 3; ++k)
            assert_near(
                out.normals[3 * out.indices[c] + k],
                s->normals[3 * leaf->face_verts[c] + k], 1e-6);
    test_run_destroy(run);
}

/* Of a bilinear cube all edges are sharp: each face has its own normal. */
static void
sharp_sides_have_their_own(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = cube(run, OTX_SCHEME_BILINEAR, 2);
    const otx_level *leaf = otx_surface_leaf(s);
    otx_corner_normals out, coarse;

    (void)state;
    assert_int_equal(otx_corner_normals_build(run, s, &out), OSDTEX_OK);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t first = leaf->face_first[f];
        const float *n = out.normals + 3 * out.indices[first];

        assert_near(
            fabs((double)n[0]) + fabs((double)n[1]) + fabs((double)n[2]), 1.0,
            1e-6);
        for (int32_t c = first; c < leaf->face_first[f + 1]; ++c)
            for (int k = 0; k < 3; ++k)
                assert_near(out.normals[3 * out.indices[c] + k], n[k], 1e-6);
    }
    assert_int_equal(otx_corner_normals_of_cage(run, s, &coarse), OSDTEX_OK);
    for (int32_t c = 0; c < s->cage->corner_count; ++c)
        for (int k = 0; k < 3; ++k)
            assert_near(
                coarse.normals[3 * coarse.indices[c] + k],
                coarse.normals[3 * coarse.indices[c / 4 * 4] + k], 1e-6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_corners_have_the_vertex_normal),
        cmocka_unit_test(sharp_sides_have_their_own),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
