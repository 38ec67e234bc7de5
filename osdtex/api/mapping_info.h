/* mapping_info.h -- what a mapping tells of itself. */
#ifndef OTX_API_MAPPING_INFO_H
#define OTX_API_MAPPING_INFO_H

#include "api/handle.h"

/* Of a handle that is complete but for its info. */
osdtex_mapping_info otx_mapping_info_of(const osdtex_mapping *handle);

#endif
