/* exemplar_slices.h -- the pictures of a stack, for its exemplar. */
#ifndef OTX_API_EXEMPLAR_SLICES_H
#define OTX_API_EXEMPLAR_SLICES_H

#include "api/call.h"
#include "exemplar/exemplar.h"

/* Reads slices 0 .. count - 1 of the stack at `path` in the way that `how`
 * built `like`, the exemplar of one of them. ARGUMENT where a slice has another
 * size, IO, FORMAT, MEMORY. */
otx_status otx_exemplar_slices_read(
    otx_call *call, const char *path, int32_t count,
    const otx_exemplar_input *how, const otx_exemplar *like,
    const otx_exemplar_slices **out);

#endif
