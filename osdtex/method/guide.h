/* guide.h -- a direction for every leaf face, and how the exemplar is to lie.
 *
 * Patches of an exemplar that has a direction are turned so that it follows a
 * field on the surface. See docs/notes/field.md. */
#ifndef OTX_METHOD_GUIDE_H
#define OTX_METHOD_GUIDE_H

#include "analysis/analysis.h"
#include "field/constraint.h"
#include "mapping/mapping.h"

/* Solves for the field that `constraints` ask for (NULL: the smoothest), of
 * the exemplar's symmetry. In run->arena. */
otx_status otx_guide_make(
    otx_run *run, const otx_surface *surface, const otx_analysis *analysis,
    const otx_constraint_set *constraints, otx_guide *out);

/* Hands the field of a coarser level to the leaves. */
otx_status otx_guide_from_field(
    otx_run *run, const otx_direction *field, double angle, otx_guide *out);

#endif
