/* patchwork.h -- small patches over the worst of the seams.
 *
 * Where a seam costs most, what is there is looked up in the exemplar, and the
 * best finds are offered by an expansion move: after [Kwatra03, sec. 3.3].
 * Nothing is changed unless the seams become cheaper. */
#ifndef OTX_QUILT_PATCHWORK_H
#define OTX_QUILT_PATCHWORK_H

#include "quilt/patch_search.h"
#include "quilt/quilt.h"

typedef struct otx_patchwork_options
{
    int32_t spots;   /* that are looked at, at most */
    int32_t patches; /* that are offered at each */
} otx_patchwork_options;

/* Mends `quilt`, which is larger than the patches. Their texels are put in
 * run->arena. */
otx_status otx_patchwork_mend(
    otx_run *run, const otx_patch_search *search,
    const otx_patchwork_options *options, otx_quilt *quilt);

#endif
