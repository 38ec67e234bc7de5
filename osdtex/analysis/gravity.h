/* gravity.h -- does a picture have a top?
 *
 * Masonry, text and roofs are seen upright. What tells it: rows run level from
 * side to side while what parts them along the way breaks off at the next row;
 * or edges are lit, or laid over each other, from above, and not from a side.
 * See docs/notes/analysis.md. */
#ifndef OTX_ANALYSIS_GRAVITY_H
#define OTX_ANALYSIS_GRAVITY_H

#include "analysis/square.h"

typedef struct otx_gravity
{
    bool upright;
    /* Likeness with itself, an eighth of the square further, of edges that run
     * level along x, and of upright ones along y. */
    double level, plumb;
    double across; /* energy of level edges over that of upright ones */
    /* Of gradients along y and along x: 0 where both ways look alike. The
     * smaller of two sizes of detail, the larger of the two. */
    double skew_y, skew_x;
} otx_gravity;

/* MEMORY. */
otx_status otx_gravity_measure(const otx_square *square, otx_gravity *out);

#endif
