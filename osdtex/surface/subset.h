/* subset.h -- some of the leaf faces of a surface, as a surface of its own.
 *
 * Work that concerns a small part of a large surface costs what the part does
 * when it is done on a surface that has nothing else. */
#ifndef OTX_SURFACE_SUBSET_H
#define OTX_SURFACE_SUBSET_H

#include "surface/surface.h"

/* Faces, vertices and edges keep their order. */
typedef struct otx_subset
{
    otx_surface surface;    /* one level; its cage is the whole surface's, and
                             * face_cage names faces of that */
    const int32_t *faces;   /* [face_count] of the whole leaf level */
    const int32_t *corners; /* [corner_count] likewise */
    const int32_t *verts;   /* [vert_count] likewise */
} otx_subset;

/* Takes the marked leaf faces. Edges to faces that are not taken are its
 * boundary. UVs of the cage are left out. In run->arena; temporaries grow with
 * the whole leaf level, all else with the part. MEMORY.
 *
 *   taken  [leaf face_count], not 0: taken; at least one is */
otx_status otx_subset_take(
    otx_run *run, const otx_surface *surface, const uint8_t *taken,
    otx_subset *out);

/* Adds to the marked leaf faces those within `reach` scene units along the
 * surface, from centre to centre, holes left out; they are marked with
 * `mark`.
 *
 *   marked  [leaf face_count], in and out: 0 not yet, others are where it
 *           starts
 *
 * CANCELLED, MEMORY. */
otx_status otx_subset_widen(
    otx_run *run, const otx_surface *surface, double reach, uint8_t mark,
    uint8_t *marked);

#endif
