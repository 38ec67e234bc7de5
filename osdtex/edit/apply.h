/* apply.h -- one edit of a mapping: constraints that act on an area alone. */
#ifndef OTX_EDIT_APPLY_H
#define OTX_EDIT_APPLY_H

#include "method/method.h"

typedef struct otx_edit
{
    /* Its surface, exemplars, scale and settings are those of the mapping;
     * random numbers are drawn from its run's seed and the edit. */
    const otx_job *job;
    const otx_method *method;      /* that made the mapping */
    const otx_constraint_set *set; /* all that has been asked so far */
    int32_t number;                /* of the edit, from 1 */
} otx_edit;

/* Makes the mapping that the edit turns `from` into. Outside of the area UVs,
 * patches, directions and sizes are the same to the bit. What it cannot follow
 * (a direction where the exemplar has none) is told by a warning.
 *
 *   from  on job->surface or a copy of it with a density
 *   out   in run->arena, all of it
 *
 * ARGUMENT for a constraint that cannot be held, SUPPORT for a mapping that
 * cannot be made anew in part; NUMERIC, LIMIT, MEMORY, CANCELLED. */
otx_status
otx_edit_apply(const otx_edit *edit, const otx_mapping *from, otx_mapping *out);

/* Whether a mapping can be made anew in part. SUPPORT, saying why not. */
otx_status otx_edit_check(
    otx_run *run, const otx_method *method, const otx_mapping *mapping,
    const otx_exemplar *exemplars);

/* A mapping that shares nothing with `from` but its surface and where that has
 * a density its cage and levels: what edits begin with. MEMORY. */
otx_status
otx_edit_copy(otx_run *run, const otx_mapping *from, otx_mapping *out);

#endif
