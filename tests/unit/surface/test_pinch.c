/* test_pinch.c -- cages whose parts touch only at vertices. */
#include "meshes.h"

#include "bridge/opensubdiv.h"
#include "surface/pinch.h"

#include <unistd.h>

/* What OpenSubdiv makes of the cage as it is, pinch vertices shared. */
typedef struct shared_surface
{
    otx_osd_relations leaf;
    otx_osd_counts n;
    float *points;
} shared_surface;

static otx_osd_mesh
mesh_of(otx_run *run, const otx_cage *cage)
{
    int32_t *sizes = OTX_NEW(run->arena, int32_t, cage->face_count);

    for (int32_t f = 0; f < cage->face_count; ++f)
        sizes[f] = cage->face_first[f + 1] - cage->face_first[f];
    return (otx_osd_mesh){
        .scheme =
            cage->scheme == OTX_SCHEME_LOOP ? OTX_OSD_LOOP : OTX_OSD_CATMARK,
        .boundary = (int32_t)cage->boundary,
        .fvar = (int32_t)cage->fvar,
        .vert_count = cage->vert_count,
        .face_count = cage->face_count,
        .face_sizes = sizes,
        .face_verts = cage->face_verts,
        .crease_count = cage->crease_count,
        .crease_verts = cage->crease_verts,
        .crease_sharpness = cage->crease_sharpness,
        .corner_tag_count = cage->corner_tag_count,
        .corner_tag_verts = cage->corner_tag_verts,
        .corner_tag_sharpness = cage->corner_tag_sharpness};
}

static shared_surface
refine_shared(otx_run *run, const otx_cage *cage, int32_t level)
{
    const int32_t size = cage->scheme == OTX_SCHEME_LOOP ? 3 : 4;
    const otx_osd_mesh mesh = mesh_of(run, cage);
    shared_surface s = {0};
    const float *from = cage->points;
    int32_t *first;
    float *tangents;
    otx_osd *osd;

    assert_int_equal(otx_osd_create(run->arena, &mesh, &osd), OSDTEX_OK);
    assert_int_equal(otx_osd_refine(osd, level), OSDTEX_OK);
    for (int32_t l = 1; l <= level; ++l)
    {
        s.n = otx_osd_counts_at(osd, l);
        s.points = OTX_NEW(run->arena, float, 3 * s.n.verts);
        assert_int_equal(
            otx_osd_refine_points(osd, l, from, s.points), OSDTEX_OK);
        from = s.points;
    }
    s.points = OTX_NEW(run->arena, float, 3 * s.n.verts);
    tangents = OTX_NEW(run->arena, float, 6 * s.n.verts);
    assert_int_equal(
        otx_osd_limit_points(osd, from, s.points, tangents), OSDTEX_OK);
    first = OTX_NEW(run->arena, int32_t, s.n.faces + 1);
    for (int32_t f = 0; f <= s.n.faces; ++f)
        first[f] = size * f;
    s.leaf = (otx_osd_relations){
        .face_first = first,
        .face_verts = OTX_NEW(run->arena, int32_t, s.n.corners),
        .face_edges = OTX_NEW(run->arena, int32_t, s.n.corners),
        .face_hole = OTX_NEW(run->arena, uint8_t, s.n.faces)};
    assert_int_equal(
        otx_osd_export_faces(
            osd, level, (otx_osd_range){0, s.n.faces}, &s.leaf),
        OSDTEX_OK);
    return s;
}

/* Every corner of every leaf face lies where OpenSubdiv has it. */
static void
expect_opensubdiv(otx_run *run, const otx_cage *cage, int32_t level)
{
    const otx_surface s = mesh_refine(run, cage, level);
    const shared_surface theirs = refine_shared(run, cage, level);
    const otx_level *leaf = otx_surface_leaf(&s);

    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    assert_ptr_equal(s.cage, cage);
    assert_int_equal(leaf->corner_count, theirs.n.corners);
    assert_int_equal(
        s.levels[0].vert_count, cage->vert_count + cage->split_count);
    for (int32_t c = 0; c < leaf->corner_count; ++c)
        for (int32_t k = 0; k < 3; ++k)
            assert_near(
                s.points[3 * leaf->face_verts[c] + k],
                theirs.points[3 * theirs.leaf.face_verts[c] + k],
                1e-5 * cage->diagonal);
}

/* Two quads at a corner, and two pyramids at their tips: open fans and closed
 * ones. */
