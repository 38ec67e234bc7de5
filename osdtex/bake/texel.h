/* texel.h -- what the texels of a baked texture show. */
#ifndef OTX_BAKE_TEXEL_H
#define OTX_BAKE_TEXEL_H

#include "bake/mip_level.h"
#include "bake/texel_source.h"

/* Bakes one block into pixels[height * width * channels], bottom row first.
 *
 *   x, y  of the block; rows count from the top
 *
 * False when memory is out. */
bool otx_texel_bake(
    const otx_texel_source *source, const otx_mip *mip, int32_t x, int32_t y,
    otx_arena *scratch, float *pixels);

#endif
