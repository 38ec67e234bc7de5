/* whole.h -- pastes of whole features: stones, leaves, scales.
 *
 * Of what lies under a chart those features are kept that are whole there and
 * do not lie on others more than the mode lets them. Each is a piece with an
 * outline of its own. */
#ifndef OTX_METHOD_LAPPED_WHOLE_H
#define OTX_METHOD_LAPPED_WHOLE_H

#include "method/lapped/lapped.h"

/* Finds what the exemplar shows, unless pieces are to be splotches, and settles
 * the mode; says which and why. In run->arena. MEMORY. */
otx_status otx_lapped_find_features(otx_lapped *l, otx_analysis_class kind);

/* Whether the mode is one of features. */
static inline bool
otx_lapped_is_whole(const otx_lapped *l)
{
    return l->settings.mode == OTX_LAPPED_CLUMPS ||
           l->settings.mode == OTX_LAPPED_PACKING ||
           l->settings.mode == OTX_LAPPED_ORDERED;
}

/* How far from its seed a paste of features may reach, texels. */
double otx_lapped_whole_reach(const otx_lapped *l);

/* Within this of a seed another try would come to the same, texels. */
double otx_lapped_whole_spacing(const otx_lapped *l);

/* A try to lay features down. */
typedef struct otx_lapped_try
{
    uint64_t number;     /* of the try: what its random numbers are for */
    double size;         /* of features: 1 as the exemplar has them */
    double height;       /* of the seed along what orders features, texels */
    const int32_t *uses; /* [features.count] in pastes before */
} otx_lapped_try;

/* Chooses where in the exemplar a chart lies and what is kept; may turn the
 * chart and change its size. paste->piece_count is 0 where nothing fits.
 * MEMORY, without a finding. */
otx_status otx_lapped_choose_features(
    const otx_lapped *l, otx_arena *arena, const otx_lapped_try *attempt,
    otx_lapped_paste *paste);

#endif
