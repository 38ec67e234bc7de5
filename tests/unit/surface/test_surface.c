#include "meshes.h"

#include <stdatomic.h>
#include <stdlib.h>

/* Float's resolution after a few hundred operations on numbers near 1. */
static const double tolerance = 2e-5;

static void
test_bilinear_keeps_the_cage(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;

    (void)state;
    options.scheme = OTX_SCHEME_BILINEAR;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 3);
    assert_memory_equal(s.points, cube_points, sizeof cube_points);
    assert_near(s.area, 24.0, 1e-4);
    assert_near(s.mean_edge_length, 0.25, 1e-6);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    test_run_destroy(run);
}

static void
test_plain_mesh(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;

    (void)state;
    options.scheme = OTX_SCHEME_NONE;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 0);
    assert_int_equal(s.level_count, 1);
    assert_memory_equal(s.points, cube_points, sizeof cube_points);
    for (int32_t i = 0; i < 24; ++i)
        assert_near(s.normals[i], cube_points[i] / sqrt(3.0), tolerance);
    assert_near(s.area, 24.0, 1e-9);
    assert_near(s.mean_edge_length, 2.0, 1e-9);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    assert_int_equal(otx_surface_level_for(&cage, 0.1), 0);
    test_run_destroy(run);
}

static void
test_holes_are_inherited(void **state)
{
    static const int32_t holes[] = {5, 10};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, 4);
    const otx_level *leaf;
    otx_surface s;
    otx_cage cage;

    (void)state;
    in.hole_faces = holes;
    in.hole_count = 2;
    cage = mesh_build(run, &in, NULL);
    s = mesh_refine(run, &cage, 3);
    leaf = otx_surface_leaf(&s);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        assert_int_equal(
            leaf->face_hole[f],
            leaf->face_cage[f] == 5 || leaf->face_cage[f] == 10);
    assert_near(s.area, 14.0, 1e-4);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    test_run_destroy(run);
}

static void
test_leaves_are_ranges_in_face_order(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 3);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 3);

    (void)state;
    for (int32_t l = 0; l < s.level_count; ++l)
    {
        int32_t expected = 0;

        for (int32_t f = 0; f < s.levels[l].face_count; ++f)
        {
            int32_t first, end;

            otx_surface_leaves(&s, l, f, &first, &end);
            assert_int_equal(first, expected);
            assert_int_equal(end - first, 1 << (2 * (3 - l)));
            for (int32_t k = first; k < end; ++k)
            {
                int32_t up = k;

                for (int32_t m = 3; m > l; --m)
                    up = s.levels[m].face_parent[up];
                assert_int_equal(up, f);
            }
            expected = end;
        }
    }
    test_run_destroy(run);
}

static void
test_ngons_at_level_0(void **state)
{
    static const int32_t first[] = {0, 3, 6, 9, 14};
    static const int32_t verts[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 4, 3, 2, 1, 5};
    static const float points[] = {
        0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 1, -1, -1};
    otx_run *run = test_run_create();
    otx_cage_input in = otx_cage_input_none();
    otx_surface s, deep;
    otx_cage cage;

    (void)state;
    in.points = points;
    in.vert_count = 6;
    in.face_first = first;
    in.face_verts = verts;
    in.face_count = 4;
    cage = mesh_build(run, &in, NULL);
    s = mesh_refine(run, &cage, 0);
    deep = mesh_refine(run, &cage, 3);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    assert_int_equal(otx_surface_validate(run, &deep), OSDTEX_OK);
    for (int32_t i = 0; i < 18; ++i)
        assert_near(s.points[i], deep.points[i], tolerance);
    test_run_destroy(run);
}

static void
test_isolated_vertices_stay(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    float points[27];

    (void)state;
    memcpy(points, cube_points, sizeof cube_points);
    points[24] = 5.0f;
    points[25] = 6.0f;
    points[26] = 7.0f;
    in.points = points;
    in.vert_count = 9;
    for (int32_t level = 0; level <= 3; ++level)
    {
        const otx_cage cage = mesh_build(run, &in, NULL);
        const otx_surface s = mesh_refine(run, &cage, level);

        assert_memory_equal(s.points + 24, points + 24, 12);
        assert_near(s.points[0], -0.5, tolerance);
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    }
    test_run_destroy(run);
}

static void
test_threads_do_not_matter(void **state)
{
    static const int32_t threads[] = {1, 2, 8};
    otx_surface s[3];
    otx_cage cages[3];
    otx_run *runs[3];

    (void)state;
    for (int32_t i = 0; i < 3; ++i)
    {
        otx_cage_input in;

        runs[i] = test_run_create_with(NULL, threads[i]);
        in = mesh_islands(runs[i]);
        cages[i] = mesh_build(runs[i], &in, NULL);
        s[i] = mesh_refine(runs[i], &cages[i], 6);
    }
    for (int32_t i = 1; i < 3; ++i)
    {
        const otx_level *a = otx_surface_leaf(&s[0]);
        const otx_level *b = otx_surface_leaf(&s[i]);
        const size_t verts = (size_t)a->vert_count;

        assert_memory_equal(s[0].points, s[i].points, 12 * verts);
        assert_memory_equal(s[0].normals, s[i].normals, 12 * verts);
        assert_memory_equal(s[0].tangents, s[i].tangents, 24 * verts);
        assert_memory_equal(s[0].uvs, s[i].uvs, 8 * (size_t)s[0].uv_count);
        assert_memory_equal(
            a->edge_faces, b->edge_faces, 8 * (size_t)a->edge_count);
        assert_true(s[0].area == s[i].area);
        assert_true(s[0].mean_edge_length == s[i].mean_edge_length);
    }
    for (int32_t i = 0; i < 3; ++i)
        test_run_destroy(runs[i]);
}

