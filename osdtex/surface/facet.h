/* facet.h -- leaf faces as triangles, the way they are rendered.
 *
 * They are fans about their first corner, as Blender cuts quads (see
 * tests/dcc/test_blender.py). What is baked for one diagonal shows a bent quad
 * wrongly along the other. Within a facet everything is affine:
 * texture coordinates, exemplar UVs, positions. */
#ifndef OTX_SURFACE_FACET_H
#define OTX_SURFACE_FACET_H

#include "surface/level.h"

typedef struct otx_facet
{
    int32_t face;
    int32_t index;      /* in the face */
    int32_t corners[3]; /* of the level */
    /* What is across side i, from corner i to corner i + 1: edge k of the face
     * as k, or another facet of the face as ~index. */
    int32_t across[3];
} otx_facet;

static inline int32_t
otx_facet_count(const otx_level *level, int32_t face)
{
    return otx_level_face_size(level, face) - 2;
}

static inline otx_facet
otx_facet_at(const otx_level *level, int32_t face, int32_t index)
{
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    const int32_t last = size - 3;

    return (otx_facet){
        face,
        index,
        {first, first + index + 1, first + index + 2},
        {index == 0 ? 0 : ~(index - 1), index + 1,
         index == last ? size - 1 : ~(index + 1)}};
}

/* The side of `facet` with `across` behind it. */
static inline int32_t
otx_facet_side(const otx_facet *facet, int32_t across)
{
    return facet->across[0] == across ? 0 : facet->across[1] == across ? 1 : 2;
}

/* The facet at edge k of a face, and the side that the edge is. */
static inline otx_facet
otx_facet_at_edge(
    const otx_level *level, int32_t face, int32_t k, int32_t *side)
{
    const int32_t size = otx_level_face_size(level, face);
    const int32_t index = k == 0 ? 0 : k == size - 1 ? size - 3 : k - 1;
    const otx_facet facet = otx_facet_at(level, face, index);

    *side = otx_facet_side(&facet, k);
    return facet;
}

#endif
