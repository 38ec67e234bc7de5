/* saved_lookups.c -- faces that show several places at once, as arrays of a
 * saved mapping. */
#include "api/saved_lookups.h"

#include "api/saved_items.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "mapping";

enum
{
    /* Of a fragment's outline: frame, feather, radii; all 0: opaque. */
    OUTLINE_FLOATS = 5 + OTX_RADIAL_ANGLES
};

static const otx_saved_names NAMES = {
    "lookup_first", "lookups", "lookup_fragment"};

/* ---- saving ---- */

void
otx_saved_lookups_add_offsets(const otx_mapping *m, otx_tensors *out)
{
    otx_saved_items_add_first(
        m->lookups, otx_surface_leaf(m->surface), &NAMES, out);
}

otx_status
otx_saved_lookups_add_reals(
    otx_run *run, const otx_mapping *m, otx_tensors *out)
{
    return otx_saved_items_add_values(
        run, m->lookups, otx_surface_leaf(m->surface), &NAMES, out);
}

/* Outlines that cut fragments out, where there are any. */
static otx_status
add_outlines(otx_run *run, const otx_lookups *l, otx_tensors *out)
{
    float *list = OTX_ZNEW(
        run->scratch, float, (int64_t)OUTLINE_FLOATS * l->fragment_count);
    bool any = false;

    if (!list)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < l->fragment_count; ++i)
    {
        const otx_fragment *f = &l->fragments[i];
        float *row = list + (size_t)OUTLINE_FLOATS * (size_t)i;

        if (!f->outline)
            continue;
        any = true;
        memcpy(row, f->frame, sizeof f->frame);
        row[4] = f->outline->feather;
        memcpy(row + 5, f->outline->radius, sizeof f->outline->radius);
    }
    if (any)
        otx_tensors_add(
            out, "fragment_outlines", OTX_TENSOR_F32, l->fragment_count,
            OUTLINE_FLOATS, list);
    return OSDTEX_OK;
}

/* Exemplar and patch of each. */
static otx_status
add_fragments(otx_run *run, const otx_lookups *l, otx_tensors *out)
{
    int32_t *list = OTX_NEW(run->scratch, int32_t, 2 * l->fragment_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < l->fragment_count; ++i)
    {
        if (l->fragments[i].mask)
            return otx_fail(
                run, OSDTEX_ERROR_SUPPORT, STAGE, OTX_NOWHERE,
                "a mapping whose fragments have masks cannot be saved");
        list[2 * i] = l->fragments[i].exemplar;
        list[2 * i + 1] = l->fragments[i].patch;
    }
    otx_tensors_add(
        out, "fragments", OTX_TENSOR_I32, l->fragment_count, 2, list);
    return OSDTEX_OK;
}

otx_status
otx_saved_lookups_add_numbers(
    otx_run *run, const otx_mapping *m, otx_tensors *out)
{
    const otx_lookups *l = m->lookups;

    if (!l)
        return OSDTEX_OK;
    OTX_TRY(otx_saved_items_add_fragments(
        run, l, otx_surface_leaf(m->surface), &NAMES, out));
    OTX_TRY(add_fragments(run, l, out));
    return add_outlines(run, l, out);
}

/* ---- reading ---- */

/* The arrays of a file; NULL where they are not there, or of another shape. */
typedef struct arrays
{
    otx_saved_items items;
    const otx_tensor *fragments, *outlines;
} arrays;

static arrays
find_all(const otx_tensors *from, const otx_level *leaf)
{
    arrays a = {
        .items = otx_saved_items_find(from, leaf, &NAMES),
        .fragments =
            otx_tensors_find(from, "fragments", OTX_TENSOR_I32, -1, 2)};

    if (a.fragments)
        a.outlines = otx_tensors_find(
            from, "fragment_outlines", OTX_TENSOR_F32, a.fragments->rows,
            OUTLINE_FLOATS);
    return a;
}

/* What does not hold of them; NULL. */
static const char *
what_is_wrong(const arrays *a, const otx_level *leaf, int32_t exemplar_count)
{
    const int32_t *row = a->fragments ? a->fragments->data : NULL;
    const int64_t rows = a->fragments ? a->fragments->rows : 0;
    const char *wrong = otx_saved_items_wrong(&a->items, leaf, -1, rows);

    if (wrong)
        return wrong;
    if (!row)
        return "its lookups have no fragments";
    for (int64_t i = 0; i < rows; ++i)
        if (row[2 * i] < 0 || row[2 * i] >= exemplar_count)
            return "a fragment has no exemplar";
    for (int64_t i = 0; a->outlines && i < OUTLINE_FLOATS * rows; ++i)
        if (!isfinite(((const float *)a->outlines->data)[i]))
            return "an outline is not finite";
    return NULL;
}

static otx_status
join_outlines(otx_run *run, const arrays *a, otx_fragment *fragments)
{
    const int64_t count = a->fragments->rows;
    const float *row = a->outlines ? a->outlines->data : NULL;
    otx_radial *outlines;

    if (!row)
        return OSDTEX_OK;
    outlines = OTX_NEW(run->arena, otx_radial, count);
    if (!outlines)
        return otx_fail_memory(run, STAGE);
    for (int64_t i = 0; i < count; ++i, row += OUTLINE_FLOATS)
    {
        if (!(row[2] > 0.0f && row[3] > 0.0f))
            continue;
        outlines[i].feather = row[4];
        memcpy(outlines[i].radius, row + 5, sizeof outlines[i].radius);
        otx_radial_bound(&outlines[i]);
        memcpy(fragments[i].frame, row, sizeof fragments[i].frame);
        fragments[i].outline = &outlines[i];
    }
    return OSDTEX_OK;
}

otx_status
otx_saved_lookups_join(
    otx_run *run, const otx_tensors *from, otx_layering layering,
    int32_t exemplar_count, otx_mapping *mapping, const char **damaged)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const arrays a = find_all(from, leaf);
    const otx_lookup *items;
    otx_lookups *lookups;
    otx_fragment *fragments;

    *damaged = NULL;
    mapping->lookups = NULL;
    if (!a.items.first)
        return OSDTEX_OK;
    *damaged = what_is_wrong(&a, leaf, exemplar_count);
    if (*damaged)
        return OSDTEX_OK;
    lookups = OTX_ZNEW(run->arena, otx_lookups, 1);
    fragments = OTX_ZNEW(run->arena, otx_fragment, a.fragments->rows);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_saved_items_join(run, &a.items, &items));
    for (int64_t i = 0; i < a.fragments->rows; ++i)
    {
        const int32_t *row = (const int32_t *)a.fragments->data + 2 * i;

        fragments[i] = (otx_fragment){.exemplar = row[0], .patch = row[1]};
    }
    OTX_TRY(join_outlines(run, &a, fragments));
    *lookups = (otx_lookups){
        a.items.first, items, layering, (int32_t)a.fragments->rows, fragments};
    mapping->lookups = lookups;
    return OSDTEX_OK;
}
