#include "meshes.h"

#include <dirent.h>
#include <stdatomic.h>
#include <stdlib.h>

/* Float's resolution after a few hundred operations on numbers near 1. */
static const double tolerance = 2e-5;

/* A cube's limit under Catmull-Clark, by hand. At a vertex of valence 3,
 * (9 v + 4 (e1 + e2 + e3) + (f1 + f2 + f3)) / 24 over the neighbours along the
 * edges and across the faces: 9 + 4 - 3 = 10 in every coordinate, less one
 * for the far corners: (9 + 4 (1 + 1 - 1) + (1 - 1 - 1)) / 24 = 1/2. */
static void
test_cube_limit(void **state)
{
    (void)state;
    for (int32_t level = 0; level <= 4; ++level)
    {
        otx_run *run = test_run_create();
        const otx_cage_input in = mesh_cube(run);
        const otx_cage cage = mesh_build(run, &in, NULL);
        const otx_surface s = mesh_refine(run, &cage, level);

        for (int32_t i = 0; i < 24; ++i)
        {
            assert_near(s.points[i], 0.5 * cube_points[i], tolerance);
            assert_near(s.normals[i], cube_points[i] / sqrt(3.0), tolerance);
        }
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
        assert_int_equal(otx_surface_leaf(&s)->face_count, 6 << (2 * level));
        test_run_destroy(run);
    }
}

/* Loop's limit at a vertex of valence n: (v + n w mean) / (1 + n w) with
 * w = 8 beta / 3; of an octahedron the neighbours' mean is the centre. */
static void
test_octahedron_limit(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_octahedron(run);
    otx_cage_options options = otx_cage_options_default();
    const double c = 0.375 + 0.25 * cos(OTX_PI / 2.0);
    const double beta = (0.625 - c * c) / 4.0;
    const double shrink = 1.0 / (1.0 + 4.0 * 8.0 * beta / 3.0);
    otx_surface s;
    otx_cage cage;

    (void)state;
    options.scheme = OTX_SCHEME_LOOP;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 3);
    for (int32_t i = 0; i < 18; ++i)
    {
        assert_near(s.points[i], shrink * octahedron_points[i], tolerance);
        assert_near(s.normals[i], octahedron_points[i], tolerance);
    }
    assert_int_equal(s.levels[0].face_child_vert[0], -1);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    test_run_destroy(run);
}

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

/* refine(A cage) = A refine(cage) for an affine map A. */
static void
test_refinement_commutes_with_affine_maps(void **state)
{
    static const double a[3][4] = {
        {1.5, -0.25, 0.5, 3.0}, {0.125, 0.75, -1.0, -2.0}, {0.5, 1, 2, 0.5}};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    float mapped[24];
    otx_cage cages[2];
    otx_surface s, t;

    (void)state;
    cages[0] = mesh_build(run, &in, NULL);
    for (int32_t v = 0; v < 8; ++v)
    {
        const float *p = cube_points + 3 * v;

        for (int32_t k = 0; k < 3; ++k)
            mapped[3 * v + k] =
                (float)(a[k][0] * p[0] + a[k][1] * p[1] + a[k][2] * p[2] + a[k][3]);
    }
    in.points = mapped;
    cages[1] = mesh_build(run, &in, NULL);
    s = mesh_refine(run, &cages[0], 4);
    t = mesh_refine(run, &cages[1], 4);
    for (int32_t v = 0; v < otx_surface_leaf(&s)->vert_count; ++v)
    {
        const float *p = s.points + 3 * v;

        for (int32_t k = 0; k < 3; ++k)
            assert_near(
                t.points[3 * v + k],
                a[k][0] * p[0] + a[k][1] * p[1] + a[k][2] * p[2] + a[k][3],
                tolerance);
    }
    test_run_destroy(run);
}

static void
test_flat_stays_flat(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 5);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 3);
    const int32_t count = otx_surface_leaf(&s)->vert_count;

    (void)state;
    for (int32_t v = 0; v < count; ++v)
    {
        assert_true(s.points[3 * v + 2] == 0.0f);
        assert_true(s.normals[3 * v + 2] == 1.0f);
    }
    /* Edge and corner: the square keeps its outline. */
    assert_near(s.area, 25.0, 1e-4);
    test_run_destroy(run);
}

static void
test_boundary_rules(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 4);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;
    int32_t holes = 0;

    (void)state;
    options.boundary = OTX_BOUNDARY_EDGE_ONLY;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 3);
    assert_true(s.points[0] > 0.01f);
    assert_true(s.area < 15.95);

    options.boundary = OTX_BOUNDARY_NONE;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 2);
    for (int32_t f = 0; f < 16; ++f)
        holes += s.levels[0].face_hole[f];
    assert_int_equal(holes, 12);
    assert_near(s.area, 4.0, 0.1);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    {
        const otx_cage_input small = mesh_grid(run, 2);

        cage = mesh_build(run, &small, &options);
        assert_int_equal(
            otx_surface_refine(run, &cage, 2, 0, &s), OSDTEX_ERROR_TOPOLOGY);
        assert_non_null(strstr(test_last_message(run), "edgeAndCorner"));
    }
    test_run_destroy(run);
}

