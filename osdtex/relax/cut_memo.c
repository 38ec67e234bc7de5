/* cut_memo.c -- one entry for each corner of each face that is offered. */
#include "relax/cut_memo.h"

enum
{
    COST_BITS = 40 /* costs of edges stay below; above them, the other patch */
};

/* Patches of higher numbers are not remembered. */
static const int32_t PATCH_MOST = (1 << (64 - COST_BITS)) - 2;

otx_status
otx_cut_memo_create(
    otx_arena *arena, const otx_cut_cost *cost, int32_t offer_count,
    otx_cut_memo *out)
{
    int64_t total = 0;

    *out = (otx_cut_memo){cost, OTX_NEW(arena, int64_t, offer_count), NULL};
    if (!out->first)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t p = 0; p < offer_count; ++p)
    {
        out->first[p] = total;
        total += cost->offers[p].first[cost->offers[p].face_count];
    }
    out->entries = OTX_ZNEW(arena, uint64_t, total);
    return out->entries ? OSDTEX_OK : OSDTEX_ERROR_MEMORY;
}

static uint64_t *
entry_of(
    const otx_cut_memo *memo, int32_t edge, int32_t face, otx_cut_view view)
{
    const otx_level *leaf = memo->cost->leaf;
    int32_t k = leaf->face_first[face];

    while (leaf->face_edges[k] != edge)
        ++k;
    return &memo->entries
                [memo->first[view.label] +
                 memo->cost->offers[view.label].first[view.slot] + k -
                 leaf->face_first[face]];
}

int64_t
otx_cut_memo_edge(
    const otx_cut_memo *memo, int32_t edge, const otx_cut_view views[2],
    int side)
{
    const otx_cut_view mine = views[side], other = views[1 - side];
    uint64_t *entry, tag;

    if (mine.label < 0 || other.label < 0 || mine.label == other.label)
        return 0;
    if (other.label > PATCH_MOST)
        return otx_cut_cost_edge(memo->cost, edge, views[0], views[1]);
    entry = entry_of(
        memo, edge, memo->cost->leaf->edge_faces[2 * (size_t)edge + side],
        mine);
    tag = (uint64_t)other.label + 1;
    if (*entry >> COST_BITS != tag)
        *entry = tag << COST_BITS | (uint64_t)otx_cut_cost_edge(
                                        memo->cost, edge, views[0], views[1]);
    return (int64_t)(*entry & (((uint64_t)1 << COST_BITS) - 1));
}
