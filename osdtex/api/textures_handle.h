/* textures_handle.h -- what is baked into memory, and onto what. */
#ifndef OTX_API_TEXTURES_HANDLE_H
#define OTX_API_TEXTURES_HANDLE_H

#include "bake/bake.h"

#include <osdtex/osdtex.h>

enum
{
    OTX_TEXTURES_MAX = (int)OTX_TEXEL_KIND_COUNT + (int)OTX_COMPANION_COUNT
};

/* Where the texels of a texture come from. */
typedef struct otx_textures_source
{
    const otx_bake *bake;
    int32_t map; /* that is baked with it; -1: what it is of itself */
} otx_textures_source;

struct osdtex_textures
{
    otx_arena *arena;
    otx_layout layout;
    int32_t first_tile; /* of the layout, that is the first here */
    otx_bake bakes[OTX_TEXEL_KIND_COUNT];
    otx_bake map_bakes[OTX_COMPANION_COUNT];        /* each map alone */
    otx_textures_source sources[OTX_TEXTURES_MAX];  /* [texture_count] */
    osdtex_texture_info textures[OTX_TEXTURES_MAX]; /* likewise */
    osdtex_textures_info info;
};

#endif
