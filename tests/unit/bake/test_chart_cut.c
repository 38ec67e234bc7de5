/* test_chart_cut.c -- every face lies in one chart, unfolded and welded. */
#include "unit/bake/flat.h"

#include "bake/chart_cut.h"

static const char *const CAGES[] = {
    "models/cages/jack.obj", "models/cages/ngons_and_triangles.obj",
    "models/cages/loop_open.obj", "models/cages/hole.obj"};

static double
area_of(const otx_cage *cage, const otx_chart_cut *cut, int32_t face)
{
    const int32_t first = cage->face_first[face];
    const int32_t n = cage->face_first[face + 1] - first;
    double sum = 0.0;

    for (int32_t k = 0; k < n; ++k)
        sum += 0.5 * otx_vec2_cross(
                         cut->flat[first + k], cut->flat[first + (k + 1) % n]);
    return sum;
}

/* Corners of a chart that are one vertex are at one place. */
static void
check_welds(const otx_cage *cage, const otx_chart_cut *cut, int32_t chart)
{
    for (int32_t i = cut->first[chart]; i < cut->first[chart + 1]; ++i)
        for (int32_t j = cut->first[chart]; j < i; ++j)
            for (int32_t a = cage->face_first[cut->faces[i]];
                 a < cage->face_first[cut->faces[i] + 1]; ++a)
                for (int32_t b = cage->face_first[cut->faces[j]];
                     b < cage->face_first[cut->faces[j] + 1]; ++b)
                    if (cage->face_verts[a] == cage->face_verts[b])
                        assert_memory_equal(
                            &cut->flat[a], &cut->flat[b], sizeof *cut->flat);
}

static void
faces_are_in_one_chart(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof CAGES / sizeof *CAGES; ++i)
    {
        otx_run *run = test_run_create();
        otx_chart_cut cut;
        otx_cage cage;
        int32_t *seen;

        assert_int_equal(mesh_cage_from_file(run, CAGES[i], &cage), OSDTEX_OK);

        const otx_surface surface = mesh_refine(run, &cage, 2);

        assert_int_equal(
            otx_chart_cut_make(run, &surface, INFINITY, &cut), OSDTEX_OK);
        seen = OTX_ZNEW(run->arena, int32_t, cage.face_count);
        for (int32_t c = 0; c < cut.chart_count; ++c)
        {
            check_welds(&cage, &cut, c);
            for (int32_t k = cut.first[c]; k < cut.first[c + 1]; ++k)
            {
                ++seen[cut.faces[k]];
                assert_true(area_of(&cage, &cut, cut.faces[k]) > 0.0);
            }
        }
        for (int32_t f = 0; f < cage.face_count; ++f)
            assert_int_equal(
                seen[f], !(surface.levels[0].face_hole &&
                           surface.levels[0].face_hole[f]));
        assert_true(cut.chart_count < cage.face_count);
        assert_true(cut.stretch >= 1.0 && cut.stretch < 1.5);
        test_run_destroy(run);
    }
}

/* ---- rims ---- */

typedef struct rim
{
    otx_vec2 ends[2];
} rim;

/* Whether a face of the chart, other than f, has the edge the other way. */
static bool
is_inside(
    const otx_cage *cage, const otx_chart_cut *cut, int32_t chart, int32_t a,
    int32_t b)
{
    for (int32_t i = cut->first[chart]; i < cut->first[chart + 1]; ++i)
    {
        const int32_t f = cut->faces[i];
        const int32_t first = cage->face_first[f];
        const int32_t n = cage->face_first[f + 1] - first;

        for (int32_t k = 0; k < n; ++k)
            if (cage->face_verts[first + k] == b &&
                cage->face_verts[first + (k + 1) % n] == a)
                return true;
    }
    return false;
}

static int32_t
list_rim(
    const otx_cage *cage, const otx_chart_cut *cut, int32_t chart, rim *out)
{
    int32_t count = 0;

    for (int32_t i = cut->first[chart]; i < cut->first[chart + 1]; ++i)
    {
        const int32_t first = cage->face_first[cut->faces[i]];
        const int32_t n = cage->face_first[cut->faces[i] + 1] - first;

        for (int32_t k = 0; k < n; ++k)
        {
            const int32_t c = first + k, d = first + (k + 1) % n;

            if (!is_inside(
                    cage, cut, chart, cage->face_verts[c], cage->face_verts[d]))
                out[count++] = (rim){{cut->flat[c], cut->flat[d]}};
        }
    }
    return count;
}

static double
side_of(const rim *r, otx_vec2 p)
{
    return otx_vec2_cross(
        otx_vec2_sub(r->ends[1], r->ends[0]), otx_vec2_sub(p, r->ends[0]));
}

static bool
cross(const rim *a, const rim *b)
{
    return side_of(a, b->ends[0]) * side_of(a, b->ends[1]) < 0.0 &&
           side_of(b, a->ends[0]) * side_of(b, a->ends[1]) < 0.0;
}

/* Whatever was parted in which round: no chart lies on itself. */
static void
no_rim_crosses_itself(void **state)
{
    static const char *const cages[] = {
        "models/cages/jack.obj",         "models/cages/hole.obj",
        "models/cages/double_torus.obj", "models/cages/creature.obj",
        "models/cages/chaikin.obj",      "models/cages/high_valence.obj"};

    (void)state;
    for (size_t i = 0; i < sizeof cages / sizeof *cages; ++i)
    {
        otx_run *run = test_run_create();
        otx_chart_cut cut;
        otx_cage cage;
        rim *rims;

        assert_int_equal(mesh_cage_from_file(run, cages[i], &cage), OSDTEX_OK);

        const otx_surface surface = mesh_refine(run, &cage, 1);

        assert_int_equal(
            otx_chart_cut_make(run, &surface, INFINITY, &cut), OSDTEX_OK);
        rims = OTX_NEW(run->arena, rim, cage.face_first[cage.face_count]);
        for (int32_t c = 0; c < cut.chart_count; ++c)
        {
            const int32_t count = list_rim(&cage, &cut, c, rims);

            for (int32_t a = 0; a < count; ++a)
                for (int32_t b = 0; b < a; ++b)
                    if (cross(&rims[a], &rims[b]))
                        fail_msg("chart %d of %s", (int)c, cages[i]);
        }
        test_run_destroy(run);
    }
}

/* What is flat is one chart of its own shape; smaller ones where it must be. */
static void
a_plane_is_one_chart(void **state)
{
    otx_run *run = test_run_create();
    otx_chart_cut cut;
    otx_cage cage;

    (void)state;
    assert_int_equal(
        mesh_cage_from_file(run, "models/cages/plane.obj", &cage), OSDTEX_OK);

    const otx_surface surface = mesh_refine(run, &cage, 0);

    assert_int_equal(
        otx_chart_cut_make(run, &surface, INFINITY, &cut), OSDTEX_OK);
    assert_int_equal(cut.chart_count, 1);
    assert_true(cut.stretch < 1.0001);
    assert_int_equal(otx_chart_cut_make(run, &surface, 3.0, &cut), OSDTEX_OK);
    assert_true(cut.chart_count > 1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_are_in_one_chart),
        cmocka_unit_test(no_rim_crosses_itself),
        cmocka_unit_test(a_plane_is_one_chart),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
