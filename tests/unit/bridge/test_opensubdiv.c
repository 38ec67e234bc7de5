#include "bridge/opensubdiv.h"

#include "support.h"
#include "test_opensubdiv_reference.h"

#include <math.h>

/* A quad, a triangle and a pentagon around vertex 1, with a boundary. */
static const float points[] = {0, 0, 0, 1, 0, 0.5f, 1, 1, 0, 0,  1, 0.25f, 2, 0,
                               0, 2, 1, 1, 1, -1,   0, 3, 0, -1, 2, -1,    0};
static const int32_t sizes[] = {4, 4, 5, 3};
static const int32_t verts[] = {0, 1, 2, 3, 1, 4, 5, 2, 6, 8, 7, 4, 1, 0, 6, 1};
static const float uvs[] = {0, 0, 1, 0, 1, 1, 0, 1, 0.5f, 0.25f};
static const int32_t face_uvs[] = {
    0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 4, 0, 1, 2};

static const float octahedron[] = {
    1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
static const int32_t threes[] = {3, 3, 3, 3, 3, 3, 3, 3};
static const int32_t octahedron_verts[] = {
    0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

static otx_osd_mesh
mixed_mesh(otx_osd_scheme scheme)
{
    static const int32_t creases[] = {1, 2, 1, 4};
    static const float sharpness[] = {2.5f, 10.0f};
    static const int32_t corners[] = {0};
    static const float corner_sharpness[] = {1.5f};

    return (otx_osd_mesh){
        .scheme = scheme,
        .boundary = 2,
        .fvar = 2,
        .vert_count = 9,
        .face_count = 4,
        .face_sizes = sizes,
        .face_verts = verts,
        .crease_count = 2,
        .crease_verts = creases,
        .crease_sharpness = sharpness,
        .corner_tag_count = 1,
        .corner_tag_verts = corners,
        .corner_tag_sharpness = corner_sharpness,
        .uv_count = 5,
        .face_uvs = face_uvs};
}

static otx_osd_mesh
loop_mesh(void)
{
    return (otx_osd_mesh){
        .scheme = OTX_OSD_LOOP,
        .boundary = 2,
        .fvar = 2,
        .vert_count = 6,
        .face_count = 8,
        .face_sizes = threes,
        .face_verts = octahedron_verts};
}

/* Points, tangents and UVs through the bridge, bit by bit as Far's own. */
static void
compare(const otx_osd_mesh *mesh, const float *from, int32_t level)
{
    otx_run *run = test_run_create();
    reference_osd *want = reference_osd_create(mesh, from, uvs, level);
    const size_t n = (size_t)reference_osd_vert_count(want);
    float *a = OTX_NEW(run->arena, float, 3 * n);
    float *b = OTX_NEW(run->arena, float, 3 * n);
    float *limit = OTX_NEW(run->arena, float, 3 * n);
    float *tangents = OTX_NEW(run->arena, float, 6 * n);
    otx_osd *osd;

    assert_int_equal(otx_osd_create(run->scratch, mesh, &osd), OSDTEX_OK);
    assert_int_equal(otx_osd_refine(osd, level), OSDTEX_OK);
    assert_int_equal(otx_osd_counts_at(osd, level).verts, n);
    for (int32_t l = 1; l <= level; ++l)
    {
        float *to = l & 1 ? a : b;

        assert_int_equal(otx_osd_check_prefix(osd, l - 1), OSDTEX_OK);
        assert_int_equal(otx_osd_refine_points(osd, l, from, to), OSDTEX_OK);
        from = to;
    }
    assert_memory_equal(from, reference_osd_refined(want), 12 * n);
    assert_int_equal(
        otx_osd_limit_points(osd, from, limit, tangents), OSDTEX_OK);
    assert_memory_equal(limit, reference_osd_limit(want), 12 * n);
    for (size_t v = 0; v < n; ++v)
        assert_memory_equal(
            tangents + 6 * v, reference_osd_tan1(want) + 3 * v, 12);
    reference_osd_destroy(want);
    test_run_destroy(run);
}

static void
test_points_are_fars_own(void **state)
{
    (void)state;
    for (int32_t level = 1; level <= 4; ++level)
    {
        for (int32_t boundary = 1; boundary <= 2; ++boundary)
        {
            otx_osd_mesh mesh = mixed_mesh(OTX_OSD_CATMARK);

            mesh.boundary = boundary;
            compare(&mesh, points, level);
            mesh.crease_chaikin = true;
            mesh.triangles_smooth = true;
            compare(&mesh, points, level);
        }
        {
            const otx_osd_mesh bilinear = mixed_mesh(OTX_OSD_BILINEAR);
            const otx_osd_mesh loop = loop_mesh();

            compare(&bilinear, points, level);
            compare(&loop, octahedron, level);
        }
    }
}

static void
test_uvs_are_fars_own(void **state)
{
    enum
    {
        LEVEL = 3
    };

    (void)state;
    for (int32_t fvar = 0; fvar < 6; ++fvar)
    {
        otx_run *run = test_run_create();
        otx_osd_mesh mesh = mixed_mesh(OTX_OSD_CATMARK);
        float *values[LEVEL + 2];
        reference_osd *want;
        otx_osd *osd;
        size_t n;

        mesh.fvar = fvar;
        want = reference_osd_create(&mesh, points, uvs, LEVEL);
        n = (size_t)reference_osd_uv_count(want);
        assert_int_equal(otx_osd_create(run->scratch, &mesh, &osd), OSDTEX_OK);
        assert_int_equal(otx_osd_refine(osd, LEVEL), OSDTEX_OK);
        assert_int_equal(otx_osd_counts_at(osd, LEVEL).uvs, n);
        for (int32_t l = 0; l <= LEVEL + 1; ++l)
            values[l] = OTX_NEW(run->arena, float, 2 * n);
        memcpy(values[0], uvs, sizeof uvs);
        for (int32_t l = 1; l <= LEVEL; ++l)
            assert_int_equal(
                otx_osd_refine_uvs(osd, l, values[l - 1], values[l]),
                OSDTEX_OK);
        assert_int_equal(
            otx_osd_limit_uvs(osd, values[LEVEL], values[LEVEL + 1]),
            OSDTEX_OK);
        assert_memory_equal(
            values[LEVEL + 1], reference_osd_uvs(want), 2 * n * sizeof(float));
        reference_osd_destroy(want);
        test_run_destroy(run);
    }
}

/* Exports level `level`, and checks faces against Far's. */
static void
export_level(
    otx_run *run, const otx_osd *osd, const reference_osd *want, int32_t level,
    const int32_t *face_first, int32_t *face_verts)
{
    const otx_osd_counts n = otx_osd_counts_at(osd, level);
    const otx_osd_relations to = {
        .face_first = face_first,
        .face_verts = face_verts,
        .face_edges = OTX_NEW(run->arena, int32_t, n.corners),
        .edge_verts = OTX_NEW(run->arena, int32_t, 2 * (size_t)n.edges),
        .edge_faces = OTX_NEW(run->arena, int32_t, 2 * (size_t)n.edges),
        .face_hole = OTX_NEW(run->arena, uint8_t, n.faces)};

    assert_int_equal(
        otx_osd_export_faces(osd, level, (otx_osd_range){0, n.faces}, &to),
        OSDTEX_OK);
    assert_int_equal(
        otx_osd_export_edges(osd, level, (otx_osd_range){0, n.edges}, &to),
        OSDTEX_OK);
    for (int32_t f = 0; f < n.faces; ++f)
    {
        for (int32_t i = face_first[f]; i < face_first[f + 1]; ++i)
            assert_int_equal(
                face_verts[i],
                reference_osd_face_vert(want, level, f, i - face_first[f]));
    }
}

static void
test_relations(void **state)
{
    otx_run *run = test_run_create();
    const otx_osd_mesh mesh = mixed_mesh(OTX_OSD_CATMARK);
    reference_osd *want = reference_osd_create(&mesh, points, uvs, 1);
    const int32_t base_first[] = {0, 4, 8, 13, 16};
    int32_t wrong_first[] = {0, 4, 7, 13, 16};
    int32_t first[17];
    int32_t face_verts[64];
    otx_osd *osd;

    (void)state;
    for (int32_t f = 0; f <= 16; ++f)
        first[f] = 4 * f;
    assert_int_equal(otx_osd_create(run->scratch, &mesh, &osd), OSDTEX_OK);
    assert_int_equal(otx_osd_refine(osd, 1), OSDTEX_OK);
    export_level(run, osd, want, 0, base_first, face_verts);
    assert_memory_equal(face_verts, verts, sizeof verts);
    export_level(run, osd, want, 1, first, face_verts);
    {
        int32_t edges[64];
        uint8_t hole[16];
        const otx_osd_relations to = {
            .face_first = wrong_first,
            .face_verts = face_verts,
            .face_edges = edges,
            .face_hole = hole};

        assert_int_equal(
            otx_osd_export_faces(osd, 0, (otx_osd_range){0, 4}, &to),
            OSDTEX_ERROR_NUMERIC);
    }
    reference_osd_destroy(want);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_are_fars_own),
        cmocka_unit_test(test_uvs_are_fars_own),
        cmocka_unit_test(test_relations)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
