/* saved_decals.c -- what is placed over a mapping, as arrays of a saved one. */
#include "api/saved_decals.h"

#include "api/saved_items.h"

static const char STAGE[] = "mapping";

static const otx_saved_names NAMES = {"decal_first", "decals", "decal_number"};

/* ---- saving ---- */

static const otx_lookups *
lookups_of(const otx_mapping *m)
{
    return m->decals ? &m->decals->lookups : NULL;
}

void
otx_saved_decals_add_offsets(const otx_mapping *m, otx_tensors *out)
{
    otx_saved_items_add_first(
        lookups_of(m), otx_surface_leaf(m->surface), &NAMES, out);
}

otx_status
otx_saved_decals_add_reals(otx_run *run, const otx_mapping *m, otx_tensors *out)
{
    return otx_saved_items_add_values(
        run, lookups_of(m), otx_surface_leaf(m->surface), &NAMES, out);
}

otx_status
otx_saved_decals_add_numbers(
    otx_run *run, const otx_mapping *m, otx_tensors *out)
{
    const otx_lookups *l = lookups_of(m);
    int32_t *pictures;

    if (!l)
        return OSDTEX_OK;
    OTX_TRY(otx_saved_items_add_fragments(
        run, l, otx_surface_leaf(m->surface), &NAMES, out));
    pictures = OTX_NEW(run->scratch, int32_t, l->fragment_count);
    if (!pictures)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < l->fragment_count; ++i)
        pictures[i] = l->fragments[i].exemplar;
    otx_tensors_add(
        out, "decal_picture", OTX_TENSOR_I32, l->fragment_count, 0, pictures);
    return OSDTEX_OK;
}

/* ---- reading ---- */

/* What does not hold; NULL. */
static const char *
what_is_wrong(
    const otx_saved_items *items, const otx_tensor *pictures,
    const otx_level *leaf, int32_t picture_count)
{
    const int64_t count = pictures ? pictures->rows : 0;
    const int32_t *picture = pictures ? pictures->data : NULL;
    const char *wrong = otx_saved_items_wrong(items, leaf, 0, count);

    if (wrong)
        return wrong;
    for (int64_t i = 0; i < count; ++i)
        if (picture[i] < 0 || picture[i] >= picture_count)
            return "a decal has no picture";
    return NULL;
}

otx_status
otx_saved_decals_join(
    otx_run *run, const otx_tensors *from, const otx_level *leaf,
    int32_t picture_count, otx_decals **out, const char **damaged)
{
    const otx_saved_items items = otx_saved_items_find(from, leaf, &NAMES);
    const otx_tensor *pictures =
        otx_tensors_find(from, "decal_picture", OTX_TENSOR_I32, -1, 0);
    const int32_t count = pictures ? (int32_t)pictures->rows : 0;
    const otx_lookup *list;
    otx_decals *decals;
    otx_fragment *fragments;

    *damaged = NULL;
    *out = NULL;
    if (!items.first)
        return OSDTEX_OK;
    *damaged = what_is_wrong(&items, pictures, leaf, picture_count);
    if (*damaged)
        return OSDTEX_OK;
    decals = OTX_ZNEW(run->arena, otx_decals, 1);
    fragments = OTX_ZNEW(run->arena, otx_fragment, count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_saved_items_join(run, &items, &list));
    for (int32_t i = 0; i < count; ++i)
        fragments[i] = (otx_fragment){
            .exemplar = ((const int32_t *)pictures->data)[i], .patch = i};
    decals->lookups =
        (otx_lookups){items.first, list, OTX_LAYERING_OVER, count, fragments};
    *out = decals;
    return OSDTEX_OK;
}
