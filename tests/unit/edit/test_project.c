/* test_project.c -- a mapping carried to other faces of the same shape. */
#include "edits.h"

#include "edit/keep.h"
#include "edit/project.h"

static otx_projected
project(edits *e, const otx_surface *to)
{
    const otx_project ask = {&e->mapping, &e->surface, e->exemplar, to};
    otx_projected out;

    if (otx_project_run(e->run, &ask, &out) != OSDTEX_OK)
        fail_msg("%s", test_last_message(e->run));
    return out;
}

static void
the_same_faces_show_the_same_to_the_bit(void **state)
{
    edits *e = edits_open();
    const otx_projected p = project(e, &e->surface);

    (void)state;
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
    {
        assert_true(edits_same(e, &e->mapping, &p.mapping, f));
        assert_int_equal(p.loose[f], 0);
    }
    test_run_destroy(e->run);
}

/* Texels between two UVs of the exemplar. */
static double
texels(const edits *e, const float *a, const double *b)
{
    return hypot(
        ((double)a[0] - b[0]) * e->exemplar->match.width,
        ((double)a[1] - b[1]) * e->exemplar->match.height);
}

/* A finer level has its vertices elsewhere, and shows the same between. */
static void
finer_faces_show_what_is_below_them(void **state)
{
    edits *e = edits_open();
    const otx_surface fine =
        sheet_from_file(e->run, "models/cages/torus.obj", 3);
    const otx_level *leaf = otx_surface_leaf(&fine);
    const otx_projected p = project(e, &fine);
    int32_t close = 0, loose = 0;

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t above = f / 4;
        double middle[2] = {0.0, 0.0}, below[2] = {0.0, 0.0};
        float at[2];

        assert_true(p.mapping.face_patch[f] >= 0);
        loose += p.loose[f] > 0;
        for (int k = 0; k < 4; ++k)
            for (int i = 0; i < 2; ++i)
            {
                const size_t was = 4 * (size_t)above + (size_t)k;
                const size_t now = 4 * (size_t)f + (size_t)k;

                middle[i] += 0.25 * (double)e->mapping.uvs[2 * was + i];
                below[i] += 0.25 * (double)p.mapping.uvs[2 * now + i];
            }
        at[0] = (float)below[0];
        at[1] = (float)below[1];
        close += p.mapping.face_patch[f] == e->mapping.face_patch[above] &&
                 texels(e, at, middle) < 4.0;
    }
    assert_true(close > 0.97 * leaf->face_count);
    assert_true(loose < 0.1 * leaf->face_count);
    test_run_destroy(e->run);
}

static void
what_is_far_is_covered_anew(void **state)
{
    edits *e = edits_open();
    const otx_surface other =
        sheet_from_file(e->run, "models/cages/sphere.obj", 2);
    const otx_projected p = project(e, &other);
    otx_keep_tally tally;
    otx_mapping out;

    (void)state;
    e->job.surface = &other;
    {
        const otx_keep what = {
            &e->job, e->method, &p.mapping, p.points, p.loose};

        assert_int_equal(otx_keep_run(&what, &out, &tally), OSDTEX_OK);
    }
    assert_int_equal(
        otx_mapping_check(e->run, &out, &other, e->exemplar, 1, "keep"),
        OSDTEX_OK);
    assert_true(tally.covered > otx_surface_leaf(&other)->face_count / 2);
    test_run_destroy(e->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_faces_show_the_same_to_the_bit),
        cmocka_unit_test(finer_faces_show_what_is_below_them),
        cmocka_unit_test(what_is_far_is_covered_anew),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
