/* island.h -- where the UVs of a scene are cut, and what hangs together. */
#ifndef OTX_RENDER_ISLAND_H
#define OTX_RENDER_ISLAND_H

#include "render/scene.h"

/* Corner c stands for the edge from it to the next corner of its face.
 *
 *   twin  [corner_count] the corner of the face across, -1 at a boundary.
 *         Where more than two faces meet, they pair off in their order.
 *
 * Made in `arena`. LIMIT, MEMORY. */
otx_status otx_island_pair(
    otx_run *run, otx_arena *arena, const otx_scene *scene,
    const int32_t **twin);

/* 1 where an edge is a seam: the patches differ; without patches, the UVs
 * jump by more than a whole number of wraps. Boundaries are no seams.
 *
 *   seam  [corner_count], made in `arena`. MEMORY. */
otx_status otx_island_seams(
    otx_run *run, otx_arena *arena, const otx_scene *scene, const int32_t *twin,
    const uint8_t **seam);

/* Numbers the sets of faces that are joined by edges that are no seams, from 0
 * in the order of their first face.
 *
 *   label  [face_count], made in `arena`. MEMORY. */
otx_status otx_island_label(
    otx_run *run, otx_arena *arena, const otx_scene *scene, const int32_t *twin,
    const uint8_t *seam, const int32_t **label);

#endif
