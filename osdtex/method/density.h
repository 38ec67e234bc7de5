/* density.h -- a surface on which the texture has sizes of its own. */
#ifndef OTX_METHOD_DENSITY_H
#define OTX_METHOD_DENSITY_H

#include "field/constraint.h"

/* Sets *out to `surface`, with the density that the scales among the
 * constraints ask for: as a copy in run->arena that borrows all else, or
 * `surface` itself where they ask for none. ARGUMENT for constraints that
 * cannot be held, NUMERIC, MEMORY. */
otx_status otx_density_apply(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, const otx_surface **out);

#endif
