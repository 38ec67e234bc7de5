/* block.h -- a block of texels at work: what lies under its samples. */
#ifndef OTX_BAKE_BLOCK_H
#define OTX_BAKE_BLOCK_H

#include "bake/beyond.h"
#include "bake/mip_facet.h"
#include "bake/raster.h"

enum
{
    OTX_BLOCK_PIECES = 1024,  /* kept between samples; a power of two */
    OTX_BLOCK_SAMPLES_MAX = 4 /* to a texel's side */
};

typedef struct otx_block_rims
{
    const int32_t *near; /* [count] the block */
    int64_t count;
    int32_t far; /* one where none is near */
} otx_block_rims;

/* Texels before the block's first; 0 at the picture's border. */
typedef struct otx_block_apron
{
    int32_t left, below;
} otx_block_apron;

/* What is nearest to each texel. */
typedef struct otx_block_near
{
    otx_raster_near rim, seam;
} otx_block_near;

/* The texels of a mip level's block, with an apron of texels around them where
 * they are fitted to lookups. */
typedef struct otx_block
{
    const otx_texel_source *source;
    const otx_texel_source *maps; /* shown by the same samples; NULL none */
    int32_t channels;             /* of both, those of `maps` behind */
    const otx_mip *mip;
    int32_t width, height; /* without the apron */
    otx_block_apron apron;
    otx_raster raster; /* with it */
    otx_block_near near;
    otx_mip_facet *pieces; /* [OTX_BLOCK_PIECES], by hash of their id */
    otx_beyond beyond;     /* what they go on to */
    otx_block_rims rims;
} otx_block;

/* Places block (x, y), of which rows count from the top, and draws the faces,
 * rims and seams in it. False when memory is out. */
bool otx_block_draw(
    const otx_texel_source *source, const otx_texel_source *maps,
    const otx_mip *mip, int32_t x, int32_t y, otx_arena *scratch,
    otx_block *out);

/* Where a walk from a facet to a texel position ends. */
otx_walk
otx_block_walk(otx_block *block, const otx_mip_facet *placed, otx_vec2 texel);

/* The facet that it ends in, unfolded; NULL where the surface ends before.
 * Holds until the next call. */
const otx_mip_facet *
otx_block_beyond(otx_block *block, const otx_mip_facet *placed, otx_vec2 texel);

/* Whether colours are fitted to lookups, which come close to those of level 0.
 */
static inline bool
otx_block_is_fitted(const otx_block *block)
{
    return block->mip->level == 0 && block->source->kind == OTX_TEXEL_COLOR;
}

/* Whether texels around it are looked at: where it is fitted, and where there
 * are maps, of which heights must meet at all levels. */
static inline bool
otx_block_has_apron(const otx_block *block)
{
    return otx_block_is_fitted(block) || block->maps ||
           block->source->kind == OTX_TEXEL_MAPS;
}

/* Index of a texel of the raster. */
static inline size_t
otx_block_index(const otx_block *block, int32_t x, int32_t y)
{
    return (size_t)y * (size_t)block->raster.width + (size_t)x;
}

/* Id of the facet at sample s of a texel; -1 none. */
static inline int64_t
otx_block_sample(const otx_block *block, int32_t x, int32_t y, int32_t s)
{
    const int32_t n = block->raster.n, i = x * n + s % n, j = y * n + s / n;

    return block->raster
        .facets[(size_t)j * (size_t)(block->raster.width * n) + (size_t)i];
}

/* A facet, made when it is first met; holds until the next call. */
static inline const otx_mip_facet *
otx_block_piece(otx_block *block, int64_t id)
{
    otx_mip_facet *placed =
        &block->pieces[((id >> 16) * 2 + (id & 1)) & (OTX_BLOCK_PIECES - 1)];

    if (placed->id != id)
        *placed = otx_mip_facet_make(
            block->source, block->maps, block->mip, block->raster.n, id);
    return placed;
}

/* The facet that a rim or a seam is a side of. */
static inline const otx_mip_facet *
otx_block_rim_piece(otx_block *block, const otx_mip_rim *rim)
{
    const otx_level *leaf = otx_surface_leaf(block->source->layout->surface);
    int32_t side;
    const otx_facet facet =
        otx_facet_at_edge(leaf, rim->face, rim->edge, &side);

    return otx_block_piece(block, otx_mip_facet_id(facet.face, facet.index));
}

#endif
