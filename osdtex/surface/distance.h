/* distance.h -- how far faces are from where labels change.
 *
 * Which faces a relaxation may move: seams pull, and what lies far from all of
 * them comes to rest where it was. Where a surface is mostly one patch, leaving
 * that out is most of the time. */
#ifndef OTX_SURFACE_DISTANCE_H
#define OTX_SURFACE_DISTANCE_H

#include "base/run.h"
#include "surface/surface.h"

/* Marks the leaf faces within `distance` (scene units, from centre to centre
 * along faces) of a face that has a neighbour in another patch.
 *
 *   face_patch  [leaf face_count], -1 on holes
 *   out         [leaf face_count] in run->scratch, 1 within reach
 *
 * MEMORY. */
otx_status otx_distance_mark(
    otx_run *run, const otx_surface *surface, const int32_t *face_patch,
    double distance, uint8_t **out);

/* How far each leaf face is from one that has a neighbour with another label,
 * from centre to centre along faces; INFINITY beyond `limit`.
 *
 *   label   [leaf face_count]
 *   unit    texels to a scene unit, times the surface's density
 *   limit   texels
 *   out     [leaf face_count] texels
 *
 * MEMORY. */
otx_status otx_distance_measure(
    otx_run *run, const otx_surface *surface, const uint8_t *label, double unit,
    double limit, double *out);

#endif
