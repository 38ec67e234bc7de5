/* limit.h -- frames and measures of the leaf level on the limit surface. */
#ifndef OTX_SURFACE_LIMIT_H
#define OTX_SURFACE_LIMIT_H

#include "surface/level.h"

#include "base/run.h"

/* Makes orthonormal frames out of OpenSubdiv's tangents.
 *
 * The normal is tan1 x tan2. Where that vanishes (creased cusps, collapsed
 * faces) it is the sum of the area vectors of the leaf polygons around the
 * vertex; where that vanishes too, the z axis. tan1 keeps its direction where
 * it has one, else it is any.
 *
 *   points    [vert_count * 3]
 *   tangents  [vert_count * 6], in: any, tan1 then tan2; out: unit, tan1 x
 *             tan2 = normal
 *   normals   [vert_count * 3], out */
otx_status otx_limit_frames(
    otx_run *run, const otx_level *leaf, const float *points, float *tangents,
    float *normals);

/* The area of the polygons that are not holes, and the mean edge length.
 * Summed range by range in order: the same for any number of threads. */
otx_status otx_limit_measure(
    otx_run *run, const otx_level *leaf, const float *points, double *area,
    double *mean_edge_length);

/* Whether a face has no area beyond what rounding its corners to float can
 * make of nothing. Such a face has no sense: it cannot be reversed. */
bool otx_limit_face_is_flat(
    const otx_level *leaf, const float *points, int32_t face);

#endif
