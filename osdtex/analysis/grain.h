/* grain.h -- the direction in which a picture changes least.
 *
 * By the structure tensor, over two sizes of detail. */
#ifndef OTX_ANALYSIS_GRAIN_H
#define OTX_ANALYSIS_GRAIN_H

#include "analysis/square.h"

typedef struct otx_grain
{
    double angle;     /* radians */
    double coherence; /* of the structure tensor, 0 .. 1 */
    double skew;      /* of gradients along and across the grain; 0: none */
} otx_grain;

/* MEMORY. */
otx_status otx_grain_measure(const otx_square *square, otx_grain *out);

/* What changes along `angle`: the derivative of the square, somewhat blurred,
 * [side * side] with mean 0 in run->scratch. MEMORY. */
otx_status otx_grain_slope(const otx_square *square, double angle, float **out);

#endif
