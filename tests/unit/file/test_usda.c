/* test_usda.c -- the text says what the cage is, and names stay valid. */
#include "folder.h"

#include "file/usda.h"
#include "file/usda_name.h"

#include <math.h>

static const float POINTS[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5f, 2, 0, 0};
static const int32_t FIRST[] = {0, 4, 7};
static const int32_t VERTS[] = {0, 1, 2, 3, 1, 4, 2};
static const float UVS[] = {0, 0, 1, 0, 1, 1, 0, 1, 0.25f, 0.5f};
static const int32_t FACE_UVS[] = {0, 1, 2, 3, 1, 4, 2};
static const int32_t CREASE[] = {1, 2};
static const float SHARP[] = {2.5f};
static const int32_t CORNER[] = {4};
static const float CORNER_SHARP[] = {10.0f};
static const uint8_t HOLES[] = {0, 1};
static const char *const GROUPS[] = {"left arm", "left.arm"};
static const int32_t FACE_GROUP[] = {1, 0};

static otx_usda
small_cage(void)
{
    return (otx_usda){
        .name = "2 shirts",
        .scheme = "catmullClark",
        .boundary = "edgeAndCorner",
        .fvar = "all",
        .triangles = "smooth",
        .vert_count = 5,
        .face_count = 2,
        .corner_count = 7,
        .uv_count = 5,
        .points = POINTS,
        .face_first = FIRST,
        .face_verts = VERTS,
        .uvs = UVS,
        .face_uvs = FACE_UVS,
        .crease_count = 1,
        .corner_tag_count = 1,
        .crease_verts = CREASE,
        .crease_sharpness = SHARP,
        .corner_tag_verts = CORNER,
        .corner_tag_sharpness = CORNER_SHARP,
        .face_hole = HOLES,
        .groups = {2, GROUPS, FACE_GROUP},
        .meters_per_unit = 0.01,
        .z_up = true,
        .texture = "shirts.<UDIM>.exr",
        .interop_id = "lin_ap1_scene",
    };
}

/* The file that is written, in the run's arena. */
static char *
written(otx_run *run, const otx_usda *usda)
{
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "a.usda");
    char *text;

    if (otx_usda_write(run, usda, path, NULL) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    text = test_read_text(run, path);
    test_folder_remove(&folder);
    return text;
}

static void
assert_says(const char *text, const char *line)
{
    if (!strstr(text, line))
        fail_msg("'%s' is missing in\n%s", line, text);
}

static void
everything_of_a_cage_is_said(void **state)
{
    static const char *const lines[] = {
        "#usda 1.0\n",
        "defaultPrim = \"_2_shirts\"",
        "metersPerUnit = 0.01\n    upAxis = \"Z\"\n",
        "uniform token subdivisionScheme = \"catmullClark\"",
        "        token interpolateBoundary = \"edgeAndCorner\"",
        "        token faceVaryingLinearInterpolation = \"all\"",
        "        token triangleSubdivisionRule = \"smooth\"",
        "int[] faceVertexCounts = [4, 3]",
        "int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 2]",
        "(0, 1, 0.5), (2, 0, 0)]",
        "float3[] extent = [(0, 0, 0), (2, 1, 0.5)]",
        "int[] creaseIndices = [1, 2]",
        "int[] creaseLengths = [2]",
        "float[] creaseSharpnesses = [2.5]",
        "int[] cornerIndices = [4]",
        "float[] cornerSharpnesses = [10]",
        "int[] holeIndices = [1]",
        "interpolation = \"faceVarying\"",
        "int[] primvars:st:indices = [0, 1, 2, 3, 1, 4, 2]",
        "rel material:binding = </_2_shirts/Look>",
        "def GeomSubset \"group_0_left_arm\"",
        "def GeomSubset \"group_1_left_arm\"",
        "uniform token info:id = \"UsdPreviewSurface\"",
        ("asset inputs:file = @shirts.<UDIM>.exr@ (\n"
         "                colorSpace = \"lin_ap1_scene\"\n            )\n"),
        "token inputs:sourceColorSpace = \"raw\"",
    };
    otx_run *run = test_run_create();
    const otx_usda usda = small_cage();
    const char *text = written(run, &usda);

    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i)
        assert_says(text, lines[i]);
    test_run_destroy(run);
}

