/* carry_decals.h -- pictures that lie over a mapping, on a surface of other
 * faces. */
#ifndef OTX_EDIT_CARRY_DECALS_H
#define OTX_EDIT_CARRY_DECALS_H

#include "edit/project.h"

/* The decals of project->from on the leaves of project->to, each where it lies
 * on the old surface. Pictures are borrowed.
 *
 *   projected  of the same project
 *   out        in run->arena; NULL where there are none
 *
 * MEMORY. */
otx_status otx_carry_decals(
    otx_run *run, const otx_project *project, const otx_projected *projected,
    const otx_decals **out);

#endif
