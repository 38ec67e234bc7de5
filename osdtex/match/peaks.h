/* peaks.h -- the lowest local minima of an error map. */
#ifndef OTX_MATCH_PEAKS_H
#define OTX_MATCH_PEAKS_H

#include "match/match.h"

typedef struct otx_peak
{
    double value;
    int32_t angle; /* index */
    int32_t y;
    int32_t x;
} otx_peak;

/* Ascending by value, then angle, y, x. */
typedef struct otx_peaks
{
    int32_t count;
    int32_t capacity; /* <= OTX_MATCH_MAX_KEEP */
    otx_peak list[OTX_MATCH_MAX_KEEP];
} otx_peaks;

/* A rectangle [x_begin, x_end) x [y_begin, y_end) of a map. Along an axis that
 * wraps it begins at 0 and ends at the period. */
typedef struct otx_peaks_map
{
    const float *values; /* value(x, y) = values[y * stride + x] */
    size_t stride;
    int32_t x_begin, x_end;
    int32_t y_begin, y_end;
    bool wrap_x, wrap_y;
} otx_peaks_map;

void otx_peaks_insert(otx_peaks *peaks, const otx_peak *peak);

/* Adds the local minima of `map`: pixels that no pixel at most 2 away in x and
 * y undercuts (of equal ones the first by row and column counts). Listed with
 * value offset + scale * value, scale > 0. */
void otx_peaks_scan(
    const otx_peaks_map *map, int32_t angle, double offset, double scale,
    otx_peaks *peaks);

#endif
