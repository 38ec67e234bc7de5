/* worth.h -- what a chart is worth as the ground of a picture. */
#ifndef OTX_PLACE_WORTH_H
#define OTX_PLACE_WORTH_H

#include "place/footprint.h"

/* Sets the figures of a chart whose slots are still in `space`. MEMORY. */
otx_status otx_worth_judge(
    otx_arena *arena, const otx_footprint_ask *ask,
    const otx_footprint_space *space, otx_footprint *c);

#endif
