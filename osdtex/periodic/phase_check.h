/* phase_check.h -- what holds of periodic coordinates once they are solved for.
 *
 * Builds with assertions check all that are. */
#ifndef OTX_PERIODIC_PHASE_CHECK_H
#define OTX_PERIODIC_PHASE_CHECK_H

#include "periodic/phase.h"

/* NULL when the coordinates are sound, else what is not, for assert():
 *
 * - cells are finite;
 * - defects are counted;
 * - across an edge between two faces that are no defects, cells differ by
 *   whole ones and by the senses of the faces. */
const char *otx_phase_check(const otx_phase *phase);

#endif
