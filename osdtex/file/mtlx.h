/* mtlx.h -- a look as a MaterialX document: standard_surface with its maps.
 *
 * The colour space stands at the image, which MTL and OBJ cannot say. */
#ifndef OTX_FILE_MTLX_H
#define OTX_FILE_MTLX_H

#include "file/data_maps.h"

#include "base/run.h"

typedef struct otx_mtlx
{
    const char *name;       /* of the material; made an identifier */
    const char *texture;    /* file name relative to this; may hold <UDIM> */
    const char *interop_id; /* colorInteropID of its pixels; NULL unknown, and
                             * then no colour space is stated */
    otx_data_maps maps;     /* but for occlusion, which standard_surface has no
                             * input for */
} otx_mtlx;

/* Writes `mtlx` to `path`; `title` is for messages (NULL: the path). IO,
 * MEMORY. */
otx_status otx_mtlx_write(
    otx_run *run, const otx_mtlx *mtlx, const char *path, const char *title);

#endif
