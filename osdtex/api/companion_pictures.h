/* companion_pictures.h -- the other maps of a material, from their files. */
#ifndef OTX_API_COMPANION_PICTURES_H
#define OTX_API_COMPANION_PICTURES_H

#include "api/call.h"
#include "exemplar/exemplar.h"

/* Reads the maps of `options` onto the picture of an exemplar that has just
 * been read, and says what each is. ARGUMENT, FORMAT, what reading a picture
 * returns, MEMORY. */
otx_status otx_companion_pictures_take(
    otx_call *call, const osdtex_exemplar_options *options,
    otx_exemplar *exemplar);

/* Makes what is compared hold the maps that `options` want matched. ARGUMENT,
 * MEMORY. */
otx_status otx_companion_pictures_match(
    otx_run *run, const osdtex_exemplar_options *options,
    otx_exemplar *exemplar);

#endif
