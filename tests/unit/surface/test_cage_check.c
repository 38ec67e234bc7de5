/* test_cage_check.c -- bad cages are refused where they are bad. */
#include "cage_findings.h"

#include <unistd.h>

static void
test_empty(void **state)
{
    otx_run *run = test_run_create();
    static const int32_t zero = 0;
    otx_cage_input in = otx_cage_input_none();

    (void)state;
    in.face_first = &zero;
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "no faces");
    in.points = cube_points;
    in.vert_count = 8;
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "no faces");
    test_run_destroy(run);
}

static void
test_indices(void **state)
{
    static const int32_t bad[] = {8, -1, INT32_MAX, INT32_MIN, 1000000};

    (void)state;
    for (int32_t i = 0; i < COUNT(bad); ++i)
    {
        otx_run *run = test_run_create();
        otx_cage_input in = mesh_cube(run);
        int32_t verts[24];
        const int64_t lines[] = {10, 11, 12, 13, 14, 15};

        memcpy(verts, cube_verts, sizeof verts);
        verts[13] = bad[i];
        in.face_verts = verts;
        in.face_line = lines;
        expect(run, &in, OSDTEX_ERROR_FORMAT, "face 3 refers to vertex");
        assert_int_equal(last_finding(run).line, 13);
        assert_int_equal(last_finding(run).face, 3);
        assert_string_equal(last_finding(run).file, "test.obj");
        test_run_destroy(run);
    }
}

static void
test_faces(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    int32_t verts[24];
    int32_t first[] = {0, 4, 8, 12, 16, 20, 22};

    (void)state;
    in.face_first = first;
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "face 5 has 2 corners");
    first[6] = 20;
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "face 5 has");

    in = mesh_cube(run);
    memcpy(verts, cube_verts, sizeof verts);
    verts[4] = verts[6];
    in.face_verts = verts;
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "face 1 repeats vertex 5");
    test_run_destroy(run);
}

static void
test_like_findings_are_counted(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    int32_t verts[24];

    (void)state;
    memcpy(verts, cube_verts, sizeof verts);
    verts[5] = verts[4];
    verts[9] = verts[8];
    verts[21] = verts[20];
    in.face_verts = verts;
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "face 1 repeats");
    assert_int_equal(last_finding(run).count, 3);
    test_run_destroy(run);
}

static void
test_points(void **state)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 3e38f};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    float points[24];

    (void)state;
    in.points = points;
    for (int32_t i = 0; i < COUNT(bad); ++i)
    {
        memcpy(points, cube_points, sizeof points);
        points[10] = bad[i];
        expect(run, &in, OSDTEX_ERROR_NUMERIC, "vertex 3");
    }
    for (int32_t i = 0; i < 24; ++i)
        points[i] = 4.5f;
    expect(run, &in, OSDTEX_ERROR_NUMERIC, "one point");
    test_run_destroy(run);
}

static void
test_loop_needs_triangles(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_cage cage;

    (void)state;
    options.scheme = OTX_SCHEME_LOOP;
    assert_int_equal(
        otx_cage_build(run, &in, &options, &cage), OSDTEX_ERROR_TOPOLOGY);
    assert_non_null(strstr(test_last_message(run), "scheme catmark"));
    assert_int_equal(last_finding(run).face, 0);

    in = mesh_octahedron(run);
    options.scheme = OTX_SCHEME_CATMARK;
    mesh_build(run, &in, &options);
    assert_int_equal(last_finding(run).severity, OSDTEX_SEVERITY_INFO);
    assert_non_null(strstr(test_last_message(run), "scheme loop"));
    test_run_destroy(run);
}

