/* exemplar_names.h -- exemplars that constraints name. */
#ifndef OTX_API_EXEMPLAR_NAMES_H
#define OTX_API_EXEMPLAR_NAMES_H

#include "exemplar/exemplar.h"
#include "field/constraint.h"

/* Gives every constraint that names an exemplar by its file the number instead.
 * A name is the file's, with or without folder or extension.
 *
 *   exemplars  [count]
 *   set        NULL allowed; replaced by a copy in run->arena
 *
 * ARGUMENT, with the constraint, for a name or number that no exemplar or more
 * than one has; MEMORY. */
otx_status otx_exemplar_names_resolve(
    otx_run *run, const otx_exemplar *exemplars, int32_t count,
    const otx_constraint_set **set);

#endif
