/* openness.h -- how much of the sky the vertices of a surface see. */
#ifndef OTX_RENDER_OPENNESS_H
#define OTX_RENDER_OPENNESS_H

#include "base/run.h"
#include "surface/surface.h"

/* Of an even sky's light on each leaf vertex, what the surface itself lets
 * through within .8 of its radius.
 *
 *   out  [leaf vert_count] from 0, hidden, to 1, open
 *
 * CANCELLED, MEMORY; NUMERIC where the surface cannot be traced. */
otx_status otx_openness(otx_run *run, const otx_surface *surface, double *out);

#endif
