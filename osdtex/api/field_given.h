/* field_given.h -- a field that the host has, as the library keeps one. */
#ifndef OTX_API_FIELD_GIVEN_H
#define OTX_API_FIELD_GIVEN_H

#include "api/handle.h"

/* The arrays of the options, on the leaves of a surface, in run->arena; nothing
 * where there are none.
 *
 *   connection  of the leaf level
 *   symmetry    of the field
 *
 * ARGUMENT for another count of elements than the surface has, and numbers that
 * are not finite or, of scales, outside 1/16 .. 16. */
otx_status otx_field_given_read(
    otx_run *run, const otx_connection *connection, int32_t symmetry,
    const osdtex_field_options *options, otx_constraint_field *out);

/* The constraints that make a mapping follow a field: its directions and sizes
 * as they are, and what it was asked of exemplars. */
otx_status otx_field_given_constraints(
    otx_run *run, const osdtex_field *field, const otx_constraint_set **out);

#endif
