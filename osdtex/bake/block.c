/* block.c -- a block of texels at work: what lies under its samples. */
#include "bake/block.h"

enum
{
    STEPS = 96 /* of a walk */
};

/* Samples to a texel's side: a coarse texel sees more faces. */
static int32_t
samples_of(int32_t level)
{
    return level < 2 ? 2 : OTX_BLOCK_SAMPLES_MAX;
}

/* The block's place and size, and the apron that is looked at, too. */
static void
place(otx_block *b, int32_t x, int32_t y)
{
    const otx_mip *mip = b->mip;
    const int32_t top = mip->side - y * OTX_MIP_BLOCK;
    const int32_t apron = otx_block_has_apron(b) ? OTX_MIP_APRON : 0;
    const int32_t left = x * OTX_MIP_BLOCK;

    b->width = otx_mip_block_size(mip, x);
    b->height = otx_mip_block_size(mip, y);
    b->apron.left = left > 0 ? apron : 0;
    b->apron.below = top > b->height ? apron : 0;
    b->raster = (otx_raster){
        .origin = {left - b->apron.left, top - b->height - b->apron.below},
        .width = b->width + b->apron.left +
                 (left + b->width < mip->side ? apron : 0),
        .height = b->height + b->apron.below + (y > 0 ? apron : 0),
        .n = samples_of(mip->level),
    };
}

static bool
allocate(otx_block *b, otx_arena *scratch)
{
    b->pieces = OTX_NEW(scratch, otx_mip_facet, OTX_BLOCK_PIECES);
    for (int32_t i = 0; b->pieces && i < OTX_BLOCK_PIECES; ++i)
        b->pieces[i].id = -1;
    return b->pieces && otx_beyond_begin(scratch, &b->beyond) &&
           otx_raster_begin(scratch, &b->raster) &&
           otx_raster_near_begin(scratch, &b->raster, &b->near.rim) &&
           otx_raster_near_begin(scratch, &b->raster, &b->near.seam);
}

static void
draw_face(otx_block *b, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(b->source->layout->surface);

    for (int32_t k = 0; k < otx_facet_count(leaf, face); ++k)
    {
        const otx_facet facet = otx_facet_at(leaf, face, k);
        const otx_vec2 p[3] = {
            otx_mip_texel(b->mip, facet.corners[0]),
            otx_mip_texel(b->mip, facet.corners[1]),
            otx_mip_texel(b->mip, facet.corners[2])};

        otx_raster_triangle(&b->raster, p, otx_mip_facet_id(face, k));
    }
}

/* Those of a block, in a bin. */
static void
draw_faces(otx_block *b, int64_t index)
{
    const otx_layout *layout = b->source->layout;
    const int32_t *faces =
        layout->tile_faces + layout->tile_first[b->mip->tile];
    const otx_bin *bin = &b->mip->faces;

    for (int64_t i = bin->first[index]; i < bin->first[index + 1]; ++i)
        draw_face(b, faces[bin->items[i]]);
}

/* Those of `edges` in a bin, as far as `radius` texels around them. */
static void
draw_edges(
    const otx_block *b, const otx_mip_rim *edges, const otx_bin *bin,
    int64_t index, double radius, otx_raster_near *near)
{
    for (int64_t i = bin->first[index]; i < bin->first[index + 1]; ++i)
    {
        otx_vec2 ends[2];

        otx_mip_ends(b->mip, &edges[bin->items[i]], ends);
        otx_raster_edge(&b->raster, ends, radius, bin->items[i], near);
    }
}

bool
otx_block_draw(
    const otx_texel_source *source, const otx_texel_source *maps,
    const otx_mip *mip, int32_t x, int32_t y, otx_arena *scratch,
    otx_block *out)
{
    const int64_t index = (int64_t)y * mip->columns + x;
    const int64_t rim = mip->near_rims.first[index];

    *out = (otx_block){
        .source = source,
        .maps = maps,
        .channels = source->channels + (maps ? maps->channels : 0),
        .mip = mip,
        .rims =
            {mip->near_rims.items + rim, mip->near_rims.first[index + 1] - rim,
             mip->far_rim[index]},
    };
    place(out, x, y);
    if (!allocate(out, scratch))
        return false;
    draw_faces(out, index);
    draw_edges(
        out, mip->rims, &mip->near_rims, index, mip->gutter, &out->near.rim);
    draw_edges(
        out, mip->seams, &mip->near_seams, index, mip->blend, &out->near.seam);
    return true;
}

const otx_mip_facet *
otx_block_beyond(otx_block *block, const otx_mip_facet *placed, otx_vec2 texel)
{
    const otx_beyond_scene scene = {
        block->source, block->maps, block->raster.n};

    return otx_beyond_find(&block->beyond, &scene, placed, texel, STEPS);
}

otx_walk
otx_block_walk(otx_block *block, const otx_mip_facet *placed, otx_vec2 texel)
{
    const otx_layout *layout = block->source->layout;
    const otx_mip_facet *beyond = otx_block_beyond(block, placed, texel);
    otx_walk walk = otx_mip_facet_place(beyond ? beyond : placed, texel);

    if (!beyond)
        otx_walk_on(layout->surface, layout->covered, STEPS, &walk);
    return walk;
}
