/* figures.h -- the numbers beside the picture. */
#ifndef OTX_STUDIO_FIGURES_H
#define OTX_STUDIO_FIGURES_H

#include "studio/snapshot.h"

/* A new object: "faces", "patches", "method", "scale", what the exemplar is,
 * and figures of the report; NULL when it was cancelled or memory is out. */
json_t *otx_figures_of(osdtex_context *context, const otx_snapshot *snapshot);

#endif
