/* guides.h -- the fields that patches follow, and the sizes they have. */
#ifndef OTX_METHOD_HIERARCHICAL_GUIDES_H
#define OTX_METHOD_HIERARCHICAL_GUIDES_H

#include "method/method.h"

/* A field for each exemplar that has a direction; the job's own for the first,
 * where it has one. Notes what each was taken for.
 *
 *   guides  [job->exemplar_count] zeros, in; without directions, out: patches
 *           follow none */
otx_status otx_guides_make(
    const otx_job *job, const otx_surface *surface, otx_guide *guides);

/* The surface with the sizes that the constraints ask for, or the job's own
 * where they ask for none, or where the published method has one size. */
otx_status otx_guides_density(const otx_job *job, const otx_surface **surface);

#endif
