/* sever.h -- a mesh that is no manifold, cut until it is one.
 *
 * Scans and game models have edges with three faces, flipped faces, and parts
 * that touch in a vertex. Their vertices are doubled here, so that every sheet
 * has vertices of its own: faces keep their order and their corners, positions
 * do not change, and nothing that knows only manifolds has to know more. */
#ifndef OTX_SURFACE_SEVER_H
#define OTX_SURFACE_SEVER_H

#include "base/arena.h"

typedef struct otx_sever
{
    int32_t vert_count;
    const int32_t *face_verts; /* [corner_count] */
    /* [vert_count] the vertex that each was; v itself for the first ones. NULL
     * when the mesh is a manifold already: nothing has changed. */
    const int32_t *source;
} otx_sever;

/* Edges with two faces that are wound alike hold, all others part. Vertices
 * must be in range and no face may repeat one. False when memory is out. */
bool otx_sever_build(
    otx_arena *arena, int32_t vert_count, int32_t face_count,
    const int32_t *face_first, const int32_t *face_verts, otx_sever *out);

/* Points of the vertices after the cut, `points` those before it: these where
 * nothing has changed, else in `arena`. NULL when memory is out. */
const float *
otx_sever_points(otx_arena *arena, const otx_sever *mesh, const float *points);

#endif
