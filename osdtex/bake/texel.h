/* texel.h -- what the texels of a baked texture show. */
#ifndef OTX_BAKE_TEXEL_H
#define OTX_BAKE_TEXEL_H

#include "bake/map_source.h"
#include "bake/mip_level.h"

/* Bakes one block into pixels[height * width * channels], bottom row first.
 *
 *   maps    baked with it, from the same samples; NULL none
 *   x, y    of the block; rows count from the top
 *   planes  of each kind that `maps` has [height * width * its channels]
 *
 * False when memory is out. */
bool otx_texel_bake(
    const otx_texel_source *source, const otx_map_source *maps,
    const otx_mip *mip, int32_t x, int32_t y, otx_arena *scratch, float *pixels,
    float *const planes[OTX_COMPANION_COUNT]);

/* The same without the colour: the planes are those that come with it. */
bool otx_texel_bake_maps(
    const otx_map_source *maps, const otx_mip *mip, int32_t x, int32_t y,
    otx_arena *scratch, float *const planes[OTX_COMPANION_COUNT]);

#endif
