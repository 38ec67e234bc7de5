/* ground.h -- charts that grow face by face, for place/footprint.c. */
#ifndef OTX_PLACE_GROUND_H
#define OTX_PLACE_GROUND_H

#include "place/footprint.h"

typedef struct otx_ground
{
    const otx_footprint_ask *ask;
    const otx_footprint_space *space;
    otx_arena *arena;
    otx_footprint *chart;
    otx_vec2 *shape; /* [corners of the largest face] a face in its own plane */
    otx_vec2 *laid;  /* likewise: where its corners are to go */
} otx_ground;

/* Makes room, and lays the spot's face into the plane. MEMORY. */
otx_status otx_ground_begin(otx_ground *u);

/* Adds faces at the chart's rim, nearest to the origin first, that meet the
 * picture's box with `reach` around it. A face whose corners are known already
 * is added where it keeps its area about, and its sense. MEMORY, CANCELLED. */
otx_status otx_ground_grow(otx_ground *u, double reach);

/* Leaves out what does not meet the box with `reach` around it, or hangs
 * together with the spot's face outside of it only. MEMORY. */
otx_status otx_ground_trim(otx_ground *u, double reach);

/* Empties the slots. */
void otx_ground_end(otx_ground *u);

#endif
