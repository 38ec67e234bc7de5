/* gutter.h -- texels beyond the rims of all charts.
 *
 * In the gutter they show where a walk from the nearest rim ends, so that
 * lookups across the rim find what the surface there goes on to; far beyond,
 * the rim itself. */
#ifndef OTX_BAKE_GUTTER_H
#define OTX_BAKE_GUTTER_H

#include "bake/block.h"

enum
{
    OTX_GUTTER_CELL = 8, /* texels of a cell's side */
    OTX_GUTTER_CELLS =   /* a row, with what an apron reaches into */
    (OTX_MIP_BLOCK + 2 * OTX_GUTTER_CELL) / OTX_GUTTER_CELL
};

/* The rims nearest to cells of a block beyond all gutters, as far as they were
 * looked for. */
typedef struct otx_gutter
{
    int32_t rims[OTX_GUTTER_CELLS * OTX_GUTTER_CELLS];
} otx_gutter;

otx_gutter otx_gutter_begin(void);

/* All channels of a texel that no face reaches into; 0 where the mip level has
 * no rims. */
void otx_gutter_texel(
    otx_block *block, int32_t x, int32_t y, otx_gutter *found, float *out);

#endif
