/* test_limit.c -- limits by hand, by symmetry and by the rules of borders. */
#include "meshes.h"

/* Float's resolution after a few hundred operations on numbers near 1. */
static const double tolerance = 2e-5;

/* A cube's limit under Catmull-Clark, by hand. At a vertex of valence 3,
 * (9 v + 4 (e1 + e2 + e3) + (f1 + f2 + f3)) / 24 over the neighbours along the
 * edges and across the faces: 9 + 4 - 3 = 10 in every coordinate, less one
 * for the far corners: (9 + 4 (1 + 1 - 1) + (1 - 1 - 1)) / 24 = 1/2. */
static void
test_cube_limit(void **state)
{
    (void)state;
    for (int32_t level = 0; level <= 4; ++level)
    {
        otx_run *run = test_run_create();
        const otx_cage_input in = mesh_cube(run);
        const otx_cage cage = mesh_build(run, &in, NULL);
        const otx_surface s = mesh_refine(run, &cage, level);

        for (int32_t i = 0; i < 24; ++i)
        {
            assert_near(s.points[i], 0.5 * cube_points[i], tolerance);
            assert_near(s.normals[i], cube_points[i] / sqrt(3.0), tolerance);
        }
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
        assert_int_equal(otx_surface_leaf(&s)->face_count, 6 << (2 * level));
        test_run_destroy(run);
    }
}

/* Loop's limit at a vertex of valence n: (v + n w mean) / (1 + n w) with
 * w = 8 beta / 3; of an octahedron the neighbours' mean is the centre. */
static void
test_octahedron_limit(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_octahedron(run);
    otx_cage_options options = otx_cage_options_default();
    const double c = 0.375 + 0.25 * cos(OTX_PI / 2.0);
    const double beta = (0.625 - c * c) / 4.0;
    const double shrink = 1.0 / (1.0 + 4.0 * 8.0 * beta / 3.0);
    otx_surface s;
    otx_cage cage;

    (void)state;
    options.scheme = OTX_SCHEME_LOOP;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 3);
    for (int32_t i = 0; i < 18; ++i)
    {
        assert_near(s.points[i], shrink * octahedron_points[i], tolerance);
        assert_near(s.normals[i], octahedron_points[i], tolerance);
    }
    assert_int_equal(s.levels[0].face_child_vert[0], -1);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    test_run_destroy(run);
}

/* refine(A cage) = A refine(cage) for an affine map A. */
static void
test_refinement_commutes_with_affine_maps(void **state)
{
    static const double a[3][4] = {
        {1.5, -0.25, 0.5, 3.0}, {0.125, 0.75, -1.0, -2.0}, {0.5, 1, 2, 0.5}};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    float mapped[24];
    otx_cage cages[2];
    otx_surface s, t;

    (void)state;
    cages[0] = mesh_build(run, &in, NULL);
    for (int32_t v = 0; v < 8; ++v)
    {
        const float *p = cube_points + 3 * v;

        for (int32_t k = 0; k < 3; ++k)
            mapped[3 * v + k] =
                (float)(a[k][0] * p[0] + a[k][1] * p[1] + a[k][2] * p[2] + a[k][3]);
    }
    in.points = mapped;
    cages[1] = mesh_build(run, &in, NULL);
    s = mesh_refine(run, &cages[0], 4);
    t = mesh_refine(run, &cages[1], 4);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
    {
        const float *p = s.points + 3 * v;

        for (int32_t k = 0; k < 3; ++k)
            assert_near(
                t.points[3 * v + k],
                a[k][0] * p[0] + a[k][1] * p[1] + a[k][2] * p[2] + a[k][3],
                tolerance);
    }
    test_run_destroy(run);
}

static void
test_flat_stays_flat(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 5);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 3);
    const int32_t count = otx_surface_leaf(&s)->vert_count;

    (void)state;
    for (int32_t v = 0; v < count; ++v)
    {
        assert_true(s.points[3 * v + 2] == 0.0f);
        assert_true(s.normals[3 * v + 2] == 1.0f);
    }
    /* Edge and corner: the square keeps its outline. */
    assert_near(s.area, 25.0, 1e-4);
    test_run_destroy(run);
}

static void
test_boundary_rules(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;
    int32_t holes = 0;

    (void)state;
    options.boundary = OTX_BOUNDARY_EDGE_ONLY;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 3);
    assert_true(s.points[0] > 0.01f);
    assert_true(s.area < 15.95);

    options.boundary = OTX_BOUNDARY_NONE;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 2);
    for (int32_t f = 0; f < 16; ++f)
        holes += s.levels[0].face_hole[f];
    assert_int_equal(holes, 12);
    assert_near(s.area, 4.0, 0.1);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    {
        const otx_cage_input small = mesh_grid(run, 2);

        cage = mesh_build(run, &small, &options);
        assert_int_equal(
            otx_surface_refine(run, &cage, 2, 0, &s), OSDTEX_ERROR_TOPOLOGY);
        assert_non_null(strstr(test_last_message(run), "edgeAndCorner"));
    }
    test_run_destroy(run);
}

/* The cube's limit at its corner 0, whose edges are creased by `sharpness`. */
static double
creased_corner(float sharpness, bool chaikin)
{
    static const int32_t creases[] = {0, 1, 0, 2, 0, 6};
    const float all[] = {sharpness, sharpness, sharpness};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;
    double x;

    options.crease_chaikin = chaikin;
    in.crease_verts = creases;
    in.crease_sharpness = all;
    in.crease_count = 3;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 5);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    x = -s.points[0];
    test_run_destroy(run);
    return x;
}

static void
test_creases(void **state)
{
    double last = 0.5;

    (void)state;
    assert_near(creased_corner(0.0f, false), 0.5, tolerance);
    assert_near(creased_corner(10.0f, false), 1.0, tolerance);
    assert_near(creased_corner(INFINITY, false), 1.0, tolerance);
    for (int32_t i = 1; i <= 4; ++i)
    {
        const double x = creased_corner((float)i, false);

        assert_true(x > last + 1e-4 && x < 1.0);
        last = x;
    }
}

/* Chaikin's rule averages sharpness along a crease; it tells from the uniform
 * rule where two sharpnesses meet. */
static void
test_chaikin(void **state)
{
    static const int32_t creases[] = {0, 1, 1, 3, 3, 2, 2, 0};
    static const float sharpness[] = {1.0f, 3.0f, 1.0f, 3.0f};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_cage cages[2];
    otx_surface s, t;
    double difference = 0.0;

    (void)state;
    in.crease_verts = creases;
    in.crease_sharpness = sharpness;
    in.crease_count = 4;
    cages[0] = mesh_build(run, &in, &options);
    options.crease_chaikin = 1;
    cages[1] = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cages[0], 4);
    t = mesh_refine(run, &cages[1], 4);
    for (int32_t i = 0; i < 3 * otx_surface_leaf(&s)->vert_count; ++i)
        difference = fmax(difference, fabs(s.points[i] - t.points[i]));
    assert_true(difference > 1e-3);
    assert_int_equal(otx_surface_validate(run, &t), OSDTEX_OK);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cube_limit),
        cmocka_unit_test(test_octahedron_limit),
        cmocka_unit_test(test_refinement_commutes_with_affine_maps),
        cmocka_unit_test(test_flat_stays_flat),
        cmocka_unit_test(test_boundary_rules),
        cmocka_unit_test(test_creases),
        cmocka_unit_test(test_chaikin),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
