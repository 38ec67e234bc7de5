/* given_patches.h -- what is given takes part as patches. */
#ifndef OTX_PATCH_GIVEN_PATCHES_H
#define OTX_PATCH_GIVEN_PATCHES_H

#include "patch/mosaic.h"
#include "relax/cut.h"

/* Takes over what is textured already. */
void otx_given_take(const otx_mosaic_job *job, otx_cover *cover);
/* Whether an edit leaves a leaf face as it is. */
bool otx_given_holds(const otx_mosaic_job *job, int32_t face);
/* What is not textured and asks for an exemplar, as one cluster of leaves, in
 * run->arena; without faces when all is. MEMORY. */
otx_status otx_given_region(
    const otx_mosaic_job *job, const otx_cover *cover, int32_t exemplar,
    otx_cluster *out);
/* The offers of the given patches, which are the first of all. */
otx_status otx_given_offers(const otx_mosaic *m, otx_offer *offers);

#endif
