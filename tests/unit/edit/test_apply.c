/* test_apply.c -- edits of a mapping change their area and nothing else. */
#include "edits.h"

static const double REACH = 0.5;

typedef struct outcome
{
    otx_status status;
    otx_mapping mapping;
    uint8_t *area;
} outcome;

static outcome
apply(edits *e, otx_constraint item)
{
    const otx_constraint_set set = {.count = 1, .items = &item};
    otx_edit edit = {&e->job, e->method, NULL, 1};
    outcome o = {.area = OTX_ZNEW(e->run->arena, uint8_t, e->leaf->face_count)};

    item.edit = 1;
    item.reach = REACH;
    edit.set = &set;
    o.status = otx_edit_apply(&edit, &e->mapping, &o.mapping);
    if (o.status == OSDTEX_OK)
        assert_int_equal(
            otx_area_find(e->run, &e->surface, &set, 1, 0.0, o.area),
            OSDTEX_OK);
    return o;
}

static int32_t
check_outside(edits *e, const outcome *o)
{
    int32_t changed = 0;

    if (o->status != OSDTEX_OK)
        fail_msg("%s", test_last_message(e->run));
    edits_check(e, &o->mapping);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
    {
        const bool same = edits_same(e, &e->mapping, &o->mapping, f);

        if (!o->area[f])
            assert_true(same);
        changed += !same;
    }
    return changed;
}

static void
each_kind_of_edit_stays_in_its_area(void **state)
{
    static const otx_constraint kinds[] = {
        {.face = 5, .redo = 1},
        {.face = 5, .has_direction = true, .direction = {1, 0.3, 0}},
        {.face = 5, .scale = 1.6},
    };

    (void)state;
    for (size_t k = 0; k < COUNT(kinds); ++k)
    {
        edits *e = edits_open();
        const outcome o = apply(e, kinds[k]);

        assert_true(check_outside(e, &o) > 8);
        test_run_destroy(e->run);
    }
}

static void
another_try_is_another_texture_and_one_try_the_same(void **state)
{
    edits *e = edits_open();
    const outcome a = apply(e, (otx_constraint){.face = 5, .redo = 1});
    const outcome b = apply(e, (otx_constraint){.face = 5, .redo = 2});
    const outcome c = apply(e, (otx_constraint){.face = 5, .redo = 1});
    int32_t other = 0;

    (void)state;
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
    {
        assert_true(edits_same(e, &a.mapping, &c.mapping, f));
        other += !edits_same(e, &a.mapping, &b.mapping, f);
    }
    assert_true(other > 8);
    test_run_destroy(e->run);
}

static void
what_cannot_be_edited_is_said(void **state)
{
    edits *e = edits_open();
    otx_lookups lookups = {.layering = OTX_LAYERING_OVER};
    outcome o;

    (void)state;
    assert_int_equal(
        apply(e, (otx_constraint){.face = 1 << 20, .redo = 1}).status,
        OSDTEX_ERROR_ARGUMENT);
    e->mapping.lookups = &lookups;
    o = apply(e, (otx_constraint){.face = 5, .redo = 1});
    assert_int_equal(o.status, OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(e->run), "map anew"));
    e->mapping.lookups = NULL;
    e->mapping.guide = NULL;
    o = apply(
        e, (otx_constraint){
               .face = 5, .has_direction = true, .direction = {1, 0, 0}});
    assert_int_equal(check_outside(e, &o), 0);
    assert_non_null(strstr(test_last_message(e->run), "asks for a direction"));
    test_run_destroy(e->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_of_edit_stays_in_its_area),
        cmocka_unit_test(another_try_is_another_texture_and_one_try_the_same),
        cmocka_unit_test(what_cannot_be_edited_is_said),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
