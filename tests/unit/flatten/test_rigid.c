/* test_rigid.c -- the Laplacian, its rest state, and the solver. */
#include "grid.h"

#include "flatten/rigid.h"

enum
{
    SIDE = 7,
    VERTS = (SIDE + 1) * (SIDE + 1)
};

static otx_rigid
build(otx_run *run, double bump, otx_vec2 *flat)
{
    otx_surface *s = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    const otx_level *leaf = otx_surface_leaf(s);
    float *points = OTX_NEW(run->arena, float, 3 * VERTS);
    int32_t *verts = OTX_NEW(run->arena, int32_t, VERTS);
    otx_rigid_mesh mesh;
    otx_rigid rigid;

    for (int32_t v = 0; v < VERTS; ++v)
    {
        const otx_vec3 p = otx_vec3_load(s->points, v);

        points[3 * v] = s->points[3 * v];
        points[3 * v + 1] = s->points[3 * v + 1];
        points[3 * v + 2] = (float)(bump * sin(p.x) * cos(p.y));
        verts[v] = v;
        flat[v] = (otx_vec2){3.0 * p.x, 3.0 * p.y};
    }
    mesh = (otx_rigid_mesh){
        leaf->face_count,
        VERTS,
        leaf->face_first,
        leaf->face_verts,
        verts,
        points,
        3.0,
        NULL};
    assert_int_equal(otx_rigid_build(run->arena, &mesh, &rigid), OSDTEX_OK);
    return rigid;
}

static void
the_laplacian_ignores_translations(void **state)
{
    otx_run *run = test_run_create();
    otx_vec2 flat[VERTS], out[VERTS];
    const otx_rigid rigid = build(run, 0.5, flat);

    (void)state;
    for (int32_t v = 0; v < VERTS; ++v)
        flat[v] = (otx_vec2){4.0, -2.0};
    otx_rigid_apply(&rigid, flat, 0, VERTS, out);
    for (int32_t v = 0; v < VERTS; ++v)
        assert_true(otx_vec2_length(out[v]) < 1e-9);
    test_run_destroy(run);
}

static void
a_turned_plane_is_at_rest(void **state)
{
    otx_run *run = test_run_create();
    otx_vec2 flat[VERTS], pull[VERTS], out[VERTS];
    const otx_rigid rigid = build(run, 0.0, flat);

    (void)state;
    for (int32_t v = 0; v < VERTS; ++v)
        flat[v] = otx_vec2_mul(otx_vec2_polar(1.1), flat[v]);
    otx_rigid_pull(&rigid, flat, pull);
    otx_rigid_apply(&rigid, flat, 0, VERTS, out);
    for (int32_t v = 0; v < VERTS; ++v)
        assert_true(otx_vec2_length(otx_vec2_sub(pull[v], out[v])) < 1e-9);
    test_run_destroy(run);
}

static void
fans_pull_as_the_triangles_do(void **state)
{
    otx_run *run = test_run_create();
    otx_vec2 flat[VERTS], b[VERTS], sums[VERTS];
    const otx_rigid rigid = build(run, 0.8, flat);
    const int32_t half = rigid.triangle_count / 2;
    otx_rigid_fans fans;

    (void)state;
    assert_int_equal(
        otx_rigid_fans_build(run->scratch, &rigid, &fans), OSDTEX_OK);
    otx_rigid_pull(&rigid, flat, b);
    otx_rigid_fans_turn(&rigid, flat, half, rigid.triangle_count, &fans);
    otx_rigid_fans_turn(&rigid, flat, 0, half, &fans);
    otx_rigid_fans_pull(&rigid, &fans, VERTS / 2, VERTS, sums);
    otx_rigid_fans_pull(&rigid, &fans, 0, VERTS / 2, sums);
    for (int32_t v = 0; v < VERTS; ++v)
    {
        assert_true(sums[v].x == b[v].x);
        assert_true(sums[v].y == b[v].y);
    }
    test_run_destroy(run);
}

static void
apply(
    const void *context, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out)
{
    otx_rigid_apply(context, x, first, end, out);
}

static void
the_solver_solves(void **state)
{
    otx_run *run = test_run_create();
    otx_vec2 flat[VERTS], b[VERTS], out[VERTS], diagonal[VERTS];
    const otx_rigid rigid = build(run, 0.8, flat);
    const otx_rigid_system system = {
        .count = VERTS,
        .apply = apply,
        .context = &rigid,
        .diagonal = diagonal,
        .rounds = 500,
        .tolerance = 1e-8,
        .pool = run->pool};

    (void)state;
    for (int32_t v = 0; v < VERTS; ++v)
        diagonal[v] = (otx_vec2){rigid.diagonal[v], rigid.diagonal[v]};
    otx_rigid_pull(&rigid, flat, b);
    assert_int_equal(
        otx_rigid_solve(run->scratch, &system, b, flat), OSDTEX_OK);
    otx_rigid_apply(&rigid, flat, 0, VERTS, out);
    for (int32_t v = 0; v < VERTS; ++v)
        assert_true(otx_vec2_length(otx_vec2_sub(out[v], b[v])) < 1e-5);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_laplacian_ignores_translations),
        cmocka_unit_test(a_turned_plane_is_at_rest),
        cmocka_unit_test(fans_pull_as_the_triangles_do),
        cmocka_unit_test(the_solver_solves),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
