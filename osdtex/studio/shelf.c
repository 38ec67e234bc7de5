/* shelf.c -- mappings that were made a while ago, by their recipes. */
#include "studio/shelf.h"

#include <string.h>

static int64_t
faces_of(const otx_outcome *outcome)
{
    return osdtex_mapping_describe(outcome->mapping)->face_count;
}

static void
drop_last(otx_shelf *shelf)
{
    otx_shelf_row *row = &shelf->rows[--shelf->count];

    json_decref(row->recipe);
    otx_outcome_release(row->outcome);
}

void
otx_shelf_put(otx_shelf *shelf, const json_t *recipe, otx_outcome *outcome)
{
    json_t *copy = json_deep_copy(recipe);
    int64_t faces = faces_of(outcome);

    if (!copy)
        return;
    for (int i = 0; i < shelf->count; ++i)
        faces += faces_of(shelf->rows[i].outcome);
    while (shelf->count > 0 &&
           (shelf->count == OTX_SHELF_MOST || faces > OTX_SHELF_FACES_MOST))
    {
        faces -= faces_of(shelf->rows[shelf->count - 1].outcome);
        drop_last(shelf);
    }
    memmove(
        shelf->rows + 1, shelf->rows,
        (size_t)shelf->count * sizeof *shelf->rows);
    shelf->rows[0] = (otx_shelf_row){copy, otx_outcome_hold(outcome)};
    ++shelf->count;
}

otx_outcome *
otx_shelf_find(const otx_shelf *shelf, const json_t *recipe)
{
    for (int i = 0; i < shelf->count; ++i)
        if (json_equal(shelf->rows[i].recipe, recipe))
            return shelf->rows[i].outcome;
    return NULL;
}

/* -- edits ---------------------------------------------------------------- */

static json_t *
list_of(const json_t *recipe)
{
    return json_object_get(
        json_object_get(recipe, "constraints"), "constraints");
}

/* The number of the edit that a constraint is of; 0: of none. */
static json_int_t
edit_of(const json_t *constraint)
{
    return json_integer_value(json_object_get(constraint, "edit"));
}

/* Whether two recipes are alike but for their lists. */
static bool
differ_in_lists(const json_t *a, const json_t *b)
{
    json_t *x = json_deep_copy(a), *y = json_deep_copy(b);
    json_t *p = json_object_get(x, "constraints");
    json_t *q = json_object_get(y, "constraints");
    bool are_alike;

    json_object_del(p, "constraints");
    json_object_del(q, "constraints");
    are_alike = x && y && json_equal(x, y);
    json_decref(x);
    json_decref(y);
    return are_alike;
}

/* Whether `after` is `before` and the next edit. */
static bool
is_one_edit_later(const json_t *before, const json_t *after)
{
    const size_t old = json_array_size(before), all = json_array_size(after);
    json_int_t most = 0;

    for (size_t i = 0; i < old && i < all; ++i)
    {
        const json_t *item = json_array_get(after, i);

        if (!json_equal(item, json_array_get(before, i)))
            return false;
        most = edit_of(item) > most ? edit_of(item) : most;
    }
    for (size_t i = old; i < all; ++i)
        if (edit_of(json_array_get(after, i)) != most + 1)
            return false;
    return all > old;
}

/* Those from `first` on, for a call that gives them the next number itself. */
static json_t *
rest_of(const json_t *list, size_t first)
{
    json_t *rest = json_array();

    for (size_t k = first; k < json_array_size(list); ++k)
    {
        json_t *item = json_deep_copy(json_array_get(list, k));

        json_object_del(item, "edit");
        json_array_append_new(rest, item);
    }
    return rest;
}

otx_outcome *
otx_shelf_base(const otx_shelf *shelf, const json_t *recipe, json_t **rest)
{
    const json_t *list = list_of(recipe);

    for (int i = 0; i < shelf->count; ++i)
    {
        const json_t *before = list_of(shelf->rows[i].recipe);

        if (!is_one_edit_later(before, list) ||
            !differ_in_lists(shelf->rows[i].recipe, recipe))
            continue;
        *rest = rest_of(list, json_array_size(before));
        return *rest ? shelf->rows[i].outcome : NULL;
    }
    return NULL;
}

void
otx_shelf_free(otx_shelf *shelf)
{
    while (shelf->count > 0)
        drop_last(shelf);
}
