/* test_refine.c -- the cage's texture coordinates on the levels, by each of
 * the face-varying rules. */
#include "meshes.h"

static const double tolerance = 2e-5;

/* UV of the leaf corner at cage vertex `vert` in a descendant of `face`. */
static const float *
uv_at(const otx_surface *s, int32_t face, int32_t vert)
{
    const otx_level *leaf = otx_surface_leaf(s);

    for (int32_t i = 0; i < leaf->corner_count; ++i)
    {
        if (leaf->face_verts[i] == vert && leaf->face_cage[i / 4] == face)
            return s->uvs + 2 * s->face_uvs[i];
    }
    fail_msg("no corner");
    return NULL;
}

/* The left island's corner at vertex 2 stays under all rules but NONE, which
 * smooths the border like a curve: (u1 + 4 u2 + u3) / 6. The straight seam
 * stays where it is under all. */
static void
test_fvar_rules(void **state)
{
    (void)state;
    for (int32_t fvar = 0; fvar <= OTX_FVAR_ALL; ++fvar)
    {
        otx_run *run = test_run_create();
        const otx_cage_input in = mesh_islands(run);
        otx_cage_options options = otx_cage_options_default();
        const float *corner;
        otx_surface s;
        otx_cage cage;

        options.fvar = fvar;
        cage = mesh_build(run, &in, &options);
        s = mesh_refine(run, &cage, 2);
        corner = uv_at(&s, 1, 2);
        assert_near(corner[0], fvar == OTX_FVAR_NONE ? 11.0 / 6 : 2, tolerance);
        assert_near(corner[1], fvar == OTX_FVAR_NONE ? 1.0 / 6 : 0, tolerance);
        /* Vertex 12, the grid's centre, lies on the seam. */
        assert_near(uv_at(&s, 5, 12)[0], 2.0, tolerance);
        assert_near(uv_at(&s, 5, 12)[1], 2.0, tolerance);
        assert_near(uv_at(&s, 6, 12)[0], 12.0, tolerance);
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
        test_run_destroy(run);
    }
}

/* A UV layout that tells the six rules apart: the grid's centre has three
 * values (a junction), and a concave corner. */
static otx_cage_input
mesh_junction(otx_run *run)
{
    otx_cage_input in = mesh_grid(run, 4);
    float *uvs = OTX_NEW(run->arena, float, 2 * 75);
    int32_t *face_uvs = OTX_NEW(run->arena, int32_t, 64);

    for (int32_t v = 0; v < 75; ++v)
    {
        uvs[2 * v] = in.points[3 * (v % 25)] + 10.0f * (float)(v / 25) +
                     0.25f * (float)(v % 3);
        uvs[2 * v + 1] =
            in.points[3 * (v % 25) + 1] + 0.125f * (float)(v % 5 * (v % 2));
    }
    for (int32_t i = 0; i < 64; ++i)
    {
        const int32_t x = i / 4 % 4;
        const int32_t y = i / 16;
        /* An L of three quarters, in one island with its arm split off. */
        const int32_t island = x < 2 ? 0 : y < 2 ? 1 : x < 3 ? 2 : 1;

        face_uvs[i] = in.face_verts[i] + 25 * island;
    }
    in.uvs = uvs;
    in.uv_count = 75;
    in.face_uvs = face_uvs;
    return in;
}

static void
test_fvar_rules_differ(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_junction(run);
    otx_surface s[6];
    otx_cage cages[6];
    int32_t same = 0;

    (void)state;
    for (int32_t fvar = 0; fvar < 6; ++fvar)
    {
        otx_cage_options options = otx_cage_options_default();

        options.fvar = fvar;
        cages[fvar] = mesh_build(run, &in, &options);
        s[fvar] = mesh_refine(run, &cages[fvar], 2);
    }
    for (int32_t a = 0; a < 6; ++a)
    {
        for (int32_t b = 0; b < a; ++b)
        {
            double difference = 0.0;

            for (int32_t i = 0; i < otx_surface_leaf(&s[0])->corner_count; ++i)
            {
                const float *u = s[a].uvs + 2 * s[a].face_uvs[i];
                const float *v = s[b].uvs + 2 * s[b].face_uvs[i];

                difference = fmax(difference, fabs(u[0] - v[0]));
                difference = fmax(difference, fabs(u[1] - v[1]));
            }
            if (difference < 1e-4)
            {
                print_message("rules %d and %d agree\n", a, b);
                ++same;
            }
        }
    }
    assert_int_equal(same, 0);
    test_run_destroy(run);
}

/* UV of a leaf vertex that is the centre of a cage face: the mean of the
 * face's corners under ALL. */
static void
test_fvar_all_is_bilinear(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_junction(run);
    otx_cage_options options = otx_cage_options_default();
    otx_surface s;
    otx_cage cage;

    (void)state;
    options.fvar = OTX_FVAR_ALL;
    cage = mesh_build(run, &in, &options);
    s = mesh_refine(run, &cage, 1);
    for (int32_t f = 0; f < 16; ++f)
    {
        double mean[2] = {0.0, 0.0};
        const float *centre = uv_at(&s, f, s.levels[0].face_child_vert[f]);

        for (int32_t k = 0; k < 4; ++k)
        {
            const int32_t uv = in.face_uvs[4 * f + k];
            const float *corner = uv_at(&s, f, in.face_verts[4 * f + k]);

            mean[0] += 0.25 * in.uvs[2 * uv];
            mean[1] += 0.25 * in.uvs[2 * uv + 1];
            assert_memory_equal(corner, in.uvs + 2 * uv, 8);
        }
        assert_near(centre[0], mean[0], 1e-6);
        assert_near(centre[1], mean[1], 1e-6);
    }
    test_run_destroy(run);
}

/* At level 0 a corner's UV is the limit that the levels below converge on. */
static void
test_uvs_of_level_0(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_junction(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface coarse = mesh_refine(run, &cage, 0);
    const otx_surface fine = mesh_refine(run, &cage, 3);

    (void)state;
    for (int32_t f = 0; f < 16; ++f)
    {
        for (int32_t i = 4 * f; i < 4 * f + 4; ++i)
        {
            const float *want = uv_at(&fine, f, in.face_verts[i]);
            const float *got = coarse.uvs + 2 * coarse.face_uvs[i];

            assert_near(got[0], want[0], 5e-5);
            assert_near(got[1], want[1], 5e-5);
        }
    }
    for (int32_t i = 0; i < 3 * cage.vert_count; ++i)
        assert_near(coarse.points[i], fine.points[i], tolerance);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fvar_rules),
        cmocka_unit_test(test_fvar_rules_differ),
        cmocka_unit_test(test_fvar_all_is_bilinear),
        cmocka_unit_test(test_uvs_of_level_0),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
