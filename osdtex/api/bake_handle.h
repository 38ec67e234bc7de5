/* bake_handle.h -- what the options of a bake ask for, checked. */
#ifndef OTX_API_BAKE_HANDLE_H
#define OTX_API_BAKE_HANDLE_H

#include "bake/bake.h"

#include <osdtex/osdtex.h>

/* The host's options over the defaults. ARGUMENT for those that cannot be. */
otx_status otx_bake_handle_options(
    otx_run *run, const osdtex_bake_options *theirs, osdtex_bake_options *out);

/* Where the textures go. */
otx_layout_options otx_bake_handle_layout(const osdtex_bake_options *options);

/* Whether a kind is asked for; the colour is always. */
bool
otx_bake_handle_has(const osdtex_bake_options *options, otx_texel_kind kind);

#endif
