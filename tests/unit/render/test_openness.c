/* test_openness.c -- what a surface hides of its own sky. */
#include "render/openness.h"
#include "unit/surface/meshes.h"

static double *
openness_of(otx_run *run, const otx_surface *s)
{
    double *out = OTX_NEW(run->arena, double, otx_surface_leaf(s)->vert_count);

    assert_int_equal(otx_openness(run, s, out), OSDTEX_OK);
    return out;
}

static void
a_plane_hides_nothing(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 1);
    const double *open = openness_of(run, &s);

    (void)state;
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
        assert_true(open[v] == 1.0);
    test_run_destroy(run);
}

/* Two sheets that face each other, far apart and near. */
static double
between_sheets(otx_run *run, float gap)
{
    const float points[] = {0, 0, 0,   1, 0, 0,   1, 1, 0,   0, 1, 0,
                            0, 0, gap, 0, 1, gap, 1, 1, gap, 1, 0, gap};
    static const int32_t verts[] = {0, 1, 2, 3, 4, 5, 6, 7};
    const otx_cage_input in = mesh_input(run, points, 8, verts, 2, 4);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 3);
    const double *open = openness_of(run, &s);
    double least = 1.0;

    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
        least = fmin(least, open[v]);
    return least;
}

static void
what_faces_something_near_is_hidden(void **state)
{
    otx_run *run = test_run_create();
    const double near = between_sheets(run, 0.1f);
    const double far = between_sheets(run, 0.5f);

    (void)state;
    assert_true(near < 0.15);
    assert_true(far > near + 0.1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_hides_nothing),
        cmocka_unit_test(what_faces_something_near_is_hidden),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
