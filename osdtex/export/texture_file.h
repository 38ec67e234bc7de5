/* texture_file.h -- an exemplar, or what was made of one, as a texture file. */
#ifndef OTX_EXPORT_TEXTURE_FILE_H
#define OTX_EXPORT_TEXTURE_FILE_H

#include "exemplar/exemplar.h"
#include "file/atomic_file.h"

/* What names of texture files of a type end in: ".exr", ".png", ".tif",
 * ".jpg". */
const char *otx_texture_file_type_extension(otx_texture_type type);
/* The same of an exemplar's. */
const char *otx_texture_file_extension(const otx_exemplar *exemplar);

/* colorInteropID of the pixels in its texture files, NULL unknown. */
const char *otx_texture_file_interop_id(const otx_exemplar *exemplar);

/* Writes `image`, of linear Rec.709, as a PNG, TIFF or JPEG of `set`, whichever
 * the exemplar's type is: with the sRGB curve, unless the exemplar is data, its
 * colour no longer multiplied by alpha. PNG is dithered; JPEG has no alpha,
 * which is said where some is lost. NUMERIC, IO, MEMORY. */
otx_status otx_texture_file_write_integers(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, const otx_image *image);

/* Writes `image`, made of `exemplar`, as the texture `path` of `set`. As
 * integers where the exemplar's type wants that; else as a tiled, mip-mapped
 * EXR with its colour attributes. Where `layout` divides it into tiles, mip
 * levels keep them apart and the layout goes into the attribute osdtex:tiles;
 * where it does not (cell 0), the picture wraps as the exemplar does.
 *
 * ARGUMENT, NUMERIC, IO, MEMORY. */
otx_status otx_texture_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, const otx_image *image,
    const otx_tile_layout *layout);

#endif
