/* several.h -- the exemplars of a mapping, and where each goes. */
#ifndef OTX_API_SEVERAL_H
#define OTX_API_SEVERAL_H

#include "api/handle.h"

/* Checks the exemplars that the options name, and sets what the handle says of
 * them; its first exemplar, scale and constraints are there. ARGUMENT, FORMAT,
 * IO, LIMIT, NUMERIC, SUPPORT, MEMORY. */
otx_status otx_several_take(
    otx_run *run, const osdtex_map_options *options, osdtex_mapping *handle);

#endif
