/* vote.h -- the colours that windows agree on.
 *
 * Every window that covers a texel says what its match shows there; the texel
 * becomes their mean, weighted by how good they are and how near their middles
 * [Wexler07, eq. 6]: vote.c. Then lightness is drawn to the exemplar's:
 * histogram.c. */
#ifndef OTX_SYNTH_VOTE_H
#define OTX_SYNTH_VOTE_H

#include "synth/canvas.h"

/* Sets the trust of all windows from their costs: exp(-cost / 2 s), where s is
 * the 75th percentile over all canvases. `even`: all alike. MEMORY. */
otx_status otx_vote_trust(
    otx_run *run, otx_canvas *const *canvases, int32_t count, bool even);

/* Makes the colours of FREE and COLLAR texels, and says which have changed.
 * CANCELLED, MEMORY. */
otx_status
otx_vote_cast(otx_run *run, otx_canvas *const *canvases, int32_t count);

/* Draws L of all FREE texels to the distribution that it has in the pattern's
 * level, by `share` of the way. MEMORY. */
otx_status otx_vote_match_histogram(
    otx_run *run, otx_canvas *const *canvases, int32_t count, double share);

#endif
