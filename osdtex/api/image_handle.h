/* image_handle.h -- pixels that a stage made, as a handle. */
#ifndef OTX_API_IMAGE_HANDLE_H
#define OTX_API_IMAGE_HANDLE_H

#include "api/handle.h"

/* `image` must be in run->arena, which the handle takes over. MEMORY. */
otx_status
otx_image_handle_wrap(otx_run *run, otx_image image, osdtex_image **out);

#endif
