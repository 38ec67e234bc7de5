/* figures.h -- the numbers beside the picture. */
#ifndef OTX_STUDIO_FIGURES_H
#define OTX_STUDIO_FIGURES_H

#include "studio/snapshot.h"

/* A new object of what the picture is told with, on which the tools of the page
 * depend: "method", "faces", "patches", "scale", "slices" of the exemplar, and
 * the "places" where seams show most; NULL when memory is out. */
json_t *otx_figures_facts(const otx_snapshot *snapshot);

/* A new object of what takes longer, and comes later: "class" and "symmetry" of
 * the exemplar, and "rows" of the report; NULL when it was cancelled or memory
 * is out. */
json_t *otx_figures_of(osdtex_context *context, const otx_snapshot *snapshot);

#endif
