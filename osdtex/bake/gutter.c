/* gutter.c -- texels beyond the rims of all charts. */
#include "bake/gutter.h"

#include "bake/aov.h"
#include "bake/crossfade.h"
#include "bake/sample.h"

#include <string.h>

enum
{
    NOT_LOOKED_FOR = -2
};

otx_gutter
otx_gutter_begin(void)
{
    otx_gutter out;

    for (size_t i = 0; i < sizeof out.rims / sizeof *out.rims; ++i)
        out.rims[i] = NOT_LOOKED_FOR;
    return out;
}

/* The point of a rim nearest to a texel position, in texels. */
static otx_vec2
nearest_on(const otx_mip *mip, int32_t rim, otx_vec2 texel)
{
    otx_vec2 ends[2];

    otx_mip_ends(mip, &mip->rims[rim], ends);
    return otx_vec2_lerp(
        ends[0], ends[1], otx_raster_nearest(ends[0], ends[1], texel));
}

/* The nearest of the rims around the block; -1 when the mip level has none. */
static int32_t
nearest_rim(const otx_block *block, otx_vec2 texel)
{
    double best_sq = INFINITY;
    int32_t best = block->rims.far;

    for (int64_t i = 0; i < block->rims.count; ++i)
    {
        const otx_vec2 d = otx_vec2_sub(
            texel, nearest_on(block->mip, block->rims.near[i], texel));
        const double sq = otx_vec2_dot(d, d);

        if (sq < best_sq)
        {
            best_sq = sq;
            best = block->rims.near[i];
        }
    }
    return best;
}

/* That of a texel's cell. They begin at the texels that a colour without maps
 * looks at, one cell earlier, so that maps leave it as it is. */
static int32_t
rim_of_cell(const otx_block *block, int32_t x, int32_t y, otx_gutter *found)
{
    enum
    {
        CELL = OTX_GUTTER_CELL
    };
    const bool is_whole = block->mip->level == 0;
    const int32_t left = (is_whole ? 0 : block->apron.left) - CELL;
    const int32_t below = (is_whole ? 0 : block->apron.below) - CELL;
    const int32_t i = (x - left) / CELL, j = (y - below) / CELL;
    int32_t *rim = &found->rims[j * OTX_GUTTER_CELLS + i];

    if (*rim == NOT_LOOKED_FOR)
        *rim = nearest_rim(
            block, otx_raster_texel(
                       &block->raster, left + i * CELL + CELL / 2,
                       below + j * CELL + CELL / 2));
    return *rim;
}

/* A texel beyond the rims: the facet of the rim that it continues, and the
 * position on it or beyond. */
typedef struct place
{
    const otx_mip_facet *rim; /* NULL: nothing is there */
    otx_vec2 at;
    bool is_near; /* beyond: it goes on from the rim */
} place;

static place
find_place(otx_block *block, int32_t x, int32_t y, otx_gutter *found)
{
    const otx_vec2 at = otx_raster_texel(&block->raster, x, y);
    const otx_mip_rim *rims = block->mip->rims;
    const int32_t near = block->near.rim.edges[otx_block_index(block, x, y)];
    const int32_t far = near >= 0 ? -1 : rim_of_cell(block, x, y, found);

    if (near >= 0)
        return (place){otx_block_rim_piece(block, &rims[near]), at, true};
    if (far < 0)
        return (place){0};
    return (place){
        otx_block_rim_piece(block, &rims[far]), nearest_on(block->mip, far, at),
        false};
}

static otx_walk
walk_to(otx_block *block, const place *p)
{
    return p->is_near ? otx_block_walk(block, p->rim, p->at)
                      : otx_mip_facet_place(p->rim, p->at);
}

/* What is there of colours and maps. */
static void
sample(otx_block *block, const place *p, float *out)
{
    const otx_mip_facet *facet =
        p->is_near ? otx_block_beyond(block, p->rim, p->at) : p->rim;

    if (facet)
        otx_sample_texel(block, facet, p->at, out);
    else
    {
        const otx_walk walk = walk_to(block, p);

        otx_sample_walk(block, &walk, 1.0, out);
    }
}

void
otx_gutter_texel(
    otx_block *block, int32_t x, int32_t y, otx_gutter *found, float *out)
{
    const place p = find_place(block, x, y, found);

    if (!p.rim)
        memset(out, 0, (size_t)block->channels * sizeof *out);
    else if (!otx_texel_is_filtered(block->source->kind))
    {
        const otx_walk walk = walk_to(block, &p);

        otx_aov_gutter(block, x, y, &walk, out);
    }
    else
    {
        sample(block, &p, out);
        if (p.is_near)
            otx_crossfade_beyond(block, x, y, out);
    }
}
