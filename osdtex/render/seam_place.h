/* seam_place.h -- where seams show, edge by edge and place by place.
 *
 * A seam is as bad as its colour difference times its length. What lies in one
 * cell of a grid across the model is found by the eye as one place, however
 * many edges it has. Colours are compared as square roots, about as they are
 * seen. */
#ifndef OTX_RENDER_SEAM_PLACE_H
#define OTX_RENDER_SEAM_PLACE_H

#include "render/scene.h"

enum
{
    OTX_SEAM_PLACES_MAX = 99
};

/* The edge from a corner to the next of its face. */
typedef struct otx_seam_edge
{
    int32_t corner;   /* the smaller one of the two that the edge has */
    float difference; /* 0 .. 1: black beside white; RMS along it */
} otx_seam_edge;

typedef struct otx_seam_place
{
    otx_vec3 point, normal; /* middle of what shows; the normal is unit */
    double length;          /* of its seams, scene units */
    double difference;      /* mean of them */
} otx_seam_place;

typedef struct otx_seam_places
{
    int32_t edge_count, count;
    const otx_seam_edge *edges;   /* [edge_count], in the order of corners */
    const otx_seam_place *places; /* [count], the worst first */
    double cell;                  /* width of the grid's cells */
} otx_seam_places;

/* All seams of a scene, and up to `most` places that lie apart: cells beside
 * one that is listed are in the same picture, and pass. None of either where
 * there is no texture. Made in `arena`.
 *
 *   most  0 .. OTX_SEAM_PLACES_MAX
 *
 * CANCELLED, LIMIT, MEMORY. */
otx_status otx_seam_places_find(
    otx_run *run, otx_arena *arena, const otx_scene *scene, int32_t most,
    otx_seam_places *out);

#endif
