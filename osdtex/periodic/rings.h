/* rings.h -- where periodic coordinates are no texture coordinates.
 *
 * The ring of faces around a vertex is singular [Ray09, sec. 3] if in one of
 * its faces the gradient of a coordinate departs from what was asked for by
 * more than half, squared, or if two of its faces do not agree on the step
 * along their common edge. The paper leaves out that the first is relative to
 * the gradient's own square, and tells faces of either sense apart. */
#ifndef OTX_PERIODIC_RINGS_H
#define OTX_PERIODIC_RINGS_H

#include "periodic/phase.h"

enum
{
    OTX_RING_DISTORTED = 1,
    OTX_RING_MISMATCHED = 2
};

typedef struct otx_rings
{
    uint8_t *singular; /* [vert_count] of the phase's level: 0, or by which of
                        * the criteria */
    int32_t count;     /* vertices that are not 0 */
} otx_rings;

/* Of coordinates, before or after whole cells are taken off. In run->arena.
 * MEMORY. */
otx_status otx_rings_find(
    otx_run *run, const otx_phase *phase, const otx_phase_request *request,
    otx_rings *out);

#endif
