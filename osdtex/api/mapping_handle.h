/* mapping_handle.h -- what a mapping is written with. */
#ifndef OTX_API_MAPPING_HANDLE_H
#define OTX_API_MAPPING_HANDLE_H

#include "api/handle.h"
#include "export/model.h"

/* What a mesh is written with. */
otx_model_options
otx_mapping_handle_model_options(const osdtex_write_options *options);

#endif
