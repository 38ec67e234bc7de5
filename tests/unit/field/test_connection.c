/* test_connection.c -- Gauss-Bonnet, and transport there and back. */
#include "unit/field/test_field.h"

static double
defect_sum(otx_run *run, const otx_connection *c)
{
    double *defects, sum = 0.0;

    assert_int_equal(otx_connection_defects(run, c, &defects), OSDTEX_OK);
    for (int32_t v = 0; v < c->level->vert_count; ++v)
        if (isfinite(defects[v]))
            sum += defects[v];
    return sum;
}

static void
defects_sum_to_the_euler_characteristic(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input inputs[] = {
        mesh_cube(run), mesh_octahedron(run), field_torus(run, 12, 8)};
    const double expected[] = {2, 2, 0};

    (void)state;
    for (int i = 0; i < 3; ++i)
        for (int32_t level = 1; level < 4; ++level)
        {
            const field_surface *s = field_from_input(run, &inputs[i], level);

            assert_true(
                fabs(
                    defect_sum(run, &s->connection) -
                    2.0 * OTX_PI * expected[i]) < 1e-8);
        }
    test_run_destroy(run);
}

static void
a_plane_is_flat(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    const field_surface *s = field_from_input(run, &in, 2);
    const otx_connection *c = &s->connection;
    double *defects;

    (void)state;
    assert_int_equal(otx_connection_defects(run, c, &defects), OSDTEX_OK);
    for (int32_t v = 0; v < c->level->vert_count; ++v)
        assert_true(isnan(defects[v]) || fabs(defects[v]) < 1e-6);
    for (int32_t e = 0; e < c->level->edge_count; ++e)
        if (c->inner[e])
        {
            const int32_t *f = c->level->edge_faces + 2 * e;
            const otx_vec2 there = otx_vec2_mul(
                otx_vec2_polar(c->turns[e]),
                otx_connection_project(c, f[0], (otx_vec3){1, 0, 0}));
            const otx_vec3 back = otx_connection_lift(c, f[1], there);

            assert_true(fabs(back.x - 1.0) + fabs(back.y) < 1e-6);
        }
    test_run_destroy(run);
}

static void
holes_are_left_out(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, 3);
    const int32_t hole = 4;
    const field_surface *s;

    (void)state;
    in.hole_faces = &hole;
    in.hole_count = 1;
    s = field_from_input(run, &in, 1);
    for (int32_t e = 0; e < s->connection.level->edge_count; ++e)
    {
        const int32_t *f = s->connection.level->edge_faces + 2 * e;
        const bool inner = f[1] >= 0 && !s->connection.level->face_hole[f[0]] &&
                           !s->connection.level->face_hole[f[1]];

        assert_int_equal(s->connection.inner[e], inner);
    }
    assert_true(fabs(s->connection.area - 8.0) < 1.0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defects_sum_to_the_euler_characteristic),
        cmocka_unit_test(a_plane_is_flat),
        cmocka_unit_test(holes_are_left_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
