/* continuation.h -- the placement that continues what is textured. */
#ifndef OTX_PATCH_CONTINUATION_H
#define OTX_PATCH_CONTINUATION_H

#include "match/mask.h"
#include "patch/mosaic.h"

/* The rotation by which the mask's charts of the same exemplar
 * lie in it now, weighted by area: the orientation that continues them. */
double otx_continuation_angle(const otx_mask *mask);
/* The whole placement, error 0. False when there is nothing to continue, or one
 * of the points would leave an exemplar that does not tile. */
bool otx_continuation_place(
    const otx_supply *supply, const otx_mask *mask, const otx_vec2 *points,
    int32_t count, otx_match *out);
/* The same with its error; false, too, where the mask covers no texel. */
bool otx_continuation_match(
    const otx_supply *supply, const otx_mask *mask, const otx_vec2 *points,
    int32_t count, otx_match *out);

#endif
