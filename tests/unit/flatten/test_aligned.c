/* test_aligned.c -- coordinates along a field: exact where the surface is flat,
 * turned as the field says, and what is measured of them. */
#include "grid.h"

#include "flatten/aligned.h"

enum
{
    SIDE = 7,
    VERTS = (SIDE + 1) * (SIDE + 1),
    FACES = SIDE * SIDE
};

static const double TEXELS = 3.0;

typedef struct sheet
{
    otx_run *run;
    otx_rigid_mesh mesh;
    otx_vec3 rights[FACES];
    otx_vec2 flat[VERTS];
} sheet;

/* A flat sheet whose field is turned by `angle`; vertices lie anywhere. */
static sheet *
lay(double angle)
{
    otx_run *run = test_run_create();
    otx_surface *s = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    const otx_level *leaf = otx_surface_leaf(s);
    int32_t *verts = OTX_NEW(run->arena, int32_t, VERTS);
    sheet *out = OTX_ZNEW(run->arena, sheet, 1);

    out->run = run;
    for (int32_t v = 0; v < VERTS; ++v)
    {
        verts[v] = v;
        out->flat[v] = (otx_vec2){sin(7.0 * v), cos(5.0 * v)};
    }
    for (int32_t f = 0; f < FACES; ++f)
        out->rights[f] = (otx_vec3){cos(angle), sin(angle), 0.0};
    out->mesh =
        (otx_rigid_mesh){FACES, VERTS,     leaf->face_first, leaf->face_verts,
                         verts, s->points, TEXELS,           NULL};
    return out;
}

static void
a_flat_sheet_is_laid_out_exactly(void **state)
{
    const double angle = 0.7;
    sheet *s = lay(angle);
    const otx_vec2 back = {cos(angle), -sin(angle)};
    double error[3] = {0.0};

    (void)state;
    assert_int_equal(
        otx_aligned_solve(s->run->scratch, &s->mesh, s->rights, NULL, s->flat),
        OSDTEX_OK);
    for (int32_t v = 1; v < VERTS; ++v)
    {
        const otx_vec3 d = otx_vec3_sub(
            otx_vec3_load(s->mesh.points, v), otx_vec3_load(s->mesh.points, 0));
        const otx_vec2 wanted =
            otx_vec2_mul(back, (otx_vec2){TEXELS * d.x, TEXELS * d.y});
        const otx_vec2 got = otx_vec2_sub(s->flat[v], s->flat[0]);

        assert_true(otx_vec2_length(otx_vec2_sub(wanted, got)) < 1e-2);
    }
    for (int32_t f = 0; f < FACES; ++f)
        otx_aligned_error(&s->mesh, f, s->rights[f], s->flat, error);
    assert_true(sqrt(error[0] / error[2]) < 1e-2);
    assert_true(sqrt(error[1] / error[2]) < 1e-2);
    test_run_destroy(s->run);
}

static void
the_middle_stays(void **state)
{
    sheet *s = lay(0.0);
    otx_vec2 before = {0, 0}, after = {0, 0};

    (void)state;
    for (int32_t v = 0; v < VERTS; ++v)
        before = otx_vec2_add(before, s->flat[v]);
    assert_int_equal(
        otx_aligned_solve(s->run->scratch, &s->mesh, s->rights, NULL, s->flat),
        OSDTEX_OK);
    for (int32_t v = 0; v < VERTS; ++v)
        after = otx_vec2_add(after, s->flat[v]);
    assert_true(otx_vec2_length(otx_vec2_sub(before, after)) < 1e-6);
    test_run_destroy(s->run);
}

static void
the_error_is_how_far_axes_are_off(void **state)
{
    sheet *s = lay(0.0);
    double error[3] = {0.0};

    (void)state;
    for (int32_t v = 0; v < VERTS; ++v)
    {
        const otx_vec3 p = otx_vec3_load(s->mesh.points, v);

        s->flat[v] = (otx_vec2){1.5 * TEXELS * p.x, TEXELS * p.y};
    }
    for (int32_t f = 0; f < FACES; ++f)
        otx_aligned_error(&s->mesh, f, s->rights[f], s->flat, error);
    assert_float_equal(sqrt(error[0] / error[2]), 0.5, 1e-6);
    assert_float_equal(sqrt(error[1] / error[2]), 0.0, 1e-6);
    test_run_destroy(s->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flat_sheet_is_laid_out_exactly),
        cmocka_unit_test(the_middle_stays),
        cmocka_unit_test(the_error_is_how_far_axes_are_off),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
