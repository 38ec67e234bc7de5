/* picture_flags.h -- the flags of `osdtex render` and `osdtex field`. */
#ifndef OTX_CLI_PICTURE_FLAGS_H
#define OTX_CLI_PICTURE_FLAGS_H

#include "cli/flag.h"

/* Words to options. On a mistake it says so and returns false. */
bool otx_picture_flags_parse(
    const otx_flag_values *values, osdtex_render_options *out);

#endif
