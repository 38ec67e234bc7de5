/* companion_files.h -- the other maps of a material beside its colour. */
#ifndef OTX_EXPORT_COMPANION_FILES_H
#define OTX_EXPORT_COMPANION_FILES_H

#include "exemplar/exemplar.h"
#include "file/atomic_file.h"
#include "file/data_maps.h"
#include "file/exr.h"
#include "surface/level.h"

/* How a map of this kind is written: as data, heights in 32 bits, all others in
 * 16; one channel Y, or of normals R, G, B. */
otx_exr_options otx_companion_files_options(otx_companion_kind kind);

/* What the name of a map beside textures of a type ends in. Heights are no
 * fractions: they stay floats, in an EXR where the type is PNG or JPEG. Other
 * maps are 16-bit integers, in a PNG where it is JPEG, whose losses they cannot
 * bear. */
const char *
otx_companion_files_extension(otx_texture_type type, otx_companion_kind kind);
/* Whether that is an EXR. */
bool otx_companion_files_is_exr(otx_texture_type type, otx_companion_kind kind);

/* "FOLDER/NAME_normal.exr" of "FOLDER/NAME.exr", by the type of the textures;
 * in run->arena; NULL when memory is out. */
const char *otx_companion_files_path(
    otx_run *run, const char *color, otx_texture_type type,
    otx_companion_kind kind);

/* Writes a map that is no EXR as a file of `set`: heights, of one channel and a
 * TIFF, as floats. NUMERIC, IO, MEMORY. */
otx_status otx_companion_files_write_integers(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    otx_texture_type type, bool is_height, const otx_image *image);

/* What texts beside it call the maps of the texture `name`; NULL those that the
 * exemplar lacks. In run->arena, which tells when memory is out. */
otx_data_maps otx_companion_files_names(
    otx_run *run, const char *name, otx_texture_type type,
    const otx_companions *companions);

/* Writes each map of an exemplar as a file of `set` of its type, an EXR tiled
 * and mip-mapped, called as the colour's file `path` is with "_normal.exr" and
 * so on in the place of its extension. Normals are (n + 1) / 2, y up, of length
 * 1 at every level, and y down where the set says so; heights are scene units
 * where the picture is `width` of them wide. IO, MEMORY. */
otx_status otx_companion_files_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, double width);

/* Says where heights do not meet everywhere: on a cage's own UVs and on charts,
 * and in an atlas of blocks at the edges of faces of more than four corners,
 * the two sides of a cut have texels of their own.
 *
 *   in_blocks  of an atlas, and not its charts
 *   cage       whose faces these are
 *   height     what their file is called; NULL there are none */
void otx_companion_files_say_gaps(
    otx_run *run, bool in_blocks, const otx_level *cage, const char *height);

#endif
