/* saved_decals.c -- what is placed over a mapping, as arrays of a saved one. */
#include "api/saved_decals.h"

#include <math.h>

static const char STAGE[] = "mapping";

static int64_t
item_count(const otx_mapping *m)
{
    return m->decals->lookups.first[otx_surface_leaf(m->surface)->face_count];
}

void
otx_saved_decals_add_offsets(const otx_mapping *m, otx_tensors *out)
{
    if (m->decals)
        otx_tensors_add(
            out, "decal_first", OTX_TENSOR_I64,
            (int64_t)otx_surface_leaf(m->surface)->face_count + 1, 0,
            m->decals->lookups.first);
}

otx_status
otx_saved_decals_add_reals(otx_run *run, const otx_mapping *m, otx_tensors *out)
{
    const int64_t count = m->decals ? item_count(m) : 0;
    float *values;

    if (!m->decals)
        return OSDTEX_OK;
    values = OTX_NEW(run->scratch, float, 3 * count);
    if (!values)
        return otx_fail_memory(run, STAGE);
    for (int64_t i = 0; i < count; ++i)
    {
        const otx_lookup *item = &m->decals->lookups.items[i];

        values[3 * i] = item->uv[0];
        values[3 * i + 1] = item->uv[1];
        values[3 * i + 2] = item->weight;
    }
    otx_tensors_add(out, "decals", OTX_TENSOR_F32, count, 3, values);
    return OSDTEX_OK;
}

otx_status
otx_saved_decals_add_numbers(
    otx_run *run, const otx_mapping *m, otx_tensors *out)
{
    const otx_lookups *l = m->decals ? &m->decals->lookups : NULL;
    const int64_t count = l ? item_count(m) : 0;
    int32_t *numbers, *pictures;

    if (!l)
        return OSDTEX_OK;
    numbers = OTX_NEW(run->scratch, int32_t, count);
    pictures = OTX_NEW(run->scratch, int32_t, l->fragment_count);
    OTX_TRY(otx_run_ok(run));
    for (int64_t i = 0; i < count; ++i)
        numbers[i] = l->items[i].fragment;
    for (int32_t i = 0; i < l->fragment_count; ++i)
        pictures[i] = l->fragments[i].exemplar;
    otx_tensors_add(out, "decal_number", OTX_TENSOR_I32, count, 0, numbers);
    otx_tensors_add(
        out, "decal_picture", OTX_TENSOR_I32, l->fragment_count, 0, pictures);
    return OSDTEX_OK;
}

/* ---- reading ---- */

/* The arrays of a file; NULL where they are not there, or of another shape. */
typedef struct arrays
{
    const int64_t *first;
    const float *values;
    const int32_t *numbers, *pictures;
    int64_t count, decals;
} arrays;

static const void *
find(
    const otx_tensors *from, const char *name, otx_tensor_type type,
    int64_t rows, int64_t columns)
{
    const otx_tensor *t = otx_tensors_find(from, name, type, rows, columns);

    return t ? t->data : NULL;
}

static arrays
find_all(const otx_tensors *from, const otx_level *leaf)
{
    const otx_tensor *pictures =
        otx_tensors_find(from, "decal_picture", OTX_TENSOR_I32, -1, 0);
    arrays a = {
        .first = find(
            from, "decal_first", OTX_TENSOR_I64, (int64_t)leaf->face_count + 1,
            0),
        .pictures = pictures ? pictures->data : NULL,
        .decals = pictures ? pictures->rows : 0};

    a.count = a.first ? a.first[leaf->face_count] : 0;
    a.values = find(from, "decals", OTX_TENSOR_F32, a.count, 3);
    a.numbers = find(from, "decal_number", OTX_TENSOR_I32, a.count, 0);
    return a;
}

/* What does not hold of them; NULL. */
static const char *
what_is_wrong(const arrays *a, const otx_level *leaf, int32_t picture_count)
{
    if (a->count < 0 || !a->values || !a->numbers || !a->pictures ||
        a->decals > INT32_MAX || a->first[0] != 0)
        return "its decals do not fit together";
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (a->first[f + 1] < a->first[f] || a->first[f + 1] > a->count ||
            (a->first[f + 1] - a->first[f]) % otx_level_face_size(leaf, f) != 0)
            return "its decals do not fit the faces";
    for (int64_t i = 0; i < a->count; ++i)
        if (a->numbers[i] < 0 || a->numbers[i] >= a->decals)
            return "a face has a decal that is not there";
    for (int64_t i = 0; i < 3 * a->count; ++i)
        if (!isfinite(a->values[i]))
            return "a place in a decal is not finite";
    for (int64_t i = 0; i < a->decals; ++i)
        if (a->pictures[i] < 0 || a->pictures[i] >= picture_count)
            return "a decal has no picture";
    return NULL;
}

otx_status
otx_saved_decals_join(
    otx_run *run, const otx_tensors *from, const otx_level *leaf,
    int32_t picture_count, otx_decals **out, const char **damaged)
{
    const arrays a = find_all(from, leaf);
    otx_decals *decals;
    otx_fragment *fragments;
    otx_lookup *items;

    *damaged = NULL;
    *out = NULL;
    if (!a.first)
        return OSDTEX_OK;
    *damaged = what_is_wrong(&a, leaf, picture_count);
    if (*damaged)
        return OSDTEX_OK;
    decals = OTX_ZNEW(run->arena, otx_decals, 1);
    items = OTX_NEW(run->arena, otx_lookup, a.count);
    fragments = OTX_ZNEW(run->arena, otx_fragment, a.decals);
    OTX_TRY(otx_run_ok(run));
    for (int64_t i = 0; i < a.count; ++i)
        items[i] = (otx_lookup){
            {a.values[3 * i], a.values[3 * i + 1]},
            a.values[3 * i + 2],
            a.numbers[i]};
    for (int64_t i = 0; i < a.decals; ++i)
        fragments[i] =
            (otx_fragment){.exemplar = a.pictures[i], .patch = (int32_t)i};
    decals->lookups = (otx_lookups){
        a.first, items, OTX_LAYERING_OVER, (int32_t)a.decals, fragments};
    *out = decals;
    return OSDTEX_OK;
}