static void
test_manifold(void **state)
{
    /* Two triangles over an edge, and a third; its winding; a copy. */
    static const float points[] = {
        0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 3, 1, 0, 4, 0, 0};
    static const int32_t three[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    static const int32_t flipped[] = {0, 1, 2, 0, 1, 3};
    static const int32_t copied[] = {0, 1, 2, 1, 2, 0};
    static const int32_t turned[] = {0, 1, 2, 1, 0, 3, 2, 1, 0};
    static const int32_t bow_tie[] = {0, 1, 2, 1, 6, 5};
    static const int32_t pillow[] = {0, 1, 2, 2, 1, 0};
    otx_run *run = test_run_create();
    otx_cage_input in;

    (void)state;
    in = mesh_input(run, points, 7, three, 3, 3);
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "3 faces (0, 1, 2) share the edge");
    in = mesh_input(run, points, 7, flipped, 2, 3);
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "faces 0 and 1 are wound against");
    assert_non_null(strstr(test_last_message(run), "flip one of them"));
    in = mesh_input(run, points, 7, copied, 2, 3);
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "face 1 has the same corners as");
    in = mesh_input(run, points, 7, turned, 3, 3);
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "face 2 has the same corners as");
    assert_non_null(strstr(test_last_message(run), "delete one of them"));
    in = mesh_input(run, points, 7, bow_tie, 2, 3);
    expect(run, &in, OSDTEX_OK, "");
    assert_non_null(strstr(
        finding(run, 1).message, "touch only at 1 vertex (first is vertex 1"));
    assert_int_equal(finding(run, 1).vertex, 1);
    assert_int_equal(finding(run, 1).severity, OSDTEX_SEVERITY_WARNING);
    in = mesh_input(run, points, 3, pillow, 2, 3);
    expect(run, &in, OSDTEX_OK, "");
    test_run_destroy(run);
}

static void
test_faces_without_area(void **state)
{
    static const float points[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 1, 0};
    static const int32_t verts[] = {0, 1, 2, 0, 2, 3};
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_input(run, points, 4, verts, 2, 3);

    (void)state;
    expect(run, &in, OSDTEX_OK, "triangles");
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 2);
    test_run_destroy(run);
}

static void
test_uvs(void **state)
{
    static const float uvs[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const float broken[] = {0, 0, NAN, 0, 1, 1, 0, 1};
    static const float vast[] = {0, 0, 1, 0, 1, -1e30f, 0, 1};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    int32_t face_uvs[24];
    otx_cage cage;

    (void)state;
    for (int32_t i = 0; i < 24; ++i)
        face_uvs[i] = i % 4;
    in.uvs = uvs;
    in.uv_count = 4;
    in.face_uvs = face_uvs;
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(cage.uv_count, 4);
    assert_memory_equal(cage.face_uvs, face_uvs, sizeof face_uvs);

    in.uvs = vast;
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(cage.uv_count, 0);
    assert_non_null(strstr(test_last_message(run), "UV 2 lies at (1, -1e+30)"));
    in.uvs = broken;
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(cage.uv_count, 0);
    in.uvs = uvs;

    memset(face_uvs + 8, -1, 4 * sizeof *face_uvs);
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(cage.uv_count, 0);
    assert_null(cage.face_uvs);
    assert_non_null(strstr(test_last_message(run), "first in face 2"));

    face_uvs[9] = 4;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "face 2 refers to UV 4");
    face_uvs[9] = -2;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "UV -2");
    test_run_destroy(run);
}

static void
test_valence(void **state)
{
    enum
    {
        N = OTX_CAGE_VALENCE_MAX + 1
    };
    otx_run *run = test_run_create();
    float *points = OTX_ZNEW(run->arena, float, 3 * (N + 1));
    int32_t *verts = OTX_NEW(run->arena, int32_t, 3 * N);
    otx_cage_input in = mesh_input(run, points, N + 1, verts, N, 3);

    (void)state;
    for (int32_t i = 0; i < N; ++i)
    {
        points[3 * i] = (float)cos(2.0 * OTX_PI * i / N);
        points[3 * i + 1] = (float)sin(2.0 * OTX_PI * i / N);
        verts[3 * i] = N;
        verts[3 * i + 1] = i;
        verts[3 * i + 2] = (i + 1) % N;
    }
    /* OpenSubdiv squares it as an int. */
    assert_true((int64_t)(N - 1) * (N - 1) <= INT32_MAX);
    expect(run, &in, OSDTEX_ERROR_LIMIT, "vertex 46341 joins 46341 faces");
    in = mesh_input(run, points, N + 1, verts, 1, N);
    for (int32_t i = 0; i < N; ++i)
        verts[i] = i;
    expect(run, &in, OSDTEX_ERROR_LIMIT, "face 0 has 46341 corners");
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty),
        cmocka_unit_test(test_indices),
        cmocka_unit_test(test_faces),
        cmocka_unit_test(test_like_findings_are_counted),
        cmocka_unit_test(test_points),
        cmocka_unit_test(test_loop_needs_triangles),
        cmocka_unit_test(test_manifold),
        cmocka_unit_test(test_faces_without_area),
        cmocka_unit_test(test_uvs),
        cmocka_unit_test(test_valence),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
