/* scale_check.h -- whether a scale and the size of a surface go together. */
#ifndef OTX_METHOD_SCALE_CHECK_H
#define OTX_METHOD_SCALE_CHECK_H

#include "exemplar/exemplar.h"
#include "surface/surface.h"

/* Refuses a scale at which no method can work: edges over a thousand pictures
 * long, edges that UVs of 32 bits cannot tell from points, a surface that
 * shows less than a texel. LIMIT.
 *
 *   finer  how many times shorter the edges are than those of `surface`: of a
 *          draft 2 to the levels that it lacks, else 1
 *   scale  width of the exemplar, scene units, positive */
otx_status otx_scale_check(
    otx_run *run, const otx_surface *surface, double finer,
    const otx_exemplar *exemplar, double scale);

/* Warns of a scale that looks as if it were given in other units than the
 * cage: dozens of pictures across the surface, a fraction of one, or edges as
 * long as the picture.
 *
 *   level  that the surface is going to have */
void
otx_scale_warn(otx_run *run, const otx_cage *cage, int32_t level, double scale);

#endif
