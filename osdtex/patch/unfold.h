/* unfold.h -- no face of a finished mapping is turned inside out. */
#ifndef OTX_PATCH_UNFOLD_H
#define OTX_PATCH_UNFOLD_H

#include "patch/cover.h"

/* Gives each face with area that is reversed, or has a corner that
 * is, its own shape and a patch of its own. */
void otx_unfold(const otx_mosaic_job *job, otx_cover *cover);

#endif