static void
test_level_for(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage cage = mesh_build(run, &in, NULL);

    (void)state;
    assert_int_equal(otx_surface_level_for(&cage, 100.0), 0);
    assert_int_equal(otx_surface_level_for(&cage, 1.42), 0);
    assert_int_equal(otx_surface_level_for(&cage, 1.41), 1);
    assert_int_equal(otx_surface_level_for(&cage, 0.24), 3);
    assert_int_equal(otx_surface_level_for(&cage, 0.0), OTX_LEVEL_MAX);
    in = mesh_octahedron(run);
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(otx_surface_level_for(&cage, 100.0), 1);
    test_run_destroy(run);
}

static void
test_limits_come_before_memory(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const size_t peak = otx_allocator_peak(run->allocator);
    const size_t bytes = otx_surface_bytes(&cage, 6);
    otx_surface s;

    (void)state;
    assert_true(otx_surface_bytes(&cage, 5) < bytes);
    assert_int_equal(
        otx_surface_refine(run, &cage, 6, bytes - 1, &s), OSDTEX_ERROR_LIMIT);
    /* The sentence takes some; the levels would take megabytes. */
    assert_true(
        otx_allocator_peak(run->allocator) < peak + 262144 && bytes > 4000000);
    assert_null(s.levels);
    assert_non_null(strstr(test_last_message(run), "use level 5"));
    assert_int_equal(otx_surface_refine(run, &cage, 6, bytes, &s), OSDTEX_OK);
    assert_true(otx_allocator_peak(run->allocator) < bytes);
    assert_int_equal(
        otx_surface_refine(run, &cage, 11, 0, &s), OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        otx_surface_refine(run, &cage, -1, 0, &s), OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

static void
test_indices_that_do_not_fit(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 40);
    const otx_cage cage = mesh_build(run, &in, NULL);
    otx_surface s;

    (void)state;
    assert_int_equal(
        otx_surface_refine(run, &cage, 10, 0, &s), OSDTEX_ERROR_LIMIT);
    test_run_destroy(run);
}

static bool
cancel_at(void *user, const char *stage, double fraction)
{
    int32_t *left = user;

    (void)stage;
    (void)fraction;
    return (*left)-- > 0;
}

static void
test_cancelling_leaks_nothing(void **state)
{
    otx_status status = OSDTEX_ERROR_CANCELLED;

    (void)state;
    for (int32_t k = 0; status != OSDTEX_OK; ++k)
    {
        otx_run *run = test_run_create();
        const otx_cage_input in = mesh_cube(run);
        const otx_cage cage = mesh_build(run, &in, NULL);
        int32_t left = k;
        otx_surface s;

        run->progress = cancel_at;
        run->progress_user = &left;
        status = otx_surface_refine(run, &cage, 2, 0, &s);
        assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_CANCELLED);
        assert_true(k < 20);
        test_run_destroy(run);
    }
}

/* Fails the allocation after `left` more. */
typedef struct failing_heap
{
    _Atomic int32_t left;
    _Atomic int32_t blocks;
} failing_heap;

static void *
failing_alloc(void *user, size_t bytes)
{
    failing_heap *allocator = user;

    if (atomic_fetch_sub(&allocator->left, 1) <= 0)
        return NULL;
    atomic_fetch_add(&allocator->blocks, 1);
    return malloc(bytes);
}

static void
failing_release(void *user, void *block, size_t bytes)
{
    failing_heap *allocator = user;

    (void)bytes;
    atomic_fetch_sub(&allocator->blocks, 1);
    free(block);
}

static otx_status
build_and_refine(otx_run *run, const otx_cage_input *in)
{
    const otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;

    OTX_TRY(otx_cage_build(run, in, &options, &cage));
    return otx_surface_refine(run, &cage, 4, 0, &s);
}

static void
test_failing_allocations_leak_nothing(void **state)
{
    otx_status status = OSDTEX_ERROR_MEMORY;
    int32_t failures = 0;

    (void)state;
    for (int32_t k = 0; status != OSDTEX_OK; ++k)
    {
        failing_heap allocator = {INT32_MAX, 0};
        const otx_allocator_hooks hooks = {
            failing_alloc, failing_release, &allocator, 0};
        otx_run *run = test_run_create_with(&hooks, 2);
        const otx_cage_input in = mesh_islands(run);

        allocator.left = k;
        status = build_and_refine(run, &in);
        allocator.left = INT32_MAX;
        assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_MEMORY);
        failures += status != OSDTEX_OK;
        test_run_destroy(run);
        assert_int_equal(allocator.blocks, 0);
    }
    assert_true(failures > 10);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bilinear_keeps_the_cage),
        cmocka_unit_test(test_plain_mesh),
        cmocka_unit_test(test_holes_are_inherited),
        cmocka_unit_test(test_leaves_are_ranges_in_face_order),
        cmocka_unit_test(test_ngons_at_level_0),
        cmocka_unit_test(test_isolated_vertices_stay),
        cmocka_unit_test(test_threads_do_not_matter),
        cmocka_unit_test(test_level_for),
        cmocka_unit_test(test_limits_come_before_memory),
        cmocka_unit_test(test_indices_that_do_not_fit),
        cmocka_unit_test(test_cancelling_leaks_nothing),
        cmocka_unit_test(test_failing_allocations_leak_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
