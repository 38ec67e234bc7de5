/* test_edge_distance.c -- ways from boundaries and creases. */
#include "meshes.h"
#include "surface/edge_distance.h"

enum
{
    N = 8
};

static otx_surface
bilinear(otx_run *run, const otx_cage_input *in, int32_t level, otx_cage *cage)
{
    otx_cage_options options = otx_cage_options_default();

    options.scheme = OTX_SCHEME_BILINEAR;
    *cage = mesh_build(run, in, &options);
    return mesh_refine(run, cage, level);
}

static double *
away(otx_run *run, const otx_surface *s, otx_edge_kind kind, int32_t *marked)
{
    double *out = OTX_NEW(run->arena, double, otx_surface_leaf(s)->vert_count);
    uint8_t *edges;

    assert_int_equal(otx_edge_mark(run, s, kind, &edges, marked), OSDTEX_OK);
    assert_int_equal(otx_edge_distance(run, s, edges, out), OSDTEX_OK);
    return out;
}

/* Along edges the way from the rim of a square is exact. */
static void
rims_are_where_there_is_one_face(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, N);
    otx_cage cage;
    const otx_surface s = bilinear(run, &in, 1, &cage);
    int32_t marked;
    const double *d = away(run, &s, OTX_EDGE_BOUNDARY, &marked);

    (void)state;
    assert_int_equal(marked, 2 * 4 * N);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
    {
        const double x = (double)s.points[3 * v];
        const double y = (double)s.points[3 * v + 1];

        assert_near(d[v], fmin(fmin(x, N - x), fmin(y, N - y)), 1e-6);
    }
    test_run_destroy(run);
}

/* A crease through the middle, of which the halves of halves are found; a
 * sharpness of 0 takes it back. */
static void
creases_are_followed_through_levels(void **state)
{
    static const int32_t verts[] = {4, 13, 13, 22, 22, 31, 0, 1, 0, 1};
    static const float sharpness[] = {1.0f, 2.0f, 3.0f, 1.0f, 0.0f};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, N);
    otx_cage cage;
    otx_surface s;
    int32_t marked;
    const double *d;

    (void)state;
    in.crease_count = 5;
    in.crease_verts = verts;
    in.crease_sharpness = sharpness;
    s = bilinear(run, &in, 2, &cage);
    d = away(run, &s, OTX_EDGE_CREASE, &marked);
    assert_int_equal(marked, 3 * 4);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
        if (s.points[3 * v + 1] <= 3.0f)
            assert_near(d[v], fabs((double)s.points[3 * v] - 4.0), 1e-6);
    test_run_destroy(run);
}

/* A slot of holes across the square but for its end: ways go around it by
 * (7, 5), and a crease amid the holes is none. */
static void
holes_are_not_of_the_surface(void **state)
{
    static const int32_t verts[] = {0, 1, 4 * 9 + 2, 5 * 9 + 2};
    static const float sharpness[] = {1.0f, 1.0f};
    int32_t holes[N - 1];
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, N);
    otx_cage cage;
    otx_surface s;
    int32_t marked;
    const double *d;

    (void)state;
    for (int32_t k = 0; k < N - 1; ++k)
        holes[k] = 4 * N + k;
    in.hole_count = N - 1;
    in.hole_faces = holes;
    in.crease_count = 2;
    in.crease_verts = verts;
    in.crease_sharpness = sharpness;
    s = bilinear(run, &in, 0, &cage);
    d = away(run, &s, OTX_EDGE_CREASE, &marked);
    assert_int_equal(marked, 1);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
    {
        const double x = (double)s.points[3 * v];
        const double y = (double)s.points[3 * v + 1];

        if (y > 4.5)
            assert_true(d[v] > 7.8 + (7.0 - x));
    }
    test_run_destroy(run);
}

static void
closed_surfaces_have_no_rim(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    otx_cage cage;
    const otx_surface s = bilinear(run, &in, 1, &cage);
    int32_t marked;
    const double *d = away(run, &s, OTX_EDGE_BOUNDARY, &marked);

    (void)state;
    assert_int_equal(marked, 0);
    assert_true(isinf(d[0]));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rims_are_where_there_is_one_face),
        cmocka_unit_test(creases_are_followed_through_levels),
        cmocka_unit_test(holes_are_not_of_the_surface),
        cmocka_unit_test(closed_surfaces_have_no_rim),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
