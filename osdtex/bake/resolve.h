/* resolve.h -- what texels show that charts reach into.
 *
 * A texel is the mean of n x n samples. One that several charts reach into
 * belongs to the chart with most samples; the others' samples are taken from
 * what that chart's surface shows there. */
#ifndef OTX_BAKE_RESOLVE_H
#define OTX_BAKE_RESOLVE_H

#include "bake/block.h"

/* What a texel shows: all channels of the block.
 *
 *   chart  its owner
 *   first  a sample that has it */
void otx_resolve_texel(
    otx_block *block, int32_t x, int32_t y, int32_t chart, int32_t first,
    float *out);

#endif
