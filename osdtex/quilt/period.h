/* period.h -- the part of a picture that holds whole periods of its lattice.
 *
 * A lattice that is cut off in mid-period cannot be sewn to itself. Where a
 * whole combination of the generators lies along a side of the picture, a
 * rectangle of that length can. See docs/notes/toroid.md. */
#ifndef OTX_QUILT_PERIOD_H
#define OTX_QUILT_PERIOD_H

#include "exemplar/exemplar.h"

typedef struct otx_period
{
    int32_t x, y; /* lower left texel of the rectangle */
    int32_t width, height;
} otx_period;

/* The largest rectangle of at least half of the picture's sides that holds
 * whole periods, all of the picture along axes along which it tiles; of those
 * lengths that a few texels would change, and of all places, the one whose ends
 * are most alike.
 *
 *   generators  texels
 *
 * False where no combination lies along a side, within a thirtieth of the
 * shorter generator. */
bool otx_period_find(
    const otx_exemplar *exemplar, const otx_vec2 generators[2],
    otx_period *out);

#endif
