/* polish.h -- from a pixel of the coarse search to a texel and below.
 *
 * Works on a few texels of the mask, picked evenly, so that the cost does not
 * depend on the size of the patch. */
#ifndef OTX_MATCH_POLISH_H
#define OTX_MATCH_POLISH_H

#include "match/matcher.h"

/* One texel of the mask, in the plane of the patch. */
typedef struct otx_polish_pick
{
    otx_vec2 flat;
    otx_vec2 source;
    otx_vec2 dx, dy; /* how the source moves with flat */
    float weight;
    const otx_matcher *from; /* as of its triangle */
} otx_polish_pick;

typedef struct otx_polish_picks
{
    otx_polish_pick *list;
    int32_t count;
} otx_polish_picks;

/* At most `limit` texels of the mask, every n-th in drawing order. MEMORY. */
otx_status otx_polish_pick_samples(
    otx_arena *arena, const otx_mask *mask, int32_t limit,
    otx_polish_picks *out);

/* Moves `match` to the best of the shifts at most `radius` (<= 2) pixels of
 * `level` away that `range` allows; it starts at one. match->error becomes the
 * mean square over the samples. MEMORY. */
otx_status otx_polish_window(
    otx_arena *scratch, const otx_matcher *matcher,
    const otx_polish_picks *picks, int32_t pick_count,
    const otx_matcher_range *range, int32_t level, int32_t radius,
    otx_match *match);

/* A few Gauss-Newton steps on (x, y, angle), at most 1.5 texels in all. The
 * shift range at the new angle is the caller's to check. Leaves `match` when
 * the samples do not fit better. MEMORY. */
otx_status otx_polish_gauss_newton(
    otx_arena *scratch, const otx_matcher *matcher,
    const otx_polish_picks *picks, otx_match *match);

#endif
