/* outline.h -- where a picture can be cut without cutting what it shows.
 *
 * Stones, bricks and spots have outlines. A border between two exemplars that
 * keeps to the mortar, or to the ground between spots, leaves them whole. See
 * docs/notes/mask.md. */
#ifndef OTX_ANALYSIS_OUTLINE_H
#define OTX_ANALYSIS_OUTLINE_H

#include "exemplar/exemplar.h"

/* How deep inside a feature each texel lies, 0 to 1: 0 on outlines and what is
 * narrow between them. Where one area takes most of the picture and reaches
 * round everything else, it is the ground: 0 away from outlines, and features
 * are 1.
 *
 *   out  one channel, in run->scratch; the picture halved until its sides are
 *        340 texels at most
 *
 * MEMORY. */
otx_status
otx_outline_find(otx_run *run, const otx_exemplar *exemplar, otx_image *out);

#endif
