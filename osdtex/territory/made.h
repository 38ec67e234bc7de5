/* made.h -- what was made of charts' texels, as a field of sources. */
#ifndef OTX_TERRITORY_MADE_H
#define OTX_TERRITORY_MADE_H

#include "territory/target.h"

/* Faces with a texel that was made show what their owner's texels say, in
 * run->arena; others show their UVs. MEMORY. */
otx_status
otx_made_hand_out(const otx_target_set *set, const otx_source_field **out);

#endif
