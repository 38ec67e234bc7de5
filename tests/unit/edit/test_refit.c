/* test_refit.c -- what is held stays to the bit, what is open is covered. */
#include "edits.h"

/* Faces below a few faces of the cage. */
static uint8_t *
mark(const edits *e, int32_t cage_faces, uint8_t state)
{
    uint8_t *out = OTX_ZNEW(e->run->arena, uint8_t, e->leaf->face_count);

    for (int32_t f = 0; f < e->leaf->face_count; ++f)
        if (e->leaf->face_cage[f] < cage_faces)
            out[f] = state;
    return out;
}

static otx_mapping
refit(edits *e, const uint8_t *state)
{
    const otx_refit what = {&e->job, e->method, &e->mapping, state, false};
    otx_mapping out;

    if (otx_refit_run(&what, &out) != OSDTEX_OK)
        fail_msg("%s", test_last_message(e->run));
    edits_check(e, &out);
    return out;
}

static void
nothing_to_do_is_nothing_changed(void **state)
{
    edits *e = edits_open();
    const otx_mapping out = refit(e, mark(e, 0, 0));

    (void)state;
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
        assert_true(edits_same(e, &e->mapping, &out, f));
    test_run_destroy(e->run);
}

static void
all_but_the_open_part_is_as_it_was(void **state)
{
    edits *e = edits_open();
    int32_t changed = 0, part = 0;

    (void)state;
    e->run->seed = 99;
    for (uint8_t how = OTX_REFIT_EITHER; how <= OTX_REFIT_OPEN; ++how)
    {
        const uint8_t *open = mark(e, 6, how);
        const otx_mapping out = refit(e, open);

        for (int32_t f = 0; f < e->leaf->face_count; ++f)
        {
            if (open[f] == OTX_REFIT_HELD)
                assert_true(edits_same(e, &e->mapping, &out, f));
            changed += open[f] == OTX_REFIT_OPEN &&
                       !edits_same(e, &e->mapping, &out, f);
            part += open[f] == OTX_REFIT_OPEN;
        }
    }
    assert_true(changed > part / 2);
    test_run_destroy(e->run);
}

/* Faces that are free keep their patch where nothing new is beside them, and
 * what they share with held ones stays. */
static void
what_is_free_moves_by_itself(void **state)
{
    edits *e = edits_open();
    const uint8_t *free = mark(e, 4, OTX_REFIT_FREE);
    const otx_mapping out = refit(e, free);

    (void)state;
    assert_int_equal(out.patch_count, e->mapping.patch_count);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
    {
        assert_int_equal(out.face_patch[f], e->mapping.face_patch[f]);
        if (free[f] == OTX_REFIT_HELD)
            assert_true(edits_same(e, &e->mapping, &out, f));
    }
    test_run_destroy(e->run);
}

/* Whatever is done again and again: numbers of patches are used again. */
static void
numbers_do_not_run_away(void **state)
{
    edits *e = edits_open();
    const uint8_t *open = mark(e, 6, OTX_REFIT_OPEN);
    int32_t most = 0;

    (void)state;
    for (int round = 0; round < 6; ++round)
    {
        e->run->seed = (uint64_t)round;
        e->mapping = refit(e, open);
        if (round == 1)
            most = e->mapping.patch_count;
    }
    assert_true(e->mapping.patch_count <= most + 4);
    test_run_destroy(e->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_to_do_is_nothing_changed),
        cmocka_unit_test(all_but_the_open_part_is_as_it_was),
        cmocka_unit_test(what_is_free_moves_by_itself),
        cmocka_unit_test(numbers_do_not_run_away),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
