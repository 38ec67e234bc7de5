/* phase_fit.h -- periodic coordinates once their whole cells are known.
 *
 * The smallest eigenvector says how many whole cells every step along an edge
 * takes; with these frozen, what is left is an ordinary least squares problem
 * that has no reason to leave any strain near a defect [Ray06, sec. 5]. */
#ifndef OTX_PERIODIC_PHASE_FIT_H
#define OTX_PERIODIC_PHASE_FIT_H

#include "periodic/phase_edge.h"

/* Solves for `turn` with the whole cells of `step` frozen, and renews `step`.
 * NUMERIC, MEMORY. */
otx_status otx_phase_fit(otx_phase_solver *s);

#endif
