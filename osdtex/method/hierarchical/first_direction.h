/* first_direction.h -- the direction of the user's first patch, for a field. */
#ifndef OTX_METHOD_HIERARCHICAL_FIRST_DIRECTION_H
#define OTX_METHOD_HIERARCHICAL_FIRST_DIRECTION_H

#include "method/method.h"

/* The constraints with the direction of the first patch among them, so that a
 * field which patches follow has it too: where the patch shows exemplar k and
 * they say nothing of its face.
 *
 *   angle  of the exemplar, as of otx_guide
 *   out    the request's own or a copy in run->arena; NULL none */
otx_status otx_first_constrain(
    otx_run *run, const otx_surface *surface, const otx_map_request *request,
    int32_t k, double angle, const otx_constraint_set **out);

#endif
