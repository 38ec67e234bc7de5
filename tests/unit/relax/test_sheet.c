/* test_sheet.c -- one variable per vertex and patch, seams with both sides. */
#include "grid.h"

#include "relax/sheet.h"
#include "surface/distance.h"

static otx_vec2 *
corner_uvs(otx_run *run, const otx_surface *s)
{
    const otx_level *leaf = otx_surface_leaf(s);
    otx_vec2 *uvs = OTX_NEW(run->arena, otx_vec2, leaf->corner_count);

    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const otx_vec3 p = otx_vec3_load(s->points, leaf->face_verts[c]);

        uvs[c] = (otx_vec2){8.0 * p.x, 8.0 * p.y};
    }
    return uvs;
}

static void
vertices_between_patches_are_doubled(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = test_grid_create(run->arena, 4, 3, 1.0);
    const otx_vec2 *uvs = corner_uvs(run, s);
    int32_t patch[12];
    otx_vec2 out[48];
    otx_sheet sheet;

    (void)state;
    for (int32_t f = 0; f < 12; ++f)
        patch[f] = f % 4 < 2 ? 0 : 1;
    assert_int_equal(
        otx_sheet_build(run, s, 8.0, patch, NULL, uvs, &sheet), OSDTEX_OK);
    assert_int_equal(sheet.face_count, 12);
    assert_int_equal(sheet.count, 20 + 4);
    assert_int_equal(sheet.seam_count, 3);
    for (int32_t i = 0; i < sheet.seam_count; ++i)
    {
        const otx_sheet_seam *seam = &sheet.seams[i];

        assert_true(seam->length == 8.0);
        for (int k = 0; k < 2; ++k)
        {
            assert_int_not_equal(seam->a[k], seam->b[k]);
            assert_int_equal(sheet.verts[seam->a[k]], sheet.verts[seam->b[k]]);
        }
    }
    otx_sheet_store(&sheet, out);
    assert_memory_equal(out, uvs, sizeof out);
    test_run_destroy(run);
}

static void
holes_are_left_out(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = test_grid_create(run->arena, 3, 1, 1.0);
    const otx_vec2 *uvs = corner_uvs(run, s);
    const int32_t patch[3] = {0, -1, 0};
    otx_sheet sheet;

    (void)state;
    assert_int_equal(
        otx_sheet_build(run, s, 8.0, patch, NULL, uvs, &sheet), OSDTEX_OK);
    assert_int_equal(sheet.face_count, 2);
    assert_int_equal(sheet.count, 8);
    assert_int_equal(sheet.seam_count, 0);
    test_run_destroy(run);
}

/* Faces near the seam are taken; what they share with others is fixed. */
static void
what_is_out_of_reach_is_left_out(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = test_grid_create(run->arena, 6, 1, 1.0);
    const int32_t patch[6] = {0, 0, 0, 1, 1, 1};
    otx_sheet sheet;
    otx_sheet_part part = {NULL, NULL};
    uint8_t *inside;
    int32_t fixed = 0;

    (void)state;
    assert_int_equal(otx_distance_mark(run, s, patch, 1.0, &inside), OSDTEX_OK);
    for (int32_t f = 0; f < 6; ++f)
        assert_int_equal(inside[f], f > 0 && f < 5);
    part.inside = inside;
    assert_int_equal(
        otx_sheet_build(run, s, 8.0, patch, &part, corner_uvs(run, s), &sheet),
        OSDTEX_OK);
    assert_int_equal(sheet.face_count, 4);
    assert_int_equal(sheet.count, 12);
    for (int32_t v = 0; v < sheet.count; ++v)
    {
        const double x = sheet.at[v].x / 8.0;

        assert_int_equal(sheet.fixed[v], x == 1.0 || x == 5.0);
        fixed += sheet.fixed[v];
    }
    assert_int_equal(fixed, 4);
    test_run_destroy(run);
}

static void
an_isometric_sheet_is_at_rest(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = test_grid_create(run->arena, 5, 5, 1.0);
    int32_t patch[25] = {0};
    otx_vec2 b[36], u[36];
    otx_sheet sheet;

    (void)state;
    assert_int_equal(
        otx_sheet_build(run, s, 8.0, patch, NULL, corner_uvs(run, s), &sheet),
        OSDTEX_OK);
    otx_rigid_pull(&sheet.rigid, sheet.at, b);
    otx_rigid_apply(&sheet.rigid, sheet.at, 0, sheet.count, u);
    for (int32_t v = 0; v < 36; ++v)
        assert_true(otx_vec2_length(otx_vec2_sub(b[v], u[v])) < 1e-9);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_between_patches_are_doubled),
        cmocka_unit_test(holes_are_left_out),
        cmocka_unit_test(what_is_out_of_reach_is_left_out),
        cmocka_unit_test(an_isometric_sheet_is_at_rest),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
