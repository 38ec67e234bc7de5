/* test_convexity.c -- curvature of what is known. */
#include "meshes.h"
#include "surface/convexity.h"

/* The octahedron's limit is not round; its corners lie further out and are
 * bent more than the middles of its faces. */
static void
a_convex_surface_bends_outwards(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_octahedron(run);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;
    double *out;

    (void)state;
    options.scheme = OTX_SCHEME_LOOP;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 3);
    out = OTX_NEW(run->arena, double, otx_surface_leaf(&s)->vert_count);
    assert_int_equal(otx_convexity(run, &s, 0.0, out), OSDTEX_OK);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
        assert_true(out[v] > 0.0);
    test_run_destroy(run);
}

/* A sphere has the curvature of its radius. */
static void
spheres_have_their_radius(void **state)
{
    otx_run *run = test_run_create();
    otx_surface s;
    otx_cage cage;
    double *out, radius;

    (void)state;
    assert_int_equal(
        mesh_cage_from_file(run, "models/cages/sphere.obj", &cage), OSDTEX_OK);
    s = mesh_refine(run, &cage, 2);
    out = OTX_NEW(run->arena, double, otx_surface_leaf(&s)->vert_count);
    radius = sqrt(s.area / (4.0 * OTX_PI));
    assert_int_equal(otx_convexity(run, &s, 0.3 * radius, out), OSDTEX_OK);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
        assert_true(fabs(out[v] * radius - 1.0) < 0.15);
    test_run_destroy(run);
}

static void
planes_do_not_bend(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 2);
    double *out = OTX_NEW(run->arena, double, otx_surface_leaf(&s)->vert_count);

    (void)state;
    assert_int_equal(otx_convexity(run, &s, 1.0, out), OSDTEX_OK);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
        assert_true(fabs(out[v]) < 1e-6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_convex_surface_bends_outwards),
        cmocka_unit_test(spheres_have_their_radius),
        cmocka_unit_test(planes_do_not_bend),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
