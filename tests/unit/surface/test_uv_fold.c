/* test_uv_fold.c -- charts that fold back are cut at the fold. */
#include "meshes.h"

#include "surface/uv_fold.h"

/* A grid of n x n whose right half shares the texture vertices of its left
 * one, mirrored at x = n / 2. */
static otx_cage_input
mirrored_grid(otx_run *run, int32_t n)
{
    otx_cage_input in = mesh_grid(run, n);
    const int32_t side = n + 1;
    float *uvs = OTX_NEW(run->arena, float, 2 * side * side);
    int32_t *face_uvs = OTX_NEW(run->arena, int32_t, 4 * n * n);

    for (int32_t v = 0; v < side * side; ++v)
    {
        uvs[2 * v] = (float)(v % side) / (float)n;
        uvs[2 * v + 1] = (float)(v / side) / (float)n;
    }
    for (int32_t c = 0; c < 4 * n * n; ++c)
    {
        const int32_t v = in.face_verts[c], x = v % side;

        face_uvs[c] = v - x + (x > n / 2 ? n - x : x);
    }
    in.uvs = uvs;
    in.uv_count = side * side;
    in.face_uvs = face_uvs;
    return in;
}

static void
test_the_axis_is_a_seam(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mirrored_grid(run, 4);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 3);
    const otx_level *leaf = otx_surface_leaf(&s);

    (void)state;
    assert_int_equal(cage.uv_count, in.uv_count + 5);
    assert_non_null(strstr(test_last_message(run), "fold back at 4 edges"));
    for (int32_t c = 0; c < cage.corner_count; ++c)
    {
        /* Same places; the left half keeps its texture vertices. */
        assert_memory_equal(
            cage.uvs + 2 * cage.face_uvs[c], in.uvs + 2 * in.face_uvs[c], 8);
        if (c / 4 % 4 < 2)
            assert_int_equal(cage.face_uvs[c], in.face_uvs[c]);
    }
    /* No band: at the axis, u is what the artist put there, and elsewhere the
     * limit of a flat grid is linear beside it. */
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const float *p = s.points + 3 * leaf->face_verts[c];
        const double x = p[0] > 2.0f ? 4.0 - (double)p[0] : (double)p[0];

        assert_near(s.uvs[2 * s.face_uvs[c]], x / 4.0, 2e-6);
    }
    test_run_destroy(run);
}

/* Charts without folds come out as they came in, seams and all. */
static void
test_nothing_else_is_cut(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_islands(run);
    otx_topology t;
    otx_uv_fold fold;

    (void)state;
    assert_true(otx_topology_build(
        run->arena, in.vert_count, in.face_count, in.face_first, in.face_verts,
        &t));
    assert_true(otx_uv_fold_split(
        run->arena, &t, in.uv_count, in.uvs, in.face_uvs, &fold));
    assert_int_equal(fold.edge_count, 0);
    assert_ptr_equal(fold.face_uvs, in.face_uvs);
    assert_int_equal(fold.uv_count, in.uv_count);
    test_run_destroy(run);
}

/* One face that lies the wrong way round in UV is a chart of its own then; its
 * neighbours keep hanging together. */
static void
test_a_flipped_face(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, 3);
    float *uvs = OTX_NEW(run->arena, float, 32);
    otx_topology t;
    otx_uv_fold fold;

    (void)state;
    for (int32_t v = 0; v < 16; ++v)
    {
        uvs[2 * v] = in.points[3 * v];
        uvs[2 * v + 1] = in.points[3 * v + 1];
    }
    /* The corners of the middle face trade places. */
    uvs[2 * 5] = uvs[2 * 9] = 1.6f;
    uvs[2 * 6] = uvs[2 * 10] = 1.4f;
    assert_true(otx_topology_build(
        run->arena, 16, 9, in.face_first, in.face_verts, &t));
    assert_true(
        otx_uv_fold_split(run->arena, &t, 16, uvs, in.face_verts, &fold));
    assert_int_equal(fold.edge_count, 4);
    assert_int_equal(fold.uv_count, 20);
    for (int32_t c = 0; c < 36; ++c)
        assert_memory_equal(
            fold.uvs + 2 * fold.face_uvs[c], uvs + 2 * in.face_verts[c], 8);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_axis_is_a_seam),
        cmocka_unit_test(test_nothing_else_is_cut),
        cmocka_unit_test(test_a_flipped_face)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