static void
test_parts_stay_where_they_touch(void **state)
{
    static const float quads[] = {
        0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 2, 0, 1, 2, 0, 2, 1, 0};
    static const int32_t quad_verts[] = {0, 1, 2, 3, 2, 6, 4, 5};
    static const float tips[] = {
        0, 0, 0, 1, 0, 1, 0, 1, 1, -1, -1, 1, 1, 0, -1, 0, 1, -1, -1, -1, -1};
    static const int32_t tip_verts[] = {
        0, 1, 2, 0, 2, 3, 0, 3, 1, 3, 2, 1, 0, 5, 4, 0, 6, 5, 0, 4, 6, 4, 5, 6};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_input(run, quads, 7, quad_verts, 2, 4);
    otx_cage_options options = otx_cage_options_default();
    otx_cage cage = mesh_build(run, &in, NULL);

    (void)state;
    assert_int_equal(cage.split_count, 1);
    assert_int_equal(cage.vert_count, 7);
    assert_memory_equal(cage.face_verts, quad_verts, sizeof quad_verts);
    for (int32_t level = 1; level <= 3; ++level)
        expect_opensubdiv(run, &cage, level);
    in = mesh_input(run, tips, 7, tip_verts, 8, 3);
    for (int i = 0; i < 2; ++i)
    {
        options.scheme = i ? OTX_SCHEME_LOOP : OTX_SCHEME_CATMARK;
        cage = mesh_build(run, &in, &options);
        assert_int_equal(cage.split_count, 1);
        expect_opensubdiv(run, &cage, 2);
    }
    test_run_destroy(run);
}

/* The new vertices lie behind the cage's own; a crease that ends at a pinch
 * keeps to its edge, and level 0 has the limit too. */
static void
test_tags_follow_their_edges(void **state)
{
    static const float points[] = {
        0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 2, 0, 1, 2, 0, 2, 1, 0};
    static const int32_t verts[] = {0, 1, 2, 3, 2, 6, 4, 5};
    static const int32_t creases[] = {2, 6, 3, 2};
    static const int32_t corner[] = {2};
    static const float sharpness[] = {3.0f, 4.0f};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_input(run, points, 7, verts, 2, 4);
    otx_cage cage, parted;
    otx_surface s;

    (void)state;
    in.crease_verts = creases;
    in.crease_sharpness = sharpness;
    in.crease_count = 2;
    in.corner_tag_verts = corner;
    in.corner_tag_sharpness = sharpness;
    in.corner_tag_count = 1;
    cage = mesh_build(run, &in, NULL);
    assert_int_equal(otx_pinch_split(run, &cage, &parted), OSDTEX_OK);
    assert_int_equal(parted.vert_count, 8);
    assert_int_equal(parted.face_verts[2], 2);
    assert_int_equal(parted.face_verts[4], 7);
    assert_int_equal(parted.crease_verts[0] + parted.crease_verts[1], 7 + 6);
    assert_int_equal(parted.crease_verts[2] + parted.crease_verts[3], 2 + 3);
    assert_int_equal(cage.crease_verts[0], 2);
    s = mesh_refine(run, &cage, 0);
    for (int32_t k = 0; k < 3; ++k)
    {
        assert_near(s.points[3 * 2 + k], points[3 * 2 + k], 0.0);
        assert_near(s.points[3 * 7 + k], points[3 * 2 + k], 0.0);
    }
    expect_opensubdiv(run, &cage, 2);
    test_run_destroy(run);
}

/* OpenSubdiv's own shapes with such vertices. */
static void
test_real_pinches(void **state)
{
    static const char *const names[] = {
        "catmark_nonman_verts", "loop_nonman_verts"};
    char path[256];

    (void)state;
    for (int32_t i = 0; i < COUNT(names); ++i)
    {
        otx_run *run = test_run_create();
        otx_cage cage;

        snprintf(path, sizeof path, SHARED_DATA "/hostile/%s.obj", names[i]);
        if (access(path, R_OK) != 0)
        {
            test_run_destroy(run);
            print_message("skipped: no " SHARED_DATA "\n");
            skip();
        }
        assert_int_equal(mesh_cage_from_file(run, path, &cage), OSDTEX_OK);
        assert_true(cage.split_count >= 4);
        expect_opensubdiv(run, &cage, 3);
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts_stay_where_they_touch),
        cmocka_unit_test(test_tags_follow_their_edges),
        cmocka_unit_test(test_real_pinches)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
