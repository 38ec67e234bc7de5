/* straighten.h -- triangles without area that came out reversed. */
#ifndef OTX_PATCH_STRAIGHTEN_H
#define OTX_PATCH_STRAIGHTEN_H

#include "patch/cover.h"

/* Sets right triangles without area that came out reversed, as
 * far as no other face suffers. */
otx_status otx_straighten(const otx_mosaic_job *job, otx_cover *cover);

#endif
