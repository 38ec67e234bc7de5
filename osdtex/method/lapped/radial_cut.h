/* radial_cut.h -- what of a texture patch is pasted: a closed path round its
 * middle along which it differs least from what lies there.
 *
 * The paper blends over a ramp, which shows two pictures at once. A path along
 * equal colours with a narrow feather does not [Kwatra03], and as a closed
 * radial one it is found by dynamic programming at a thirtieth of a maximum
 * flow's time. */
#ifndef OTX_METHOD_LAPPED_RADIAL_CUT_H
#define OTX_METHOD_LAPPED_RADIAL_CUT_H

#include "method/lapped/lapped.h"

/* Draws the outline of a paste in: `outline` is the furthest that it goes. Its
 * pieces are not looked at. MEMORY, without a finding. */
otx_status otx_lapped_cut(
    const otx_lapped *l, otx_arena *scratch, const otx_radial *outline,
    const otx_lapped_paste *paste, otx_radial *out);

#endif
