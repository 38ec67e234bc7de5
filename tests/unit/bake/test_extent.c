/* test_extent.c -- blocks have the faces' proportions and areas. */
#include "unit/surface/meshes.h"

#include "bake/extent.h"

/* A grid of one quad, stretched to width x height. */
static otx_surface
sheet(otx_run *run, float width, float height, int32_t level)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_cage_input in = mesh_grid(run, 1);
    float *points = OTX_NEW(run->arena, float, 3 * in.vert_count);

    for (int32_t i = 0; i < 3 * in.vert_count; ++i)
        points[i] = in.points[i] * (i % 3 == 0   ? width
                                    : i % 3 == 1 ? height
                                                 : 1.0f);
    in.points = points;
    options.scheme = OTX_SCHEME_BILINEAR;
    *cage = mesh_build(run, &in, &options);
    return mesh_refine(run, cage, level);
}

static void
a_rectangle_gets_its_sides(void **state)
{
    (void)state;
    for (int32_t level = 0; level < 4; ++level)
    {
        otx_run *run = test_run_create();
        const otx_surface surface = sheet(run, 6.0f, 1.5f, level);
        double extent[2];

        assert_int_equal(otx_extent_measure(run, &surface, extent), OSDTEX_OK);
        assert_true(fabs(extent[0] - 6.0) < 1e-5);
        assert_true(fabs(extent[1] - 1.5) < 1e-5);
        test_run_destroy(run);
    }
}

static void
needles_have_a_limit(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface surface = sheet(run, 1000.0f, 0.1f, 1);
    double extent[2];

    (void)state;
    assert_int_equal(otx_extent_measure(run, &surface, extent), OSDTEX_OK);
    assert_true(fabs(extent[0] / extent[1] - 16.0) < 1e-4);
    assert_true(fabs(extent[0] - 1000.0) < 1e-2);
    test_run_destroy(run);
}

/* A face without extent among others has a block without any, not NaN. */
static void
a_point_is_no_danger(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface whole = sheet(run, 1.0f, 1.0f, 1);
    otx_surface surface = whole;
    const int32_t count = 3 * otx_surface_leaf(&whole)->vert_count;
    double extent[2];

    (void)state;
    surface.points = OTX_ZNEW(run->arena, float, count);
    assert_int_equal(otx_extent_measure(run, &surface, extent), OSDTEX_OK);
    assert_true(extent[0] == 0.0 && extent[1] == 0.0);
    test_run_destroy(run);
}

/* The part of the block that shows is as large as the face, or somewhat larger:
 * leaves are not all alike. */
static void
triangles_get_the_texels_of_their_area(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_octahedron(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface surface = mesh_refine(run, &cage, 3);
    const otx_level *leaf = otx_surface_leaf(&surface);
    double extents[16], area = 0.0, blocks = 0.0;

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t *v = leaf->face_verts + leaf->face_first[f];

        for (int32_t k = 2; k < otx_level_face_size(leaf, f); ++k)
        {
            const otx_vec3 a = otx_vec3_load(surface.points, v[0]);

            area +=
                0.5 *
                otx_vec3_length(otx_vec3_cross(
                    otx_vec3_sub(otx_vec3_load(surface.points, v[k - 1]), a),
                    otx_vec3_sub(otx_vec3_load(surface.points, v[k]), a)));
        }
    }
    assert_int_equal(cage.face_count, 8);
    assert_int_equal(otx_extent_measure(run, &surface, extents), OSDTEX_OK);
    for (int32_t f = 0; f < 8; ++f)
        blocks += extents[2 * f] * extents[2 * f + 1];
    assert_true(0.5 * blocks >= area && 0.5 * blocks < 1.5 * area);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rectangle_gets_its_sides),
        cmocka_unit_test(needles_have_a_limit),
        cmocka_unit_test(a_point_is_no_danger),
        cmocka_unit_test(triangles_get_the_texels_of_their_area),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
