/* test_walk.c -- going on across edges, and where the surface ends. */
#include "unit/bake/flat.h"

#include "bake/walk.h"

/* The point of the sheet that a walk is at. */
static otx_vec2
point_of(const otx_surface *surface, const otx_walk *walk)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_vec2 sum = {0.0, 0.0};

    for (int k = 0; k < 3; ++k)
    {
        const float *p =
            surface->points + 3 * leaf->face_verts[walk->facet.corners[k]];

        sum.x += walk->at[k] * p[0];
        sum.y += walk->at[k] * p[1];
    }
    return sum;
}

/* A walk on facet 0 of face `face`, which is below the diagonal, whose
 * coordinates stand for (x, y). */
static otx_walk
walk_from(const otx_surface *surface, int32_t face, double x, double y)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_walk walk = {.facet = otx_facet_at(leaf, face, 0)};
    const float *low =
        surface->points + 3 * leaf->face_verts[walk.facet.corners[0]];
    const float *right =
        surface->points + 3 * leaf->face_verts[walk.facet.corners[1]];
    const double side = (double)right[0] - low[0];

    walk.at[2] = (y - low[1]) / side;
    walk.at[1] = (x - low[0]) / side - walk.at[2];
    walk.at[0] = 1.0 - walk.at[1] - walk.at[2];
    return walk;
}

static uint8_t *
all_covered(otx_run *run, const otx_surface *surface)
{
    const int32_t count = otx_surface_leaf(surface)->face_count;
    uint8_t *covered = OTX_NEW(run->arena, uint8_t, count);

    memset(covered, 1, (size_t)count);
    return covered;
}

static void
on_a_flat_sheet_it_goes_straight(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, 4, 1);
    const uint8_t *covered = all_covered(run, surface);
    const int32_t faces = otx_surface_leaf(surface)->face_count;

    (void)state;
    for (uint64_t i = 0; i < 2000; ++i)
    {
        const double x = 4.0 * otx_random_unit(1, 0, i);
        const double y = 4.0 * otx_random_unit(1, 1, i);
        const int32_t face = (int32_t)(faces * otx_random_unit(1, 2, i));
        otx_walk walk = walk_from(surface, face, x, y);

        assert_true(otx_walk_on(surface, covered, 96, &walk));

        const otx_vec2 p = point_of(surface, &walk);

        assert_true(fabs(p.x - x) < 1e-5 && fabs(p.y - y) < 1e-5);
        for (int k = 0; k < 3; ++k)
            assert_true(walk.at[k] >= -1e-6);
    }
    test_run_destroy(run);
}

static void
it_is_held_where_the_sheet_ends(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, 2, 1);
    const uint8_t *covered = all_covered(run, surface);
    const double places[][4] = {
        {-0.5, 1.3, 0.0, 1.3},
        {2.7, 0.4, 2.0, 0.4},
        {0.8, 3.0, 0.8, 2.0},
        {-1.0, -1.0, 0.0, 0.0}};

    (void)state;
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i)
    {
        otx_walk walk = walk_from(surface, 5, places[i][0], places[i][1]);

        otx_walk_on(surface, covered, 96, &walk);

        const otx_vec2 p = point_of(surface, &walk);

        assert_true(fabs(p.x - places[i][2]) < 1e-5);
        assert_true(fabs(p.y - places[i][3]) < 1e-5);
    }
    test_run_destroy(run);
}

static void
across_a_crease_lengths_are_kept(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_cage cage;
    otx_surface surface;

    (void)state;
    options.scheme = OTX_SCHEME_BILINEAR;
    cage = mesh_build(run, &in, &options);
    surface = mesh_refine(run, &cage, 0);

    const uint8_t *covered = all_covered(run, &surface);

    /* The front of the cube is z = 1, faces are 2 wide; a quarter of a face
     * below its lower edge is on the bottom, as far from that edge. */
    otx_walk walk = {
        .facet = otx_facet_at(otx_surface_leaf(&surface), 0, 0),
        .at = {1.0 - 0.5, 0.5 + 0.25, -0.25}};

    assert_true(otx_walk_on(&surface, covered, 96, &walk));

    double y = 0.0, z = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        const float *p =
            surface.points +
            3 * otx_surface_leaf(&surface)->face_verts[walk.facet.corners[k]];

        y += walk.at[k] * p[1];
        z += walk.at[k] * p[2];
    }
    assert_true(fabs(y + 1.0) < 1e-6 && fabs(z - 0.5) < 1e-6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(on_a_flat_sheet_it_goes_straight),
        cmocka_unit_test(it_is_held_where_the_sheet_ends),
        cmocka_unit_test(across_a_crease_lengths_are_kept),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
