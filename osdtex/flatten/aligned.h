/* aligned.h -- coordinates whose axes lie along a field [Praun00, sec. 3.4].
 *
 * On each triangle the images of the field's vectors S ("right") and T ("up")
 * are to be the axes of the plane:
 *
 *     F = sum over triangles of area (|phi(S) - s|^2 + |phi(T) - t|^2).
 *
 * That is the energy of rigid.h with the rotations given by the field instead
 * of being the best ones, so one linear system is all there is to solve. The
 * paper weighs every triangle alike; by area the result does not depend on how
 * the surface is cut into triangles. See docs/notes/lapped.md. */
#ifndef OTX_FLATTEN_ALIGNED_H
#define OTX_FLATTEN_ALIGNED_H

#include "flatten/rigid.h"

/* Moves `flat` to the minimum of F, which is unique but for where it lies: the
 * mean of `flat` stays.
 *
 *   rights  [mesh->face_count] S of each face, along the surface, unit
 *   worker  asked now and then whether to stop; NULL: nobody
 *   flat    [mesh->vert_count] texels, in and out
 *
 * MEMORY, without a finding; CANCELLED. */
otx_status otx_aligned_solve(
    otx_arena *scratch, const otx_rigid_mesh *mesh, const otx_vec3 *rights,
    const otx_worker *worker, otx_vec2 *flat);

/* How far F is from 0: sums over the triangles of a face.
 *
 *   sums  added to: area |phi(S) - s|^2, area |phi(T) - t|^2, area, in texels
 *         squared */
void otx_aligned_error(
    const otx_rigid_mesh *mesh, int32_t face, otx_vec3 right,
    const otx_vec2 *flat, double sums[3]);

#endif
