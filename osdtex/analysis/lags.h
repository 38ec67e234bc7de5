/* lags.h -- how like itself a square is when it is moved.
 *
 * Correlations are taken without assuming that the picture tiles: each lag is
 * normalised by the energy of what overlaps there. */
#ifndef OTX_ANALYSIS_LAGS_H
#define OTX_ANALYSIS_LAGS_H

#include "analysis/square.h"
#include "math/fft.h"

/* A map of lags; (0, 0) is at (reach, reach). */
typedef struct otx_lags
{
    int32_t reach; /* |x|, |y| <= reach */
    float *at;     /* [(2 reach + 1)^2] */
} otx_lags;

/* FFT planes, and what they are made into. */
typedef struct otx_lags_correlator
{
    otx_fft *fft;
    int32_t size; /* of the padded square */
    size_t stride;
    float *plane, *scratch, *spectrum, *out;
} otx_lags_correlator;

/* For squares of that size, in the run's arenas. MEMORY. */
otx_status otx_lags_prepare(const otx_square *square, otx_lags_correlator *out);

/* Correlation of `a` with `b` ([side * side]), 1 where they are proportional.
 *
 *   out  reach in, at out, in run->scratch
 *
 * MEMORY. */
otx_status otx_lags_likeness(
    const otx_square *square, otx_lags_correlator *correlator, const float *a,
    const float *b, otx_lags *out);

/* The direction within `within` radians of `about` in which the square stays
 * like itself longest; `about` where that goes on rising beyond.
 *
 *   likeness  the mean correlation along it, NULL: not wanted
 */
double otx_lags_ridge(
    const otx_lags *map, double about, double within, double *likeness);

/* Bilinear; NAN beyond reach. */
double otx_lags_at(const otx_lags *map, otx_vec2 lag);

#endif
