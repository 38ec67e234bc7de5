#include "cage_findings.h"

#include <unistd.h>

static void
test_a_good_cage_is_kept(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const otx_cage cage = mesh_build(run, &in, NULL);

    (void)state;
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 0);
    assert_int_equal(cage.edge_count, 12);
    assert_int_equal(cage.corner_count, 24);
    assert_true(fabs(cage.diagonal - sqrt(12.0)) < 1e-12);
    assert_true(fabs(cage.mean_edge_length - 2.0) < 1e-12);
    assert_memory_equal(cage.points, cube_points, sizeof cube_points);
    assert_memory_equal(cage.face_verts, cube_verts, sizeof cube_verts);
    assert_ptr_not_equal(cage.points, cube_points);
    assert_int_equal(cage.boundary, OTX_BOUNDARY_EDGE_AND_CORNER);
    assert_int_equal(cage.fvar, OTX_FVAR_CORNERS_PLUS1);
    assert_false(cage.crease_chaikin);
    assert_false(cage.triangles_smooth);
    assert_int_equal(cage.face_group[5], -1);
    test_run_destroy(run);
}

static void
test_user_then_file_then_default(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage_options options = otx_cage_options_default();
    otx_cage cage;

    (void)state;
    in.boundary = OTX_BOUNDARY_EDGE_ONLY;
    in.fvar = OTX_FVAR_ALL;
    in.crease_chaikin = 1;
    options.fvar = OTX_FVAR_NONE;
    cage = mesh_build(run, &in, &options);
    assert_int_equal(cage.boundary, OTX_BOUNDARY_EDGE_ONLY);
    assert_int_equal(cage.fvar, OTX_FVAR_NONE);
    assert_true(cage.crease_chaikin);

    in.fvar = 17;
    options.fvar = OTX_CAGE_UNSET;
    cage = mesh_build(run, &in, &options);
    assert_int_equal(cage.fvar, OTX_FVAR_CORNERS_PLUS1);
    assert_int_equal(last_finding(run).severity, OSDTEX_SEVERITY_WARNING);

    options.boundary = 3;
    assert_int_equal(
        otx_cage_build(run, &in, &options, &cage), OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

static void
test_isolated_vertices_are_kept(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    float points[30] = {0};
    otx_cage cage;

    (void)state;
    memcpy(points, cube_points, sizeof cube_points);
    points[24] = 1000.0f;
    in.points = points;
    in.vert_count = 10;
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(cage.vert_count, 10);
    assert_true(fabs(cage.diagonal - sqrt(12.0)) < 1e-12);
    assert_int_equal(last_finding(run).severity, OSDTEX_SEVERITY_WARNING);
    assert_non_null(strstr(test_last_message(run), "2 vertices"));
    assert_int_equal(last_finding(run).vertex, 8);
    test_run_destroy(run);
}

static void
test_tags(void **state)
{
    int32_t creases[] = {0, 1, 1, 3, 0, 3};
    float sharpness[] = {2.5f, INFINITY, 1.0f};
    const int64_t lines[] = {7, 8, 9};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage cage;

    (void)state;
    in.crease_count = 3;
    in.crease_verts = creases;
    in.crease_sharpness = sharpness;
    in.crease_line = lines;
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(cage.crease_count, 2);
    assert_true(cage.crease_sharpness[0] == 2.5f);
    assert_true(cage.crease_sharpness[1] == 10.0f);
    assert_non_null(strstr(test_last_message(run), "no edge between"));
    assert_int_equal(last_finding(run).line, 9);

    creases[3] = 8;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "crease refers to vertex 8");
    creases[3] = 3;
    sharpness[0] = NAN;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "sharpness");
    sharpness[0] = -1.0f;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "sharpness -1");
    test_run_destroy(run);
}

static void
test_corners_and_holes(void **state)
{
    int32_t corner = 2;
    float sharpness = 25.0f;
    int32_t holes[] = {1, 1, 2, 0, 3, 4, 5};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage cage;

    (void)state;
    in.corner_tag_count = 1;
    in.corner_tag_verts = &corner;
    in.corner_tag_sharpness = &sharpness;
    in.hole_faces = holes;
    in.hole_count = 3;
    cage = mesh_build(run, &in, NULL);
    assert_true(cage.corner_tag_sharpness[0] == 10.0f);
    assert_int_equal(cage.face_hole[1] + cage.face_hole[2], 2);
    assert_int_equal(cage.face_hole[0], 0);
    in.hole_count = 7;
    expect(run, &in, OSDTEX_ERROR_TOPOLOGY, "every face is tagged as a hole");
    holes[0] = 6;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "hole refers to face 6");
    holes[0] = -1;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "hole refers to face -1");
    in.hole_count = 0;
    corner = -1;
    expect(run, &in, OSDTEX_ERROR_FORMAT, "corner refers to vertex -1");
    test_run_destroy(run);
}

static void
test_names_are_carried(void **state)
{
    static const char *const materials[] = {"red paint", "steel"};
    static const int32_t face_material[] = {-1, 0, 0, 1, 1, 7};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_cube(run);
    otx_cage cage;

    (void)state;
    in.material_count = 2;
    in.material_names = materials;
    in.face_material = face_material;
    in.library_count = 1;
    in.library_names = materials;
    cage = mesh_build(run, &in, NULL);
    assert_string_equal(cage.material_names[cage.face_material[4]], "steel");
    assert_int_equal(cage.face_material[0], -1);
    assert_int_equal(cage.face_material[5], -1);
    assert_string_equal(cage.library_names[0], "red paint");
    test_run_destroy(run);
}

/* Each is either refused with a sentence or makes a surface that validates. */
static void
test_hostile_files(void **state)
{
    static const char *const refused[] = {
        "catmark_nonman_edges", "catmark_nonman_quadpole8",
        "fan3_nonmanifold",     "obj_bad_crease",
        "obj_huge_index",       "obj_mixed_winding_cube",
        "tinyobj_test-nan",     "xatlas_degenerate_edge",
        "assimp_point_cloud",   "assimp_regr_3429812"};
    static const char *const accepted[] = {
        "catmark_nonman_bareverts", "catmark_val2_back2back",
        "catmark_nonman_verts",     "loop_nonman_verts",
        "xatlas_zero_area_face",    "xatlas_double_sided",
        "obj_negative_indices",     "assimp_box_without_lineending"};
    char path[256];

    (void)state;
    snprintf(path, sizeof path, SHARED_DATA "/hostile/%s.obj", refused[0]);
    if (access(path, R_OK) != 0)
    {
        print_message("skipped: no " SHARED_DATA "\n");
        skip();
    }
    for (int32_t i = 0; i < COUNT(refused) + COUNT(accepted); ++i)
    {
        const bool good = i >= COUNT(refused);
        otx_run *run = test_run_create();
        otx_status status;
        otx_cage cage;

        snprintf(
            path, sizeof path, SHARED_DATA "/hostile/%s.obj",
            good ? accepted[i - COUNT(refused)] : refused[i]);
        status = mesh_cage_from_file(run, path, &cage);
        if ((status == OSDTEX_OK) != good)
            fail_msg("%s: %d %s", path, status, test_last_message(run));
        if (good)
        {
            const otx_surface s = mesh_refine(run, &cage, 3);

            assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
        }
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_good_cage_is_kept),
        cmocka_unit_test(test_user_then_file_then_default),
        cmocka_unit_test(test_isolated_vertices_are_kept),
        cmocka_unit_test(test_tags),
        cmocka_unit_test(test_corners_and_holes),
        cmocka_unit_test(test_names_are_carried),
        cmocka_unit_test(test_hostile_files)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
