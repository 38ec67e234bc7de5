/* mapping_handle.h -- what a mapping tells of itself. */
#ifndef OTX_API_MAPPING_HANDLE_H
#define OTX_API_MAPPING_HANDLE_H

#include "api/handle.h"
#include "export/model.h"

/* Of a handle that is complete but for its info. */
osdtex_mapping_info otx_mapping_handle_info(const osdtex_mapping *handle);

/* What a mesh is written with. */
otx_model_options
otx_mapping_handle_model_options(const osdtex_write_options *options);

#endif
