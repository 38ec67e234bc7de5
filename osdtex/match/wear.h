/* wear.h -- how much of what a patch would show has been shown before.
 *
 * Usage is a grid over the exemplar; a placement costs more by the mean of it
 * over all that the patch covers there, so that patches go where the picture is
 * fresh, its rim and corners included. */
#ifndef OTX_MATCH_WEAR_H
#define OTX_MATCH_WEAR_H

#include "match/matcher.h"

/* Buffers of one thread for the grid of a query. */
typedef struct otx_wear
{
    float *print;   /* [2 usage_height * 2 usage_width] shares of the patch by
                     * cells from its centre */
    float *factors; /* [usage_height * usage_width] by the centre's cell */
} otx_wear;

/* Nothing of a query without usage. MEMORY. */
otx_status
otx_wear_create(otx_arena *arena, const otx_match_query *query, otx_wear *out);

/* 1 + usage_weight * mean usage, for each cell that the centre may land in
 * when the patch is turned by `angle`. */
void otx_wear_tabulate(
    const otx_matcher *matcher, const otx_match_query *query, double angle,
    const otx_wear *wear);

/* The same of one placement; 1 of a query without usage. */
double otx_wear_factor(
    const otx_matcher *matcher, const otx_match_query *query,
    const otx_match *placement);

#endif
