/* baked_texture.h -- one texture for a mapping that no single UV a corner can
 * stand for. */
#ifndef OTX_EXPORT_BAKED_TEXTURE_H
#define OTX_EXPORT_BAKED_TEXTURE_H

#include "bake/layout.h"
#include "exemplar/exemplar.h"
#include "file/atomic_file.h"

/* Whether a mapping shows pastes over one another, which UVs into the exemplar
 * cannot say. */
bool otx_baked_texture_is_needed(const otx_mapping *mapping);

/* Texels of a side that are as fine as the exemplar is on the surface: a power
 * of two from 512 to 8192. */
int32_t otx_baked_texture_side(
    const otx_mapping *mapping, const otx_exemplar *exemplars);

/* An atlas of one tile of `side` texels a side; 0: by itself. */
otx_status otx_baked_texture_lay_out(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    int32_t side, otx_layout *out);

/* Bakes the colour onto `layout` as the texture `path` of `set`, and the maps
 * that any exemplar has beside it, as companion_files.h names them. ARGUMENT,
 * IO, NUMERIC, MEMORY, CANCELLED. */
otx_status otx_baked_texture_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout);

#endif
