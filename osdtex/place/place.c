/* place.c -- pictures put where they were asked for, over any mapping. */
#include "place/laying.h"

#include <string.h>

static const char STAGE[] = "place";

static otx_status
find_spot(const otx_laying *p, const otx_place_item *item, otx_spot *out)
{
    const otx_cage *cage = p->surface->cage;
    otx_where at = otx_laying_where(p, item->face);

    if (item->face >= cage->face_count)
    {
        at.face = -1;
        return otx_fail(
            p->run, OSDTEX_ERROR_ARGUMENT, STAGE, at,
            "placed %d, '%.80s': there is no face %d; the cage has %d, from 0",
            (int)item->number, otx_laying_name(p, item), (int)item->face,
            (int)cage->face_count);
    }
    *out = item->face >= 0 ? otx_spot_of_face(p->surface, item->face)
                           : otx_spot_nearest(p->surface, item->point);
    if (out->face < 0)
        return otx_fail(
            p->run, OSDTEX_ERROR_ARGUMENT, STAGE, at, "placed %d, '%.80s': %s",
            (int)item->number, otx_laying_name(p, item),
            item->face >= 0 ? "the face is a hole"
                            : "the point is too far from any face to tell "
                              "which is the nearest");
    if (out->distance > item->width)
        otx_note(
            p->run, OSDTEX_SEVERITY_WARNING, STAGE,
            otx_laying_where(
                p, otx_surface_leaf(p->surface)->face_cage[out->face]),
            "placed %d, '%.80s': the point is %.4g units away from the "
            "surface, further than the picture is wide; it lies at the nearest "
            "place",
            (int)item->number, otx_laying_name(p, item), out->distance);
    return OSDTEX_OK;
}

static otx_status
lay_item(otx_laying *p, int32_t index)
{
    const otx_place_item *item = &p->list->items[index];
    otx_spot spot;
    bool kept;

    if (item->scatter > 0)
        return otx_laying_scatter(p, index);
    OTX_TRY(find_spot(p, item, &spot));
    return otx_laying_lay_down(p, index, &spot, item->turn, false, &kept);
}

/* ---- the decals ---- */

static void
count_items(const otx_laying *p, int64_t *first)
{
    for (int32_t i = 0; i < p->laid_count; ++i)
        for (int32_t k = 0; k < p->laid[i].face_count; ++k)
            first[p->laid[i].faces[k] + 1] +=
                p->laid[i].first[k + 1] - p->laid[i].first[k];
}

/* Of one decal, behind those that are there. */
static void
put_items(const otx_laying *p, int32_t index, int64_t *at, otx_lookup *items)
{
    const otx_laid *l = &p->laid[index];
    const float opacity = (float)p->list->items[l->item].opacity;

    for (int32_t k = 0; k < l->face_count; ++k)
        for (int32_t c = l->first[k]; c < l->first[k + 1]; ++c)
            items[at[l->faces[k]]++] = (otx_lookup){
                {l->uvs[2 * (size_t)c], l->uvs[2 * (size_t)c + 1]},
                opacity,
                index};
}

static otx_status
join(const otx_laying *p, otx_lookups *out)
{
    otx_run *run = p->run;
    const int32_t n = otx_surface_leaf(p->surface)->face_count;
    int64_t *first = OTX_ZNEW(run->arena, int64_t, (int64_t)n + 1);
    int64_t *at = OTX_NEW(run->scratch, int64_t, (int64_t)n + 1);
    otx_fragment *fragments = OTX_ZNEW(run->arena, otx_fragment, p->laid_count);
    otx_lookup *items;

    OTX_TRY(otx_run_ok(run));
    count_items(p, first);
    for (int32_t f = 0; f < n; ++f)
        first[f + 1] += first[f];
    memcpy(at, first, ((size_t)n + 1) * sizeof *at);
    items = OTX_NEW(run->arena, otx_lookup, first[n]);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < p->laid_count; ++i)
    {
        put_items(p, i, at, items);
        fragments[i] = (otx_fragment){
            .exemplar = p->list->items[p->laid[i].item].picture, .patch = i};
    }
    *out = (otx_lookups){
        first, items, OTX_LAYERING_OVER, p->laid_count, fragments};
    return OSDTEX_OK;
}

static otx_status
prepare(otx_laying *p)
{
    const otx_level *leaf = otx_surface_leaf(p->surface);
    otx_arena *scratch = p->run->scratch;
    int64_t most = 0;

    for (int32_t i = 0; i < p->list->count; ++i)
        most += p->list->items[i].scatter > 0 ? p->list->items[i].scatter : 1;
    p->laid = OTX_ZNEW(scratch, otx_laid, most);
    p->space.face_slot = OTX_NEW(scratch, int32_t, leaf->face_count);
    p->space.vert_slot = OTX_NEW(scratch, int32_t, leaf->vert_count);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        p->space.face_slot[f] = -1;
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        p->space.vert_slot[v] = -1;
    return OSDTEX_OK;
}

otx_status
otx_place_all(
    otx_run *run, const otx_surface *surface, const otx_place_list *list,
    otx_lookups *out, otx_place_figures *figures)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_laying p = {.run = run, .surface = surface, .list = list};
    otx_status status = prepare(&p);

    *out = (otx_lookups){0};
    for (int32_t i = 0; i < list->count && status == OSDTEX_OK; ++i)
    {
        status = lay_item(&p, i);
        if (status == OSDTEX_OK)
            status = otx_progress(run, STAGE, (i + 1.0) / list->count);
    }
    if (status == OSDTEX_OK)
        status = join(&p, out);
    *figures = p.figures;
    otx_arena_release(run->scratch, mark);
    return status;
}