/* Every map goes where UsdPreviewSurface wants it, as numbers. */
static void
maps_are_connected(void **state)
{
    otx_run *run = test_run_create();
    otx_usda usda = small_cage();
    const char *text;

    (void)state;
    usda.maps = (otx_data_maps){
        .normal = "n.<UDIM>.exr",
        .roughness = "r.exr",
        .metalness = "m.exr",
        .height = "h.exr",
        .occlusion = "o.exr"};
    usda.materialx = "shirts.mtlx";
    text = written(run, &usda);
    assert_says(
        text, "prepend references = "
              "@shirts.mtlx@</MaterialX/Materials/_2_shirts>");
    assert_says(
        text, "normal3f inputs:normal.connect = "
              "</_2_shirts/Look/Normal.outputs:rgb>");
    assert_says(text, "float4 inputs:scale = (2, 2, 2, 1)");
    assert_says(text, "float4 inputs:bias = (-1, -1, -1, 0)");
    assert_says(
        text, "float inputs:roughness.connect = "
              "</_2_shirts/Look/Roughness.outputs:r>");
    assert_says(text, "float inputs:metallic.connect = ");
    assert_says(text, "float inputs:occlusion.connect = ");
    assert_says(text, "float inputs:displacement.connect = ");
    assert_says(
        text, "token outputs:displacement.connect = "
              "</_2_shirts/Look/Surface.outputs:displacement>");
    assert_says(text, "asset inputs:file = @n.<UDIM>.exr@\n");
    assert_null(strstr(text, "inputs:roughness = 0.5"));
    assert_null(strstr(text, "\"sRGB\""));
    test_run_destroy(run);
}

static void
materials_are_bound_to_their_faces(void **state)
{
    static const char *const names[] = {"cap", "stone grey"};
    static const int32_t faces[] = {1, 0};
    otx_run *run = test_run_create();
    otx_usda usda = small_cage();
    const char *text;

    (void)state;
    usda.materials = (otx_usda_subsets){2, names, faces};
    text = written(run, &usda);
    assert_says(text, "def GeomSubset \"material_1_stone_grey\"");
    assert_says(text, "uniform token familyName = \"materialBind\"");
    assert_says(
        text, "rel material:binding = </_2_shirts/material_1_stone_grey>");
    assert_says(text, "def Material \"material_1_stone_grey\" (");
    assert_says(text, "prepend inherits = </_2_shirts/Look>");
    test_run_destroy(run);
}

static void
what_is_not_there_is_not_said(void **state)
{
    otx_run *run = test_run_create();
    otx_usda usda = small_cage();
    const char *text;

    (void)state;
    usda.crease_count = usda.corner_tag_count = 0;
    usda.face_hole = NULL;
    usda.groups = (otx_usda_subsets){0, NULL, NULL};
    usda.interop_id = NULL;
    text = written(run, &usda);
    assert_null(strstr(text, "colorSpace ="));
    assert_null(strstr(text, "crease"));
    assert_null(strstr(text, "corner"));
    assert_null(strstr(text, "hole"));
    assert_null(strstr(text, "GeomSubset"));
    test_run_destroy(run);
}

static void
brackets_close(void **state)
{
    otx_run *run = test_run_create();
    const otx_usda usda = small_cage();
    char open[64];
    int depth = 0;

    (void)state;
    for (const char *c = written(run, &usda); *c; ++c)
    {
        if (strchr("({[", *c))
            open[depth++] = *c;
        else if (strchr(")}]", *c))
        {
            assert_true(depth > 0);
            --depth;
            assert_int_equal(
                open[depth], *c == ')'   ? '('
                             : *c == '}' ? '{'
                                         : '[');
        }
        assert_true(depth < 64);
    }
    assert_int_equal(depth, 0);
    test_run_destroy(run);
}

static void
names_become_identifiers(void **state)
{
    static const char *const names[][2] = {
        {"shirt", "shirt"}, {"2shirt", "_2shirt"}, {"a b-c.d", "a_b_c_d"},
        {"", "_"},          {"\xc3\xa4", "__"},    {"_x9", "_x9"}};
    otx_run *run = test_run_create();

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        assert_string_equal(
            otx_usda_identifier(run->arena, names[i][0]), names[i][1]);
    test_run_destroy(run);
}

static void
numbers_that_are_none_are_refused(void **state)
{
    otx_run *run = test_run_create();
    otx_usda usda = small_cage();
    float points[15];

    (void)state;
    memcpy(points, POINTS, sizeof points);
    points[7] = NAN;
    usda.points = points;
    assert_int_equal(
        otx_usda_write(run, &usda, "/tmp/never", NULL), OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(access("/tmp/never", F_OK), -1);
    test_run_destroy(run);
}

static void
a_folder_that_is_not_there_is_an_error(void **state)
{
    otx_run *run = test_run_create();
    const otx_usda usda = small_cage();

    (void)state;
    assert_int_equal(
        otx_usda_write(run, &usda, "/nowhere/at/all.usda", NULL),
        OSDTEX_ERROR_IO);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_of_a_cage_is_said),
        cmocka_unit_test(maps_are_connected),
        cmocka_unit_test(materials_are_bound_to_their_faces),
        cmocka_unit_test(what_is_not_there_is_not_said),
        cmocka_unit_test(brackets_close),
        cmocka_unit_test(names_become_identifiers),
        cmocka_unit_test(numbers_that_are_none_are_refused),
        cmocka_unit_test(a_folder_that_is_not_there_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
