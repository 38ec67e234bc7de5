/* saved_constraints.h -- what was asked of the field, in a saved mapping. */
#ifndef OTX_API_SAVED_CONSTRAINTS_H
#define OTX_API_SAVED_CONSTRAINTS_H

#include "field/constraint.h"

#include <jansson.h>

/* An object as constraint files are (docs/formats-constraints.md); null where
 * nothing was asked. NULL when memory is out. */
json_t *otx_saved_constraints_print(const otx_constraint_set *set);

#endif
