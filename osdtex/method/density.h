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

/* What constraints ask of a scalar field, at the leaf vertices: harmonic
 * between them on a level of moderate size, by means of edges and faces from
 * there.
 *
 *   out  [leaf vert_count] in run->scratch
 *
 * As above. */
otx_status otx_density_spread(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, otx_constraint_kind kind,
    double **out);

#endif
