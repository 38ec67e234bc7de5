/* keep_call.h -- a mapping made from one that is to be kept. */
#ifndef OTX_API_KEEP_CALL_H
#define OTX_API_KEEP_CALL_H

#include "api/handle.h"

/* Sets the options that a kept mapping decides, where they are open: method,
 * scale. ARGUMENT where they say something else, or ask for what an edit
 * is for. */
otx_status otx_keep_call_options(
    otx_run *run, const osdtex_mapping *keep, osdtex_map_options *options);

/* The level of the mapping, of a cage of other faces that with leaf edges of
 * about the same length, where it is OSDTEX_LEVEL_AUTO. MEMORY. */
otx_status otx_keep_call_level(
    otx_run *run, const osdtex_mapping *keep, const osdtex_cage *cage,
    int32_t *level);

/* Makes handle->mapping, on the handle's surface, of the mapping `keep`: by
 * their numbers where leaf faces are the same, else by where they lie. ARGUMENT
 * for other exemplars, SUPPORT. */
otx_status otx_keep_call_run(
    otx_run *run, const osdtex_mapping *keep, osdtex_mapping *handle);

#endif
