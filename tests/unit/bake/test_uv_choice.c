/* test_uv_choice.c -- own UVs that can be baked onto, and those that cannot. */
#include "unit/bake/flat.h"

#include "bake/uv_choice.h"
#include "surface/draft.h"

/* n x n quads whose UVs are their plane, moved and stretched. */
static otx_cage_input
unwrapped_grid(otx_run *run, int32_t n, float u, float v, float side)
{
    const int32_t count = (n + 1) * (n + 1);
    otx_cage_input in = mesh_grid(run, n);
    float *uvs = OTX_NEW(run->arena, float, 2 * count);

    for (int32_t i = 0; i < count; ++i)
    {
        uvs[2 * i] = u + side * in.points[3 * i] / (float)n;
        uvs[2 * i + 1] = v + side * in.points[3 * i + 1] / (float)n;
    }
    in.uvs = uvs;
    in.uv_count = count;
    in.face_uvs = in.face_verts;
    return in;
}

static otx_surface
draft_of(otx_run *run, const otx_cage_input *in)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface draft;

    options.scheme = OTX_SCHEME_BILINEAR;
    *cage = mesh_build(run, in, &options);
    assert_int_equal(otx_surface_draft(run, cage, 2, &draft), OSDTEX_OK);
    return draft;
}

static otx_uv_survey
survey_of(otx_run *run, const otx_cage_input *in)
{
    const otx_surface draft = draft_of(run, in);
    otx_uv_survey survey;

    assert_int_equal(otx_uv_survey_run(run, &draft, &survey), OSDTEX_OK);
    return survey;
}

/* What `asked` comes to, or the status of a refusal. */
static int
choice_of(otx_run *run, const otx_cage_input *in, otx_layout_source asked)
{
    const otx_surface draft = draft_of(run, in);
    otx_layout_source source;
    otx_uv_survey survey;
    const otx_status status =
        otx_uv_choose(run, &draft, asked, &source, &survey);

    return status == OSDTEX_OK ? (int)source : (int)status;
}

static void
neighbours_do_not_overlap(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = unwrapped_grid(run, 7, 0.013f, 0.027f, 0.9f);
    const otx_uv_survey s = survey_of(run, &in);

    (void)state;
    assert_int_equal(s.outside, 0);
    assert_int_equal(s.flat, 0);
    assert_true(s.overlap == 0.0);
    assert_true(fabs(s.depth - 1.0) < 1e-12);
    /* Seven units on nine tenths of a tile. */
    assert_true(fabs(s.side - 7.0 / 0.9) < 1e-4);
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_OWN);
    test_run_destroy(run);
}

/* The right half on the left one. */
static void
mirrored_halves_overlap(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = unwrapped_grid(run, 4, 0.0f, 0.0f, 1.0f);
    float *uvs = OTX_NEW(run->arena, float, 2 * in.uv_count);

    (void)state;
    for (int32_t i = 0; i < 2 * in.uv_count; ++i)
        uvs[i] = i % 2 == 0 && in.uvs[i] > 0.5f ? 1.0f - in.uvs[i] : in.uvs[i];
    in.uvs = uvs;

    const otx_uv_survey s = survey_of(run, &in);

    assert_true(s.overlap == 1.0);
    assert_true(fabs(s.depth - 2.0) < 1e-12);
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_ATLAS);
    assert_non_null(strstr(test_last_message(run), "so an atlas is baked"));
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_OWN), OTX_LAYOUT_OWN);
    assert_non_null(strstr(test_last_message(run), "100 % of what"));
    test_run_destroy(run);
}

/* Every face the whole unit square, as modellers write before unwrapping. */
static void
what_was_never_unwrapped_is_refused(void **state)
{
    static const float square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    otx_run *run = test_run_create();
    otx_cage_input in = mesh_grid(run, 60);
    int32_t *face_uvs = OTX_NEW(run->arena, int32_t, 4 * in.face_count);

    (void)state;
    for (int32_t c = 0; c < 4 * in.face_count; ++c)
        face_uvs[c] = c % 4;
    in.uvs = square;
    in.uv_count = 4;
    in.face_uvs = face_uvs;
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_ATLAS);
    assert_non_null(strstr(test_last_message(run), "never unwrapped"));
    assert_int_equal(
        choice_of(run, &in, OTX_LAYOUT_OWN), OSDTEX_ERROR_TOPOLOGY);
    test_run_destroy(run);
}

static void
what_leaves_the_tiles_is_refused(void **state)
{
    static const float places[][2] = {
        {-0.5f, 0.0f},
        {0.0f, -0.1f},
        {9.5f, 0.0f},
        {9.0f, 899.0f},
        {0.0f, 899.5f}};
    otx_run *run = test_run_create();
    otx_cage_input in;

    (void)state;
    for (int i = 0; i < COUNT(places); ++i)
    {
        in = unwrapped_grid(run, 2, places[i][0], places[i][1], 1.0f);
        assert_int_equal(
            choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_ATLAS);
        assert_int_equal(
            choice_of(run, &in, OTX_LAYOUT_OWN), OSDTEX_ERROR_TOPOLOGY);
    }
    in = unwrapped_grid(run, 2, 8.0f, 899.0f, 1.0f);
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_OWN);
    in = unwrapped_grid(run, 2, -0.000001f, 0.0f, 1.0f);
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_OWN);
    test_run_destroy(run);
}

static void
what_has_no_area_is_refused(void **state)
{
    otx_run *run = test_run_create();
    otx_cage_input in = unwrapped_grid(run, 3, 0.5f, 0.5f, 0.0f);

    (void)state;
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_ATLAS);
    assert_int_equal(
        choice_of(run, &in, OTX_LAYOUT_OWN), OSDTEX_ERROR_TOPOLOGY);
    in = mesh_grid(run, 3);
    assert_int_equal(choice_of(run, &in, OTX_LAYOUT_AUTO), OTX_LAYOUT_ATLAS);
    assert_int_equal(
        choice_of(run, &in, OTX_LAYOUT_OWN), OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

/* A cage of more faces than a draft has is looked at as it is, and its areas
 * are those of the surface. */
static void
drafts_are_small(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input small = mesh_grid(run, 10);
    const otx_cage_input large = mesh_grid(run, 150);
    const otx_surface a = draft_of(run, &small), b = draft_of(run, &large);

    (void)state;
    assert_int_equal(otx_surface_leaf(&a)->face_count, 1600);
    assert_int_equal(otx_surface_leaf(&b)->face_count, 150 * 150);
    assert_true(fabs(a.area - 100.0) < 1e-3);
    assert_true(fabs(b.area - 150.0 * 150.0) < 1e-1);
    assert_true(fabs(b.mean_edge_length - 1.0) < 1e-6);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_do_not_overlap),
        cmocka_unit_test(mirrored_halves_overlap),
        cmocka_unit_test(what_was_never_unwrapped_is_refused),
        cmocka_unit_test(what_leaves_the_tiles_is_refused),
        cmocka_unit_test(what_has_no_area_is_refused),
        cmocka_unit_test(drafts_are_small),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
