/* texture_file.h -- an exemplar, or what was made of one, as a texture file. */
#ifndef OTX_EXPORT_TEXTURE_FILE_H
#define OTX_EXPORT_TEXTURE_FILE_H

#include "exemplar/exemplar.h"
#include "file/atomic_file.h"

/* What the names of its texture files end in: ".exr" or ".png". */
const char *otx_texture_file_extension(const otx_exemplar *exemplar);

/* colorInteropID of the pixels in its texture files, NULL unknown. */
const char *otx_texture_file_interop_id(const otx_exemplar *exemplar);

/* Writes `image`, in linear Rec.709, as an 8-bit sRGB PNG of `set`, its colour
 * no longer multiplied by alpha. NUMERIC, IO, MEMORY. */
otx_status otx_texture_file_write_png(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image);

/* Writes `image`, made of `exemplar`, as the texture `path` of `set`. As a PNG
 * where the exemplar's receiver wants that; else as a tiled, mip-mapped EXR
 * with its colour attributes. Where `layout` divides it into tiles, mip levels
 * keep them apart and the layout goes into the attribute osdtex:tiles; where
 * it does not (cell 0), the picture wraps as the exemplar does.
 *
 * ARGUMENT, NUMERIC, IO, MEMORY. */
otx_status otx_texture_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, const otx_image *image,
    const otx_tile_layout *layout);

#endif
