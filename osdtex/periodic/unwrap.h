/* unwrap.h -- cells that are equal across edges, not only up to whole cells.
 */
#ifndef OTX_PERIODIC_UNWRAP_H
#define OTX_PERIODIC_UNWRAP_H

#include "periodic/phase.h"

/* Makes the cells of neighbours equal, not only equal up to whole cells, as
 * far as defects allow: faces are visited from the one farthest from a defect,
 * so that what jumps remain lie between defects. Faces may change their sense.
 *
 *   distance  [face_count] from the nearest defect */
otx_status
otx_phase_unwrap(otx_run *run, otx_phase *phase, const double *distance);

/* Distance of each face from the nearest marked one, along faces; scene units;
 * INFINITY where none is reached. [face_count] in run->arena. MEMORY. */
otx_status otx_phase_distance(
    otx_run *run, const otx_connection *c, const uint8_t *marked, double **out);

#endif
