/* chart_owner.h -- whose a texel is that several charts reach into. */
#ifndef OTX_BAKE_CHART_OWNER_H
#define OTX_BAKE_CHART_OWNER_H

#include "bake/block.h"

/* The chart with most samples in a texel, of equal ones the first, and the
 * first sample that has it; -1 where no face reaches. */
int32_t
otx_chart_owner(const otx_block *block, int32_t x, int32_t y, int32_t *first);

#endif
