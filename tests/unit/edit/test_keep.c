/* test_keep.c -- a mapping through changes of the surface below it. */
#include "edits.h"

#include "edit/keep.h"

/* A copy of the points, with those near a leaf vertex pushed along x. */
static float *
push(const edits *e, double by, double radius)
{
    const size_t bytes = 3 * sizeof(float) * (size_t)e->leaf->vert_count;
    float *points = OTX_NEW(e->run->arena, float, 3 * e->leaf->vert_count);
    const otx_vec3 at = otx_vec3_load(e->surface.points, 0);

    memcpy(points, e->surface.points, bytes);
    for (int32_t v = 0; v < e->leaf->vert_count; ++v)
    {
        const double d = otx_vec3_length(
            otx_vec3_sub(otx_vec3_load(e->surface.points, v), at));

        if (d < radius)
            points[3 * v] += (float)(by * (1.0 - d / radius));
    }
    return points;
}

/* The mapping on the surface as it is now, made for `points`. */
static otx_mapping
keep(edits *e, const float *points, otx_keep_tally *tally)
{
    const otx_keep what = {&e->job, e->method, &e->mapping, points, NULL};
    otx_mapping out;

    if (otx_keep_run(&what, &out, tally) != OSDTEX_OK)
        fail_msg("%s", test_last_message(e->run));
    edits_check(e, &out);
    return out;
}

static void
an_unchanged_surface_keeps_all(void **state)
{
    edits *e = edits_open();
    otx_keep_tally tally;
    const otx_mapping out = keep(e, e->surface.points, &tally);

    (void)state;
    assert_int_equal(tally.held, e->leaf->face_count);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
        assert_true(edits_same(e, &e->mapping, &out, f));
    test_run_destroy(e->run);
}

static void
changes_are_relaxed_and_all_else_stays(void **state)
{
    edits *e = edits_open();
    const float *before = push(e, 0.06, 0.4);
    uint8_t *states = OTX_NEW(e->run->arena, uint8_t, e->leaf->face_count);
    const otx_keep what = {&e->job, e->method, &e->mapping, before, NULL};
    otx_keep_tally tally;
    otx_mapping out;

    (void)state;
    out = keep(e, before, &tally);
    assert_int_equal(otx_keep_states(&what, states), OSDTEX_OK);
    assert_true(tally.moved > 0);
    assert_true(tally.held > e->leaf->face_count / 2);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
        if (states[f] == OTX_REFIT_HELD)
            assert_true(edits_same(e, &e->mapping, &out, f));
    test_run_destroy(e->run);
}

static void
what_is_stretched_too_far_is_covered_anew(void **state)
{
    edits *e = edits_open();
    const float *made_for = e->surface.points;
    otx_surface moved = e->surface;
    otx_keep_tally tally;

    (void)state;
    moved.points = push(e, 1.2, 0.5);
    e->job.surface = &moved;
    keep(e, made_for, &tally);
    assert_true(tally.covered > 0);
    assert_int_equal(
        tally.held + tally.moved + tally.covered, e->leaf->face_count);
    test_run_destroy(e->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_unchanged_surface_keeps_all),
        cmocka_unit_test(changes_are_relaxed_and_all_else_stays),
        cmocka_unit_test(what_is_stretched_too_far_is_covered_anew),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
