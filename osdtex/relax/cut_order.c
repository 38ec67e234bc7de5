/* cut_order.c -- patches that touch, and how deep each stands in a sweep. */
#include "relax/cut_order.h"

#include "base/csr.h"

enum
{
    NONE = -1
};

typedef struct builder
{
    const otx_level *leaf;
    const otx_offer *offers;
    int32_t offer_count;
    int64_t *cover_first; /* [face_count + 1] */
    int32_t *covers;      /* patches that offer each face, ascending */
    int32_t *face_seen;   /* [face_count] last patch that offered it */
    int32_t *seen;        /* [offer_count] last patch that was beside it */
    int64_t *first;       /* [offer_count + 1] */
    int32_t *before;      /* by patch; NULL while they are counted */
    int32_t *depth;       /* [offer_count] */
} builder;

static bool
list_covers(builder *b, otx_arena *scratch)
{
    const int32_t faces = b->leaf->face_count;
    int64_t *first = b->cover_first;

    for (int32_t p = 0; p < b->offer_count; ++p)
        for (int32_t i = 0; i < b->offers[p].face_count; ++i)
            otx_csr_wide_count(first, b->offers[p].faces[i], 1);
    otx_csr_wide_sum(first, faces);
    b->covers = OTX_NEW(scratch, int32_t, first[faces + 1]);
    if (!b->covers)
        return false;
    for (int32_t p = 0; p < b->offer_count; ++p)
        for (int32_t i = 0; i < b->offers[p].face_count; ++i)
            b->covers[otx_csr_wide_place(first, b->offers[p].faces[i])] = p;
    return true;
}

/* Adds the patches below p that offer a face, each once, from `at` on. */
static int64_t
add_covers(builder *b, int32_t p, int32_t face, int64_t at)
{
    for (int64_t i = b->cover_first[face]; i < b->cover_first[face + 1]; ++i)
    {
        const int32_t other = b->covers[i];

        if (other >= p)
            break;
        if (b->seen[other] == p)
            continue;
        b->seen[other] = p;
        if (b->before)
            b->before[at] = other;
        ++at;
    }
    return at;
}

/* Those that offer a face of p or one beside it, from `at` on; the end. */
static int64_t
add_touching(builder *b, int32_t p, int64_t at)
{
    const otx_offer *offer = &b->offers[p];

    for (int32_t i = 0; i < offer->face_count; ++i)
        b->face_seen[offer->faces[i]] = p;
    for (int32_t i = 0; i < offer->face_count; ++i)
    {
        const int32_t face = offer->faces[i];

        at = add_covers(b, p, face, at);
        for (int32_t k = 0; k < otx_level_face_size(b->leaf, face); ++k)
        {
            const int32_t other = otx_level_neighbour(b->leaf, face, k);

            if (other >= 0 && b->face_seen[other] != p)
                at = add_covers(b, p, other, at);
        }
    }
    return at;
}

static void
list_touching(builder *b)
{
    for (int32_t f = 0; f < b->leaf->face_count; ++f)
        b->face_seen[f] = NONE;
    for (int32_t p = 0; p < b->offer_count; ++p)
        b->seen[p] = NONE;
    for (int32_t p = 0; p < b->offer_count; ++p)
        b->first[p + 1] = add_touching(b, p, b->first[p]);
}

/* One more than the deepest that it waits for; the deepest of all. */
static int32_t
measure_depths(builder *b)
{
    int32_t deepest = 0;

    for (int32_t p = 0; p < b->offer_count; ++p)
    {
        b->depth[p] = 0;
        for (int64_t i = b->first[p]; i < b->first[p + 1]; ++i)
            if (b->depth[b->before[i]] >= b->depth[p])
                b->depth[p] = b->depth[b->before[i]] + 1;
        if (b->depth[p] > deepest)
            deepest = b->depth[p];
    }
    return deepest;
}

/* Patches by depth, those of one depth in their own order.
 *
 *   place  [offer_count] out: of each patch */
static void
sort_by_depth(
    const builder *b, int32_t *depth_first, int32_t deepest, int32_t *place,
    int32_t *offers)
{
    for (int32_t p = 0; p < b->offer_count; ++p)
        otx_csr_count(depth_first, b->depth[p], 1);
    otx_csr_sum(depth_first, deepest + 1);
    for (int32_t p = 0; p < b->offer_count; ++p)
    {
        place[p] = otx_csr_place(depth_first, b->depth[p]);
        offers[place[p]] = p;
    }
}

static otx_status
build(builder *b, otx_arena *arena, otx_arena *scratch, otx_cut_order *out)
{
    const int32_t n = b->offer_count;
    int32_t *place = OTX_NEW(scratch, int32_t, n);
    int32_t *before, *depth_first;
    int32_t deepest;
    int64_t *first;

    if (!place || !list_covers(b, scratch))
        return OSDTEX_ERROR_MEMORY;
    list_touching(b);
    first = OTX_ZNEW(arena, int64_t, (int64_t)n + 1);
    before = OTX_NEW(arena, int32_t, b->first[n]);
    b->before = OTX_NEW(scratch, int32_t, b->first[n]);
    if (!first || !before || !b->before)
        return OSDTEX_ERROR_MEMORY;
    list_touching(b);
    deepest = measure_depths(b);
    depth_first = OTX_ZNEW(scratch, int32_t, (int64_t)deepest + 3);
    if (!depth_first)
        return OSDTEX_ERROR_MEMORY;
    sort_by_depth(b, depth_first, deepest, place, out->offers);
    for (int32_t k = 0; k < n; ++k)
    {
        const int32_t p = out->offers[k];

        first[k + 1] = first[k];
        for (int64_t i = b->first[p]; i < b->first[p + 1]; ++i)
            before[first[k + 1]++] = place[b->before[i]];
    }
    out->places = (otx_pool_order){first, before};
    return OSDTEX_OK;
}

otx_status
otx_cut_order_build(
    otx_run *run, otx_arena *arena, const otx_level *leaf,
    const otx_offer *offers, int32_t offer_count, otx_cut_order *out)
{
    otx_arena *scratch = run->scratch;
    const otx_arena_mark mark = otx_arena_here(scratch);
    builder b = {
        .leaf = leaf,
        .offers = offers,
        .offer_count = offer_count,
        .cover_first =
            OTX_ZNEW(scratch, int64_t, (int64_t)leaf->face_count + 2),
        .face_seen = OTX_NEW(scratch, int32_t, leaf->face_count),
        .seen = OTX_NEW(scratch, int32_t, offer_count),
        .first = OTX_ZNEW(scratch, int64_t, (int64_t)offer_count + 1),
        .depth = OTX_NEW(scratch, int32_t, offer_count)};

    out->offers = OTX_NEW(arena, int32_t, offer_count);
    if (!b.cover_first || !b.face_seen || !b.seen || !b.first || !b.depth ||
        !out->offers || build(&b, arena, scratch, out) != OSDTEX_OK)
        return otx_fail_memory(run, "cut");
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}
