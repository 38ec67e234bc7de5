/* test_layout.c -- atlases, UDIM tiles, charts, and the rule "linear all". */
#include "unit/bake/flat.h"

#include "bake/atlas.h"
#include "bake/fvar_linear.h"

static otx_cage
cage_of(otx_run *run, const char *path)
{
    otx_cage cage;

    if (mesh_cage_from_file(run, path, &cage) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return cage;
}

static const char *const CAGES[] = {
    "models/cages/creature.obj", "models/cages/ngons_and_triangles.obj",
    "models/cages/loop_open.obj", "models/cages/creased.obj"};

static void
a_density_opens_tiles(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage cage = cage_of(run, "models/cages/creature.obj");
    const otx_surface surface = mesh_refine(run, &cage, 1);
    otx_mapping *mapping = flat_mapping(run, &surface, 10.0);
    const otx_layout_options options = {
        OTX_LAYOUT_ATLAS, 256, 4, 16.0 * 256.0 / cage.diagonal};
    otx_layout layout;

    (void)state;
    assert_int_equal(
        otx_layout_build(run, mapping, &options, &layout), OSDTEX_OK);
    assert_true(layout.tile_count > 10);
    assert_int_equal(layout.tiles[0], 1001);
    for (int32_t t = 1; t < layout.tile_count; ++t)
        assert_int_equal(layout.tiles[t], 1001 + t);
    test_run_destroy(run);
}

/* OpenSubdiv, given the atlas and its rule, has the same coordinates. */
static void
the_rule_is_opensubdivs(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof CAGES / sizeof *CAGES; ++i)
    {
        otx_run *run = test_run_create();
        otx_cage cage = cage_of(run, CAGES[i]);
        const otx_surface surface = mesh_refine(run, &cage, 2);
        const int32_t corners = otx_surface_leaf(&surface)->corner_count;
        const otx_atlas_options options = {1024, 0, 0.0};
        float *ours = OTX_NEW(run->arena, float, 2 * corners);
        int32_t *face_uvs = OTX_NEW(run->arena, int32_t, cage.corner_count);
        otx_atlas atlas;

        otx_atlas_pack(run, &surface, &options, &atlas);
        assert_int_equal(
            otx_fvar_linear(run, &surface, atlas.uvs, ours), OSDTEX_OK);
        for (int32_t c = 0; c < cage.corner_count; ++c)
            face_uvs[c] = c;
        cage.uv_count = cage.corner_count;
        cage.uvs = atlas.uvs;
        cage.face_uvs = face_uvs;
        cage.fvar = OTX_FVAR_ALL;

        const otx_surface theirs = mesh_refine(run, &cage, 2);

        for (int32_t c = 0; c < corners; ++c)
            for (int k = 0; k < 2; ++k)
                assert_true(
                    fabsf(
                        ours[2 * c + k] -
                        theirs.uvs[2 * theirs.face_uvs[c] + k]) < 1e-6f);
        test_run_destroy(run);
    }
}

/* A sheet with own UVs: its plane, moved by (u, v), of whose refined corners
 * the first lies farther to the left by `bulge`. */
static otx_status
lay_out_bulge(otx_run *run, float u, float v, float bulge, otx_layout *out)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    otx_cage_input in = mesh_grid(run, 2);
    float *uvs = OTX_NEW(run->arena, float, 18);
    const otx_layout_options how = {OTX_LAYOUT_OWN, 64, 0, 0.0};

    for (int32_t i = 0; i < 9; ++i)
    {
        uvs[2 * i] = 0.5f * in.points[3 * i] + u;
        uvs[2 * i + 1] = 0.5f * in.points[3 * i + 1] + v;
    }
    in.uvs = uvs;
    in.uv_count = 9;
    in.face_uvs = in.face_verts;
    options.scheme = OTX_SCHEME_BILINEAR;
    *cage = mesh_build(run, &in, &options);
    *surface = mesh_refine(run, cage, 1);
    ((float *)(uintptr_t)surface->uvs)[2 * surface->face_uvs[0]] -= bulge;
    return otx_layout_build(run, flat_mapping(run, surface, 2.0), &how, out);
}

static otx_status
lay_out_own(otx_run *run, float u, float v, otx_layout *out)
{
    return lay_out_bulge(run, u, v, 0.0f, out);
}

/* What a draft of the cage does not show is no reason to refuse the bake. */
static void
a_border_may_bulge_by_a_texel(void **state)
{
    otx_run *run = test_run_create();
    otx_layout layout;

    (void)state;
    assert_int_equal(lay_out_bulge(run, 0.0f, 0.0f, 9e-4f, &layout), OSDTEX_OK);
    assert_int_equal(layout.tile_count, 1);
    assert_int_equal(layout.tiles[0], 1001);
    assert_int_equal(
        lay_out_bulge(run, 0.0f, 0.0f, 2e-3f, &layout), OSDTEX_ERROR_TOPOLOGY);
    test_run_destroy(run);
}

static void
own_uvs_are_on_their_tiles(void **state)
{
    otx_run *run = test_run_create();
    otx_layout layout;

    (void)state;
    assert_int_equal(lay_out_own(run, 0.0f, 0.0f, &layout), OSDTEX_OK);
    assert_int_equal(layout.tile_count, 1);
    assert_int_equal(layout.tiles[0], 1001);
    assert_int_equal(lay_out_own(run, 3.0f, 2.0f, &layout), OSDTEX_OK);
    assert_int_equal(layout.tile_count, 1);
    assert_int_equal(layout.tiles[0], 1024);
    /* Half over the border of a tile. */
    assert_int_equal(lay_out_own(run, 0.5f, 0.0f, &layout), OSDTEX_OK);
    assert_int_equal(layout.tile_count, 2);
    assert_int_equal(layout.tiles[1], 1002);
    assert_int_equal(
        lay_out_own(run, -0.5f, 0.0f, &layout), OSDTEX_ERROR_TOPOLOGY);
    assert_int_equal(
        lay_out_own(run, 9.5f, 0.0f, &layout), OSDTEX_ERROR_TOPOLOGY);
    assert_int_equal(lay_out_own(run, 8.0f, 899.0f, &layout), OSDTEX_OK);
    assert_int_equal(layout.tiles[0], 9999);
    assert_int_equal(
        lay_out_own(run, 9.0f, 899.0f, &layout), OSDTEX_ERROR_TOPOLOGY);
    test_run_destroy(run);
}

static void
charts_are_what_hangs_together(void **state)
{
    otx_run *run = test_run_create();
    otx_layout own;
    const otx_surface *surface = flat_surface(run, 3, 2);
    const otx_mapping *mapping = flat_mapping(run, surface, 3.0);
    const otx_layout atlas =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, 256, 4);
    const otx_level *leaf = otx_surface_leaf(surface);

    (void)state;
    assert_int_equal(lay_out_own(run, 0.0f, 0.0f, &own), OSDTEX_OK);
    for (int32_t f = 0; f < otx_surface_leaf(own.surface)->face_count; ++f)
        assert_int_equal(own.chart[f], 0);
    for (int32_t f = 1; f < leaf->face_count; ++f)
        assert_int_equal(
            atlas.chart[f] == atlas.chart[f - 1],
            leaf->face_cage[f] == leaf->face_cage[f - 1]);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_density_opens_tiles),
        cmocka_unit_test(the_rule_is_opensubdivs),
        cmocka_unit_test(own_uvs_are_on_their_tiles),
        cmocka_unit_test(a_border_may_bulge_by_a_texel),
        cmocka_unit_test(charts_are_what_hangs_together),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
