/* toroid.h -- a picture that does not tile, made to.
 *
 * Where the picture's borders meet, windows of the picture itself are laid
 * over the meeting line, those whose surroundings are most like what is there,
 * and sewn in by minimum cuts [Kwatra03]. The picture keeps its size and, away
 * from its borders, its texels; nothing is blended. What came of it is judged,
 * since features that were fused across a cut are worse than a visible repeat.
 * See docs/notes/toroid.md. */
#ifndef OTX_QUILT_TOROID_H
#define OTX_QUILT_TOROID_H

#include "quilt/texel_pool.h"

enum
{
    OTX_TOROID_MIN_SIDE = 32
};

typedef struct otx_toroid
{
    otx_texel_map map; /* of the picture's size, in run->arena */
    /* Mean distance along the cuts, as a share of two random texels'. */
    double cut;
    double oddness; /* see quilt/oddness.h: much above 1, cuts show */
} otx_toroid;

/* Makes `exemplar` tile along the axes along which it does not. LIMIT when a
 * side is below OTX_TOROID_MIN_SIDE, MEMORY, CANCELLED. */
otx_status
otx_toroid_make(otx_run *run, const otx_exemplar *exemplar, otx_toroid *out);

#endif
