/* stitch.h -- what each patch can show, and where it is cut and bent. */
#ifndef OTX_PATCH_STITCH_H
#define OTX_PATCH_STITCH_H

#include "patch/mosaic.h"

/* Cuts between all patches where their pictures agree, frees the
 * charts, and relaxes what is left. */
otx_status otx_stitch_run(otx_mosaic *m);

#endif
