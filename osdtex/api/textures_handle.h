/* textures_handle.h -- what is baked into memory, and onto what. */
#ifndef OTX_API_TEXTURES_HANDLE_H
#define OTX_API_TEXTURES_HANDLE_H

#include "bake/bake.h"

#include <osdtex/osdtex.h>

struct osdtex_textures
{
    otx_arena *arena;
    otx_layout layout;
    int32_t first_tile; /* of the layout, that is the first here */
    otx_bake bakes[OTX_TEXEL_KIND_COUNT];
    osdtex_texture_info textures[OTX_TEXEL_KIND_COUNT]; /* as many */
    osdtex_textures_info info;
};

#endif
