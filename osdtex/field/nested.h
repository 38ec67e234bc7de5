/* nested.h -- direction fields on fine levels, in time linear in their faces.
 *
 * A coarse level is solved directly; each finer one begins with what its
 * parent found and is smoothed, which is all that is left to do there. */
#ifndef OTX_FIELD_NESTED_H
#define OTX_FIELD_NESTED_H

#include "field/direction.h"

/* As otx_direction_solve, which it is on levels of a moderate number of
 * faces, and on level 0. */
otx_status otx_nested_solve(
    otx_run *run, const otx_connection *connection,
    const otx_direction_request *request, otx_direction *out);

#endif
