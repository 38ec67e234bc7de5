/* dislocation.h -- dislocations that meet their opposite and vanish.
 *
 * Before coordinates are fitted, dislocations that lie close together are
 * joined: a step across each edge between one and its opposite takes a cell
 * more, and both are gone. */
#ifndef OTX_PERIODIC_DISLOCATION_H
#define OTX_PERIODIC_DISLOCATION_H

#include "periodic/phase_edge.h"

/* Changes whole cells so that dislocations closer than request->cancel to
 * their opposite, to a singularity or to a border vanish. Counts them. MEMORY.
 */
otx_status otx_dislocation_cancel(otx_phase_solver *s);

#endif
