/* uv_fold.h -- charts that fold back on themselves, cut at the fold.
 *
 * Artists unwrap one half of a symmetric thing and let the other half use the
 * same texture vertices. Along the axis the UVs turn back; smoothed as one
 * chart they would be rounded over there, by rules that readers do not share.
 * A cut makes the axis the rim of two charts, which every reader leaves where
 * it is. */
#ifndef OTX_SURFACE_UV_FOLD_H
#define OTX_SURFACE_UV_FOLD_H

#include "surface/topology.h"

typedef struct otx_uv_fold
{
    int32_t uv_count;
    const float *uvs;        /* [uv_count * 2]; those that were, then copies */
    const int32_t *face_uvs; /* [corner_count] */
    int32_t edge_count;      /* of the folds; 0: nothing has changed */
    int32_t face;            /* beside the first of them; -1 */
} otx_uv_fold;

/* Folds are edges whose faces share both texture vertices and have areas of
 * opposite signs in UV.
 *
 *   arena     where the result and the temporaries go
 *   uvs       [uv_count * 2]
 *   face_uvs  [corner_count], all in range
 *
 * False when memory is out. */
bool otx_uv_fold_split(
    otx_arena *arena, const otx_topology *topology, int32_t uv_count,
    const float *uvs, const int32_t *face_uvs, otx_uv_fold *out);

#endif
