/* weld.h -- vertices that lie in one place.
 *
 * Exporters split vertices at hard edges and UV seams, and some write every
 * face with vertices of its own. Such a cage looks closed and is not: it
 * subdivides into separate pieces. */
#ifndef OTX_SURFACE_WELD_H
#define OTX_SURFACE_WELD_H

#include "base/arena.h"
#include "surface/topology.h"

/* What distance is meant where none is said, as a share of the diagonal of the
 * box: what the shortest decimals that exporters print leave of one place. */
#define OTX_WELD_SHARE 1e-6

/* For every vertex the first one within `distance` of it (itself, when there is
 * none before it). Chains do not add up: all lie within the distance of a
 * vertex that stays. In vertex order, so that the result is the same
 * everywhere.
 *
 *   among  [vert_count] which vertices count, others stay; NULL: all
 *
 * NULL when memory is out. */
int32_t *otx_weld_find(
    otx_arena *arena, const float *points, int32_t vert_count,
    const uint8_t *among, double distance);

/* Edges at which the mesh is open although another open edge lies in the same
 * place, the other way round: what welding would close. */
typedef struct otx_weld_gaps
{
    int32_t vert_count;  /* vertices at such edges */
    int32_t place_count; /* places that they lie at */
    int32_t first;       /* the first of them; -1 none */
} otx_weld_gaps;

/* False when memory is out; what is made lies in `arena`. */
bool otx_weld_find_gaps(
    otx_arena *arena, const otx_topology *topology, const float *points,
    double distance, otx_weld_gaps *out);

#endif
