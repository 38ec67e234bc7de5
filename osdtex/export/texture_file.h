/* texture_file.h -- an exemplar, or what was made of one, as a texture file. */
#ifndef OTX_EXPORT_TEXTURE_FILE_H
#define OTX_EXPORT_TEXTURE_FILE_H

#include "file/atomic_file.h"
#include "image/exemplar.h"

/* Writes `image` as the tiled, mip-mapped EXR `path` of `set`, with the colour
 * attributes of `exemplar`. Where `layout` divides it into tiles, mip levels
 * keep them apart and the layout goes into the attribute osdtex:tiles; where
 * it does not (cell 0), the picture wraps as the exemplar does.
 *
 * ARGUMENT, NUMERIC, IO, MEMORY. */
otx_status otx_texture_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, const otx_image *image,
    const otx_tile_layout *layout);

#endif
