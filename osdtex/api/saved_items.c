/* saved_items.c -- what several places of a picture show on a face, as arrays
 * of a saved mapping. */
#include "api/saved_items.h"

#include <math.h>

static const char STAGE[] = "mapping";

static int64_t
count_of(const otx_lookups *l, const otx_level *leaf)
{
    return l->first[leaf->face_count];
}

/* ---- saving ---- */

void
otx_saved_items_add_first(
    const otx_lookups *l, const otx_level *leaf, const otx_saved_names *names,
    otx_tensors *out)
{
    if (l)
        otx_tensors_add(
            out, names->first, OTX_TENSOR_I64, (int64_t)leaf->face_count + 1, 0,
            l->first);
}

otx_status
otx_saved_items_add_values(
    otx_run *run, const otx_lookups *l, const otx_level *leaf,
    const otx_saved_names *names, otx_tensors *out)
{
    const int64_t count = l ? count_of(l, leaf) : 0;
    float *values;

    if (!l)
        return OSDTEX_OK;
    values = OTX_NEW(run->scratch, float, 3 * count);
    if (!values)
        return otx_fail_memory(run, STAGE);
    for (int64_t i = 0; i < count; ++i)
    {
        values[3 * i] = l->items[i].uv[0];
        values[3 * i + 1] = l->items[i].uv[1];
        values[3 * i + 2] = l->items[i].weight;
    }
    otx_tensors_add(out, names->values, OTX_TENSOR_F32, count, 3, values);
    return OSDTEX_OK;
}

otx_status
otx_saved_items_add_fragments(
    otx_run *run, const otx_lookups *l, const otx_level *leaf,
    const otx_saved_names *names, otx_tensors *out)
{
    const int64_t count = l ? count_of(l, leaf) : 0;
    int32_t *fragments;

    if (!l)
        return OSDTEX_OK;
    fragments = OTX_NEW(run->scratch, int32_t, count);
    if (!fragments)
        return otx_fail_memory(run, STAGE);
    for (int64_t i = 0; i < count; ++i)
        fragments[i] = l->items[i].fragment;
    otx_tensors_add(out, names->fragment, OTX_TENSOR_I32, count, 0, fragments);
    return OSDTEX_OK;
}

/* ---- reading ---- */

static const void *
find(
    const otx_tensors *from, const char *name, otx_tensor_type type,
    int64_t rows, int64_t columns)
{
    const otx_tensor *t = otx_tensors_find(from, name, type, rows, columns);

    return t ? t->data : NULL;
}

otx_saved_items
otx_saved_items_find(
    const otx_tensors *from, const otx_level *leaf,
    const otx_saved_names *names)
{
    otx_saved_items items = {
        .first = find(
            from, names->first, OTX_TENSOR_I64, (int64_t)leaf->face_count + 1,
            0)};

    items.count = items.first ? items.first[leaf->face_count] : 0;
    items.values = find(from, names->values, OTX_TENSOR_F32, items.count, 3);
    items.fragment =
        find(from, names->fragment, OTX_TENSOR_I32, items.count, 0);
    return items;
}

const char *
otx_saved_items_wrong(
    const otx_saved_items *items, const otx_level *leaf, int32_t least,
    int64_t fragments)
{
    const int64_t *first = items->first;

    if (items->count < 0 || !items->values || !items->fragment ||
        fragments > INT32_MAX || first[0] != 0)
        return "its lookups do not fit together";
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (first[f + 1] < first[f] || first[f + 1] > items->count ||
            (first[f + 1] - first[f]) % otx_level_face_size(leaf, f) != 0)
            return "its lookups do not fit the faces";
    for (int64_t i = 0; i < items->count; ++i)
        if (items->fragment[i] < least || items->fragment[i] >= fragments)
            return "a lookup has no fragment";
    for (int64_t i = 0; i < 3 * items->count; ++i)
        if (!isfinite(items->values[i]))
            return "a lookup is not finite";
    return NULL;
}

otx_status
otx_saved_items_join(
    otx_run *run, const otx_saved_items *items, const otx_lookup **out)
{
    otx_lookup *list = OTX_NEW(run->arena, otx_lookup, items->count);

    *out = list;
    if (!list)
        return otx_fail_memory(run, STAGE);
    for (int64_t i = 0; i < items->count; ++i)
        list[i] = (otx_lookup){
            {items->values[3 * i], items->values[3 * i + 1]},
            items->values[3 * i + 2],
            items->fragment[i]};
    return OSDTEX_OK;
}
