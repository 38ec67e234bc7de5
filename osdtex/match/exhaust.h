/* exhaust.h -- all translations of one orientation, through Fourier space. */
#ifndef OTX_MATCH_EXHAUST_H
#define OTX_MATCH_EXHAUST_H

#include "match/matcher.h"
#include "match/peaks.h"
#include "match/wear.h"

/* Buffers of one thread, for one level. */
typedef struct otx_exhaust_buffers
{
    float *planes[OTX_PLANE_SPECTRA]; /* the mask: weighted colours, weights */
    float *scratch;
    float *map;
    int32_t *usage_column; /* cell of the usage grid for each x0 */
    otx_wear wear;
} otx_exhaust_buffers;

/* MEMORY. */
otx_status otx_exhaust_buffers_create(
    otx_arena *arena, const otx_plane *plane, const otx_match_query *query,
    otx_exhaust_buffers *out);

/* What eq. 2 needs beside the map: E(x0) = (energy + map(x0)) / weight. */
typedef struct otx_exhaust_sums
{
    double energy; /* sum of weight |I|^2 */
    double weight; /* sum of J; 0 when no pixel was hit */
    /* Pixel of the mask's frame (R(angle) flat / pixel) that x0 counts from,
     * the plane's pad included: shift = (x0 - base) pixel. */
    int32_t base_x, base_y;
} otx_exhaust_sums;

/* Fills buffers->map for one angle of the query, over the whole period; where
 * an axis does not tile only shifts in its range mean something. */
otx_exhaust_sums otx_exhaust_map(
    const otx_plane *plane, const otx_mask *mask, double angle,
    const otx_exhaust_buffers *buffers);

/* Adds the local minima of one angle (times usage) to `peaks`. */
void otx_exhaust_angle(
    const otx_matcher *matcher, int32_t level, const otx_mask *mask,
    const otx_match_query *query, int32_t angle,
    const otx_exhaust_buffers *buffers, otx_peaks *peaks);

/* The placement of a peak, held inside `range`. */
otx_match otx_exhaust_placement(
    const otx_matcher *matcher, int32_t level, const otx_mask *mask,
    const otx_match_query *query, const otx_peak *peak,
    const otx_matcher_range *range);

#endif
