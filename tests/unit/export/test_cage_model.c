/* test_cage_model.c -- the cage goes out as it came in, with other UVs. */
#include "unit/bake/flat.h"

#include "export/cage_model.h"

static otx_cage
cage_of(otx_run *run, const char *path)
{
    otx_cage cage;

    if (mesh_cage_from_file(run, path, &cage) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return cage;
}

static const char *const CAGES[] = {
    "creased",  "corner",  "hole",      "ngons_and_triangles", "semi_sharp",
    "uv_seams", "dialect", "loop_open", "materials_and_groups"};

static otx_layout
layout_of(otx_run *run, const otx_cage *cage, otx_layout_source source)
{
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);

    *surface = mesh_refine(run, cage, 1);
    return flat_layout(run, flat_mapping(run, surface, 10.0), source, 256, 0);
}

/* What is written, taken as a file would be, makes the same cage. */
static void
what_goes_out_is_the_same_cage(void **state)
{
    (void)state;
    for (int32_t i = 0; i < COUNT(CAGES); ++i)
    {
        otx_run *run = test_run_create();
        char path[96];
        otx_obj obj;

        snprintf(path, sizeof path, "models/cages/%s.obj", CAGES[i]);

        const otx_cage cage = cage_of(run, path);
        const otx_layout layout = layout_of(run, &cage, OTX_LAYOUT_ATLAS);
        otx_cage_options options = otx_cage_options_default();

        assert_int_equal(
            otx_cage_model_obj(run, &layout, "out.obj", "out.mtl", "m", &obj),
            OSDTEX_OK);
        options.scheme = cage.scheme;

        const otx_cage_input in = mesh_from_obj(&obj);
        const otx_cage back = mesh_build(run, &in, &options);

        assert_int_equal(back.vert_count, cage.vert_count);
        assert_int_equal(back.face_count, cage.face_count);
        assert_memory_equal(
            back.points, cage.points,
            3 * sizeof(float) * (size_t)cage.vert_count);
        assert_memory_equal(
            back.face_verts, cage.face_verts,
            sizeof(int32_t) * (size_t)cage.corner_count);
        assert_memory_equal(
            back.face_hole, cage.face_hole, (size_t)cage.face_count);
        assert_int_equal(back.crease_count, cage.crease_count);
        assert_int_equal(back.corner_tag_count, cage.corner_tag_count);
        assert_int_equal(back.boundary, cage.boundary);
        assert_int_equal(back.crease_chaikin, cage.crease_chaikin);
        assert_int_equal(back.triangles_smooth, cage.triangles_smooth);
        assert_int_equal(back.group_count, cage.group_count);
        assert_int_equal(back.fvar, OTX_FVAR_ALL);
        assert_int_equal(back.uv_count, layout.uv_count);
        assert_string_equal(obj.libraries.text[0], "out.mtl");
        /* No face is without a material, or it would show no texture. */
        for (int32_t f = 0; f < obj.face_count; ++f)
            assert_true(
                obj.face_material[f] >= 0 &&
                obj.face_material[f] < obj.materials.count);
        test_run_destroy(run);
    }
}

static void
own_uvs_keep_their_rule(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage cage = cage_of(run, "models/cages/uv_seams.obj");
    const otx_layout own = layout_of(run, &cage, OTX_LAYOUT_OWN);
    const otx_layout atlas = layout_of(run, &cage, OTX_LAYOUT_ATLAS);
    otx_usda usda;

    (void)state;
    assert_int_equal(otx_cage_model_fvar(&own), cage.fvar);
    assert_int_equal(otx_cage_model_fvar(&atlas), OTX_FVAR_ALL);
    otx_cage_model_usda(&own, "cage", &usda);
    assert_string_equal(usda.fvar, "boundaries");
    assert_ptr_equal(usda.uvs, own.uvs);
    assert_int_equal(usda.uv_count, cage.uv_count);
    otx_cage_model_usda(&atlas, "cage", &usda);
    assert_string_equal(usda.fvar, "all");
    assert_string_equal(usda.scheme, "catmullClark");
    assert_int_equal(usda.face_count, cage.face_count);
    test_run_destroy(run);
}

/* The names that USD has for OpenSubdiv's rules. */
static void
rules_have_names(void **state)
{
    (void)state;
    assert_string_equal(otx_cage_model_fvar_name(OTX_FVAR_NONE), "none");
    assert_string_equal(
        otx_cage_model_fvar_name(OTX_FVAR_CORNERS_ONLY), "cornersOnly");
    assert_string_equal(otx_cage_model_fvar_name(OTX_FVAR_ALL), "all");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_goes_out_is_the_same_cage),
        cmocka_unit_test(own_uvs_keep_their_rule),
        cmocka_unit_test(rules_have_names),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
