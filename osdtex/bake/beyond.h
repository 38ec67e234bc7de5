/* beyond.h -- texels beyond the rims of all charts.
 *
 * In the gutter they show where a walk from the nearest rim ends, so that
 * lookups across the rim find what the surface there goes on to; far beyond,
 * the rim itself. */
#ifndef OTX_BAKE_BEYOND_H
#define OTX_BAKE_BEYOND_H

#include "bake/block.h"

enum
{
    OTX_BEYOND_CELL = 8, /* texels of a cell's side */
    OTX_BEYOND_CELLS =   /* a row */
    (OTX_PAGE_BLOCK + 2 * OTX_PAGE_APRON + OTX_BEYOND_CELL - 1) /
    OTX_BEYOND_CELL
};

/* The rims nearest to cells of a block beyond all gutters, as far as they were
 * looked for. */
typedef struct otx_beyond
{
    int32_t rims[OTX_BEYOND_CELLS * OTX_BEYOND_CELLS];
} otx_beyond;

otx_beyond otx_beyond_begin(void);

/* All channels of a texel that no face reaches into; 0 where the page has no
 * rims. */
void otx_beyond_texel(
    otx_block *block, int32_t x, int32_t y, otx_beyond *found, float *out);

#endif
