/* keep_call.h -- a mapping made from one that is to be kept. */
#ifndef OTX_API_KEEP_CALL_H
#define OTX_API_KEEP_CALL_H

#include "api/handle.h"

/* Sets the options that a kept mapping decides, where they are open: method,
 * scale, level. ARGUMENT where they say something else, or ask for what an edit
 * is for. */
otx_status otx_keep_call_options(
    otx_run *run, const osdtex_mapping *keep, osdtex_map_options *options);

/* Makes handle->mapping, on the handle's surface, of the mapping `keep`.
 * ARGUMENT for another cage's faces or other exemplars, SUPPORT. */
otx_status otx_keep_call_run(
    otx_run *run, const osdtex_mapping *keep, osdtex_mapping *handle);

#endif
