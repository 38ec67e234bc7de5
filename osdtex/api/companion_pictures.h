/* companion_pictures.h -- the other maps of a material, from their files. */
#ifndef OTX_API_COMPANION_PICTURES_H
#define OTX_API_COMPANION_PICTURES_H

#include "api/call.h"
#include "exemplar/match_maps.h"

/* Reads the maps of `options` onto the picture of an exemplar that has just
 * been read, and says what each is; `out` is left where there are none.
 * ARGUMENT, FORMAT, what reading a picture returns, MEMORY. */
otx_status otx_companion_pictures_take(
    otx_call *call, const osdtex_exemplar_options *options,
    const otx_exemplar *exemplar, otx_companions *out);

/* What `options` want matched, colour and maps. */
otx_match_weights
otx_companion_pictures_weights(const osdtex_exemplar_options *options);

#endif
