/* picture_flags.h -- the flags of pictures and previews. */
#ifndef OTX_CLI_PICTURE_FLAGS_H
#define OTX_CLI_PICTURE_FLAGS_H

#include "cli/flag.h"

/* Words to options. On a mistake it says so and returns false. */
bool otx_picture_flags_parse(
    const otx_flag_values *values, osdtex_render_options *out);

/* --up: 0 where Y is up or nothing is said, 1 where Z is. On a mistake it says
 * so and returns false. */
bool otx_picture_flags_up(const otx_flag_values *values, int32_t *out);

#endif
