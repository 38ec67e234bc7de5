/* map_textures.h -- the maps of all exemplars of a mapping, to be looked up. */
#ifndef OTX_MAPPING_MAP_TEXTURES_H
#define OTX_MAPPING_MAP_TEXTURES_H

#include "image/texture.h"
#include "mapping/carry.h"

/* Values lie in one order of channels for all exemplars, and otx_show_color
 * finds them with `carry` in its view. */
typedef struct otx_map_textures
{
    const otx_texture *textures; /* [count] */
    otx_carry carry; /* its surface is NULL where the values are told in the
                      * frame of the UVs as they are */
    /* First channel of a kind's values; -1: no exemplar has it. */
    int32_t first[OTX_COMPANION_COUNT];
    int32_t channels; /* 0: no exemplar has a map */
} otx_map_textures;

/* Of all kinds of maps, as bits 1 << kind. */
#define OTX_MAP_TEXTURES_ALL ((1u << OTX_COMPANION_COUNT) - 1u)

/* What lies on one picture, and whether that tiles. */
typedef struct otx_map_set
{
    const otx_companions *companions;
    bool wrap_x, wrap_y;
    const otx_image *slices; /* [slice_count] images as that of `companions`, of
                              * a stack; NULL: it has none */
    int32_t slice_count;
} otx_map_set;

/* Prepares the maps of `count` pictures as they are, in run->arena. Borrows
 * all. MEMORY. */
otx_status otx_map_textures_gather(
    otx_run *run, const otx_map_set *sets, int32_t count, uint32_t kinds,
    otx_map_textures *out);

/* Prepares the maps that any of the exemplars has, in run->arena: where another
 * has none, it is flat and neutral. Borrows all. MEMORY.
 *
 *   kinds  of them, as bits */
otx_status otx_map_textures_create(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    uint32_t kinds, otx_map_textures *out);

#endif
