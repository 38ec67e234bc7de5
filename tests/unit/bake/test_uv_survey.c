/* test_uv_survey.c -- good UVs have nothing said of them; planted faults have.
 */
#include "bake/uv_survey.h"

#include "unit/surface/meshes.h"

enum
{
    N = 4
};

/* A grid whose UVs are its points, in [0, 1]. */
static otx_cage_input
with_uvs(otx_run *run, float **uvs)
{
    otx_cage_input in = mesh_grid(run, N);
    const int32_t verts = (N + 1) * (N + 1);

    *uvs = OTX_NEW(run->arena, float, 2 * verts);
    for (int32_t v = 0; v < verts; ++v)
    {
        (*uvs)[2 * v] = (float)(v % (N + 1)) / N;
        (*uvs)[2 * v + 1] = (float)(v / (N + 1)) / N;
    }
    in.uv_count = verts;
    in.uvs = *uvs;
    in.face_uvs = in.face_verts;
    return in;
}

static otx_uv_survey
survey(otx_run *run, const otx_cage_input *in)
{
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface *s = OTX_NEW(run->arena, otx_surface, 1);
    otx_cage_options options = otx_cage_options_default();
    otx_uv_survey out;

    /* UVs stay as they are. */
    options.scheme = OTX_SCHEME_BILINEAR;
    *cage = mesh_build(run, in, &options);
    *s = mesh_refine(run, cage, 0);
    assert_int_equal(otx_uv_survey_run(run, s, &out), OSDTEX_OK);
    return out;
}

static void
good_uvs_are_good(void **state)
{
    otx_run *run = test_run_create();
    float *uvs;
    const otx_cage_input in = with_uvs(run, &uvs);
    const otx_uv_survey found = survey(run, &in);

    (void)state;
    assert_int_equal(found.face_count, N * N);
    assert_int_equal(found.outside, 0);
    assert_int_equal(found.flat, 0);
    assert_true(found.overlap == 0.0);
    assert_int_equal(found.outside_face, -1);
    assert_int_equal(found.flat_face, -1);
    assert_int_equal(found.overlap_face, -1);
    assert_true(found.side > 0.0);
    test_run_destroy(run);
}

static void
faults_are_found_where_they_are(void **state)
{
    otx_run *run = test_run_create();
    otx_uv_survey found;
    otx_cage_input in;
    float *uvs;

    (void)state;
    /* The last vertex belongs to the last face alone. */
    in = with_uvs(run, &uvs);
    uvs[2 * ((N + 1) * (N + 1) - 1)] = -3.0f;
    found = survey(run, &in);
    assert_int_equal(found.outside, 1);
    assert_int_equal(found.outside_face, N * N - 1);
    /* All of the first column on a line. */
    in = with_uvs(run, &uvs);
    for (int32_t y = 0; y <= N; ++y)
        uvs[2 * (y * (N + 1))] = 1.0f / N;
    found = survey(run, &in);
    assert_int_equal(found.flat, N);
    assert_int_equal(found.flat_face, 0);
    /* Folded in the middle: all lies twice. */
    in = with_uvs(run, &uvs);
    for (int32_t v = 0; v < (N + 1) * (N + 1); ++v)
        uvs[2 * v] = uvs[2 * v] > 0.5f ? 1.0f - uvs[2 * v] : uvs[2 * v];
    found = survey(run, &in);
    assert_true(found.overlap > 0.9);
    assert_near(found.depth, 2.0, 0.1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_uvs_are_good),
        cmocka_unit_test(faults_are_found_where_they_are),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
