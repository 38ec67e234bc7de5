/* area.h -- where an edit takes effect. */
#ifndef OTX_EDIT_AREA_H
#define OTX_EDIT_AREA_H

#include "field/constraint.h"

/* The faces that the constraints of an edit may change: those that they hold,
 * and what lies within reach of them along the surface.
 *
 *   edit   its number in the set
 *   reach  scene units, of constraints that name none
 *   area   [leaf face_count], in and out: marked with 1
 *
 * ARGUMENT for a constraint that cannot be held, MEMORY. */
otx_status otx_area_find(
    otx_run *run, const otx_surface *surface, const otx_constraint_set *set,
    int32_t edit, double reach, uint8_t *area);

/* The leaf faces that a constraint holds: those of its face of the cage, or
 * around its point at least the nearest. Ascending, in run->scratch. MEMORY. */
otx_status otx_area_hold(
    otx_run *run, const otx_surface *surface, const otx_constraint *item,
    int32_t **faces, int32_t *count);

#endif
