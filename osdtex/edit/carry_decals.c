/* carry_decals.c -- pictures that lie over a mapping, on a surface of other
 * faces. */
#include "edit/carry_decals.h"

/* A decal that a face of the new surface shows, and where on the old one. */
typedef struct shown
{
    const otx_closest_place *anchor; /* on a face that has the decal */
    int32_t decal;
} shown;

typedef struct decals
{
    const otx_project *ask;
    const otx_projected *projected;
    const otx_lookups *lookups;
    const otx_level *old, *leaf; /* leaf levels */
    shown *list;                 /* what one face shows, in their order */
} decals;

/* The lookups of a decal at the corners of an old face; NULL: it is not there.
 */
static const otx_lookup *
find(const decals *d, int32_t face, int32_t decal)
{
    const int32_t size = otx_level_face_size(d->old, face);

    for (int64_t i = d->lookups->first[face]; i < d->lookups->first[face + 1];
         i += size)
        if (d->lookups->items[i].fragment == decal)
            return &d->lookups->items[i];
    return NULL;
}

/* Adds a decal in its order, once. */
static void
add(decals *d, const otx_closest_place *anchor, int32_t decal, int32_t *count)
{
    int32_t at = *count;

    while (at > 0 && d->list[at - 1].decal >= decal)
        --at;
    if (at < *count && d->list[at].decal == decal)
        return;
    for (int32_t i = *count; i > at; --i)
        d->list[i] = d->list[i - 1];
    d->list[at] = (shown){anchor, decal};
    ++*count;
}

/* What lies below the middle of a face and its corners. */
static int32_t
list_face(decals *d, int32_t face)
{
    const int32_t first = d->leaf->face_first[face];
    int32_t count = 0;

    for (int32_t c = first - 1; c < d->leaf->face_first[face + 1]; ++c)
    {
        const otx_closest_place *p =
            c < first ? &d->projected->faces[face]
                      : &d->projected->verts[d->leaf->face_verts[c]];

        if (p->face < 0)
            continue;
        for (int64_t i = d->lookups->first[p->face];
             i < d->lookups->first[p->face + 1];
             i += otx_level_face_size(d->old, p->face))
            add(d, p, d->lookups->items[i].fragment, &count);
    }
    return count;
}

static otx_lookup
mix(const decals *d, const otx_closest_place *p, const otx_lookup *at)
{
    const int32_t first = d->old->face_first[p->face];
    double sum[3] = {0.0, 0.0, 0.0};

    for (int k = 0; k < 3; ++k)
    {
        const otx_lookup *l = &at[p->corners[k] - first];

        sum[0] += p->at[k] * (double)l->uv[0];
        sum[1] += p->at[k] * (double)l->uv[1];
        sum[2] += p->at[k] * (double)l->weight;
    }
    return (otx_lookup){
        {(float)sum[0], (float)sum[1]},
        (float)fmin(fmax(sum[2], 0.0), 1.0),
        at->fragment};
}

/* What a decal shows at a vertex: where that lies, or else as it goes on from
 * the anchor. */
static otx_lookup
show(const decals *d, const shown *s, int32_t vert)
{
    const otx_closest_place *there = &d->projected->verts[vert];
    const otx_lookup *at =
        there->face >= 0 ? find(d, there->face, s->decal) : NULL;
    otx_closest_place place = *s->anchor;
    otx_vec3 triangle[3];

    if (at)
        return mix(d, there, at);
    otx_closest_corners(d->ask->made_for, place.corners, triangle);
    otx_closest_below(
        otx_vec3_load(d->ask->to->points, vert), triangle, place.at);
    return mix(d, &place, find(d, place.face, s->decal));
}

static void
fill_face(decals *d, int32_t face, otx_lookup *items)
{
    const int32_t count = list_face(d, face);

    for (int32_t i = 0; i < count; ++i)
        for (int32_t c = d->leaf->face_first[face];
             c < d->leaf->face_first[face + 1]; ++c)
            *items++ = show(d, &d->list[i], d->leaf->face_verts[c]);
}

/* Room for all that can lie below one face. */
static otx_status
make_list(otx_run *run, decals *d)
{
    int64_t most = 0;
    int32_t corners = 0;

    for (int32_t f = 0; f < d->old->face_count; ++f)
    {
        const int64_t count = d->lookups->first[f + 1] - d->lookups->first[f];

        most = count > most ? count : most;
    }
    for (int32_t f = 0; f < d->leaf->face_count; ++f)
        if (otx_level_face_size(d->leaf, f) > corners)
            corners = otx_level_face_size(d->leaf, f);
    most =
        most < d->lookups->fragment_count ? most : d->lookups->fragment_count;
    d->list = OTX_NEW(run->scratch, shown, (size_t)most * (corners + 1) + 1);
    return otx_run_ok(run);
}

static otx_status
carry(otx_run *run, decals *d, otx_lookups *out)
{
    int64_t *first = OTX_NEW(run->arena, int64_t, d->leaf->face_count + 1);
    otx_lookup *items;

    OTX_TRY(make_list(run, d));
    first[0] = 0;
    for (int32_t f = 0; f < d->leaf->face_count; ++f)
        first[f + 1] = first[f] + (int64_t)list_face(d, f) *
                                      otx_level_face_size(d->leaf, f);
    items = OTX_NEW(run->arena, otx_lookup, first[d->leaf->face_count] + 1);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < d->leaf->face_count; ++f)
        fill_face(d, f, items + first[f]);
    *out = *d->lookups;
    out->first = first;
    out->items = items;
    return OSDTEX_OK;
}

otx_status
otx_carry_decals(
    otx_run *run, const otx_project *project, const otx_projected *projected,
    const otx_decals **out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_decals *from = project->from->decals;
    otx_decals *made;
    decals d;

    *out = NULL;
    if (!from)
        return OSDTEX_OK;
    d = (decals){
        .ask = project,
        .projected = projected,
        .lookups = &from->lookups,
        .old = otx_surface_leaf(project->made_for),
        .leaf = otx_surface_leaf(project->to)};
    made = OTX_NEW(run->arena, otx_decals, 1);
    OTX_TRY(otx_run_ok(run));
    *made = *from;
    OTX_TRY(carry(run, &d, &made->lookups));
    otx_arena_release(run->scratch, mark);
    *out = made;
    return OSDTEX_OK;
}
