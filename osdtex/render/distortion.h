/* distortion.h -- how far each face's UVs depart from isometry, to be shown.
 */
#ifndef OTX_RENDER_DISTORTION_H
#define OTX_RENDER_DISTORTION_H

#include "render/scene.h"

/* The L2 stretch of [Sander01, sec. 3] of each face, RMS over its triangles:
 * 1 is isometric, INFINITY is flipped or without area in UV, NaN is a hole.
 *
 *   units  of each texture: scene units of one unit of u and of v; NULL:
 *          chosen, with the first one's aspect, so that the model has the same
 *          area in both
 *   out    [face_count], made in `arena`; NULL when the scene has no UVs
 *
 * MEMORY. */
otx_status otx_distortion_faces(
    otx_run *run, otx_arena *arena, const otx_scene *scene,
    const otx_vec2 *units, const float **out);

/* Mean over the area of the faces that have a finite value, and how many of
 * those drawn have none. */
double otx_distortion_mean(
    const otx_scene *scene, const float *stretch, int64_t *flipped);

#endif