/* The cube's limit at its corner 0, whose edges are creased by `sharpness`. */
static double
creased_corner(float sharpness, bool chaikin)
{
    static const int32_t creases[] = {0, 1, 0, 2, 0, 6};
    const float all[] = {sharpness, sharpness, sharpness};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;
    double x;

    options.crease_chaikin = chaikin;
    in.crease_verts = creases;
    in.crease_sharpness = all;
    in.crease_count = 3;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 5);
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    x = -s.points[0];
    test_run_destroy(run);
    return x;
}

static void
test_creases(void **state)
{
    double last = 0.5;

    (void)state;
    assert_near(creased_corner(0.0f, false), 0.5, tolerance);
    assert_near(creased_corner(10.0f, false), 1.0, tolerance);
    assert_near(creased_corner(INFINITY, false), 1.0, tolerance);
    for (int32_t i = 1; i <= 4; ++i)
    {
        const double x = creased_corner((float)i, false);

        assert_true(x > last + 1e-4 && x < 1.0);
        last = x;
    }
}

/* Chaikin's rule averages sharpness along a crease; it tells from the uniform
 * rule where two sharpnesses meet. */
static void
test_chaikin(void **state)
{
    static const int32_t creases[] = {0, 1, 1, 3, 3, 2, 2, 0};
    static const float sharpness[] = {1.0f, 3.0f, 1.0f, 3.0f};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_cage cages[2];
    otx_surface s, t;
    double difference = 0.0;

    (void)state;
    in.crease_verts = creases;
    in.crease_sharpness = sharpness;
    in.crease_count = 4;
    cages[0] = mesh_build(run, &in, &options);
    options.crease_chaikin = 1;
    cages[1] = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cages[0], 4);
    t = mesh_refine(run, &cages[1], 4);
    for (int32_t i = 0; i < 3 * otx_surface_leaf(&s)->vert_count; ++i)
        difference = fmax(difference, fabs(s.points[i] - t.points[i]));
    assert_true(difference > 1e-3);
    assert_int_equal(otx_surface_validate(run, &t), OSDTEX_OK);
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

/* Breaks one array at a time: the checker must see each. */
static void
test_validate_sees_damage(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 3);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 2);
    const otx_level *l = &s.levels[1];
    const int32_t *const arrays[] = {
        l->face_verts,         l->face_edges,      l->edge_verts,
        l->edge_faces,         l->face_parent,     l->face_child_first,
        l->edge_child_vert,    l->face_child_vert, l->face_cage,
        s.levels[2].face_verts};

    (void)state;
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    for (int32_t i = 0; i < COUNT(arrays); ++i)
    {
        int32_t *entry = (int32_t *)(uintptr_t)&arrays[i][5];
        const int32_t kept = *entry;

        *entry = kept + 1;
        if (otx_surface_validate(run, &s) != OSDTEX_ERROR_NUMERIC)
            fail_msg("damage to array %d is not seen", i);
        *entry = INT32_MAX;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
        *entry = kept;
    }
    {
        float *point = (float *)(uintptr_t)&s.points[7];
        float *normal = (float *)(uintptr_t)&s.normals[11];
        uint8_t *hole = (uint8_t *)(uintptr_t)&l->face_hole[3];

        *hole = 1;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
        *hole = 0;
        *point = NAN;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
        *point = 0.0f;
        *normal += 0.1f;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
    }
    test_run_destroy(run);
}

/* Every cage of a folder at levels 0 to 3. */
static int32_t
refine_folder(const char *folder)
{
    DIR *dir = opendir(folder);
    const struct dirent *entry;
    int32_t count = 0;

    while (dir && (entry = readdir(dir)))
    {
        const char *dot = strrchr(entry->d_name, '.');
        char path[512];

        if (!dot || strcmp(dot, ".obj") != 0)
            continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        ++count;
        for (int32_t level = 0; level <= 3; ++level)
        {
            otx_run *run = test_run_create();
            otx_surface s;
            otx_cage cage;

            if (mesh_cage_from_file(run, path, &cage) != OSDTEX_OK ||
                otx_surface_refine(run, &cage, level, 0, &s) != OSDTEX_OK ||
                otx_surface_validate(run, &s) != OSDTEX_OK)
                fail_msg(
                    "%s at level %d: %s", path, level, test_last_message(run));
            test_run_destroy(run);
        }
    }
    if (dir)
        closedir(dir);
    return count;
}

static void
test_model_cages(void **state)
{
    (void)state;
    assert_true(refine_folder("models/cages") >= 10);
}

static void
test_real_cages(void **state)
{
    const int32_t count = refine_folder(SHARED_DATA "/cages");

    (void)state;
    if (count == 0)
    {
        print_message("skipped: no " SHARED_DATA "\n");
        skip();
    }
    assert_int_equal(count, 31);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cube_limit),
        cmocka_unit_test(test_octahedron_limit),
        cmocka_unit_test(test_bilinear_keeps_the_cage),
        cmocka_unit_test(test_plain_mesh),
        cmocka_unit_test(test_refinement_commutes_with_affine_maps),
        cmocka_unit_test(test_flat_stays_flat),
        cmocka_unit_test(test_boundary_rules),
        cmocka_unit_test(test_creases),
        cmocka_unit_test(test_chaikin),
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
        cmocka_unit_test(test_validate_sees_damage),
        cmocka_unit_test(test_model_cages),
        cmocka_unit_test(test_real_cages)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
