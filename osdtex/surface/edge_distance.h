/* edge_distance.h -- how far vertices are from boundaries or creases. */
#ifndef OTX_SURFACE_EDGE_DISTANCE_H
#define OTX_SURFACE_EDGE_DISTANCE_H

#include "base/run.h"
#include "surface/surface.h"

typedef enum otx_edge_kind
{
    OTX_EDGE_BOUNDARY, /* one face, or one beside a hole */
    OTX_EDGE_CREASE    /* lies on an edge of the cage with a sharpness, and not
                        * between holes alone */
} otx_edge_kind;

/* Marks the edges of the leaf level of a kind.
 *
 *   out    [leaf edge_count] in run->scratch, 1 marked
 *   count  of those marked
 *
 * MEMORY. */
otx_status otx_edge_mark(
    otx_run *run, const otx_surface *surface, otx_edge_kind kind, uint8_t **out,
    int32_t *count);

/* How far each leaf vertex is from a marked edge, along edges and across the
 * diagonals of faces, but not over holes; INFINITY where there is no way.
 *
 *   marked  [leaf edge_count]
 *   out     [leaf vert_count] scene units
 *
 * CANCELLED, MEMORY. */
otx_status otx_edge_distance(
    otx_run *run, const otx_surface *surface, const uint8_t *marked,
    double *out);

#endif
