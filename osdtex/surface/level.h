/* level.h -- one level of the subdivision hierarchy, as flat arrays.
 *
 * Names are OpenSubdiv's relations. Two facts make the hierarchy cheap to use
 * as face clusters [Soler02, sec. 3.1]:
 *
 * - children of a face are contiguous in the next level, in parent order, so
 *   all descendants of a face at any level are one range;
 * - vertex v of level k is vertex v of level k + 1 (vertices born from
 *   vertices come first), so the control vertices of a cluster at any level
 *   are leaf vertices with the same index. */
#ifndef OTX_SURFACE_LEVEL_H
#define OTX_SURFACE_LEVEL_H

#include "base/status.h"

typedef struct otx_level
{
    int32_t face_count, vert_count, edge_count, corner_count;
    const int32_t *face_first; /* [face_count + 1] */
    const int32_t *face_verts; /* [corner_count], counter-clockwise outside */
    const int32_t *face_edges; /* [corner_count], edge k joins corner k, k+1 */
    const int32_t *edge_verts; /* [edge_count * 2] */
    const int32_t *edge_faces; /* [edge_count * 2], second -1 on a boundary */

    const int32_t *face_parent; /* [face_count], NULL at level 0 */
    /* Into the next level; NULL at the last. */
    const int32_t *face_child_first; /* [face_count + 1], child faces */
    const int32_t *face_child_vert;  /* [face_count], -1 none (Loop) */
    const int32_t *edge_child_vert;  /* [edge_count] */

    const uint8_t *face_hole; /* [face_count], inherited */
    const int32_t *face_cage; /* [face_count], ancestor at level 0 */
} otx_level;

static inline int32_t
otx_level_face_size(const otx_level *level, int32_t face)
{
    return level->face_first[face + 1] - level->face_first[face];
}

/* The face across edge k of `face`, -1 at a boundary. */
static inline int32_t
otx_level_neighbour(const otx_level *level, int32_t face, int32_t k)
{
    const int32_t edge = level->face_edges[level->face_first[face] + k];
    const int32_t *faces = level->edge_faces + 2 * (size_t)edge;

    return faces[0] == face ? faces[1] : faces[0];
}

#endif
