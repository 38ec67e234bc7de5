/* band.h -- the part of a mask triangle that lies in the band. */
#ifndef OTX_PATCH_BAND_H
#define OTX_PATCH_BAND_H

#include "match/mask.h"

/* Cuts a mask triangle where it leaves the band.
 *
 *   reach  of its corners, in the unit of limit
 *   out    what is left, 0 to 2 triangles; the count is returned */
int32_t otx_band_clip(
    const otx_mask_triangle *triangle, const double reach[3], double limit,
    otx_mask_triangle out[2]);
/* Leaves out of a mask the triangles that are not within `sight` of `middle`
 * along both axes; the others keep their order. */
void otx_band_keep_near(
    otx_mask_triangle *triangles, int32_t *count, otx_vec2 middle,
    double sight);

#endif
