/* mask_distance.h -- exact distances to the border of a mask, on a torus. */
#ifndef OTX_IMAGE_MASK_DISTANCE_H
#define OTX_IMAGE_MASK_DISTANCE_H

#include "base/run.h"

/* Signed Euclidean distance of each texel's middle to the border between what
 * is in the mask and what is not, in texels, positive inside: to the nearest
 * texel of the other kind, less one half. The picture wraps in both axes. By
 * lower envelopes of parabolas [Felzenszwalb12]; exact for sides up to
 * OTX_IMAGE_MAX_SIDE, time linear in the texels.
 *
 *   mask  [height * width] 0 or not; both kinds must be there
 *   out   [height * width]
 *
 * MEMORY. */
otx_status otx_mask_distance(
    otx_run *run, const uint8_t *mask, int32_t width, int32_t height,
    float *out);

#endif
