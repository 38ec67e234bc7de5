/* place_call.h -- a mapping with pictures placed over it. */
#ifndef OTX_API_PLACE_CALL_H
#define OTX_API_PLACE_CALL_H

#include "api/call.h"
#include "api/handle.h"

/* Places what the file at `path` asks for over handle->mapping, which may be
 * saved without; NULL: nothing. Pictures are written in the space of the first
 * exemplar.
 *
 * As otx_place_file_read, otx_place_all and osdtex_exemplar_read. */
otx_status
otx_place_call(otx_call *call, const char *path, osdtex_mapping *handle);

/* How a picture was read, and is to be read again. */
typedef struct otx_place_picture
{
    const char *path, *from; /* from: NULL: by the stated rules */
} otx_place_picture;

/* Reads the pictures of decals into the call's arena, and makes their textures.
 *
 *   like         whose spaces they are written and compared in
 *   linear_only  what is compared is not made */
otx_status otx_place_call_pictures(
    otx_call *call, const otx_place_picture *list, int32_t count,
    const otx_exemplar *like, bool linear_only, otx_decals *out);

#endif
