/* singularity.h -- where a direction field has no direction.
 *
 * Going once round a vertex, the field turns by 2 pi times the vertex's index,
 * a multiple of 1 / symmetry. On a closed surface the indices sum to its Euler
 * characteristic (Poincare-Hopf), whatever the field. */
#ifndef OTX_FIELD_SINGULARITY_H
#define OTX_FIELD_SINGULARITY_H

#include "field/direction.h"

typedef struct otx_singularity
{
    int32_t vertex;
    int32_t turns; /* index * symmetry: a whole number, not 0 */
} otx_singularity;

typedef struct otx_singularity_list
{
    int32_t count;
    const otx_singularity *items; /* ascending vertices */
} otx_singularity_list;

/* In run->arena. Vertices at boundaries and holes have no index. MEMORY. */
otx_status otx_singularity_find(
    otx_run *run, const otx_direction *field, otx_singularity_list *out);

#endif
