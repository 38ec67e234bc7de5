/* bake_flags.h -- the flags of `osdtex bake` and `osdtex map --bake`. */
#ifndef OTX_CLI_BAKE_FLAGS_H
#define OTX_CLI_BAKE_FLAGS_H

#include "cli/flag.h"

/* Words to options. On a mistake it says so and returns false. */
bool
otx_bake_flags_parse(const otx_flag_values *values, osdtex_bake_options *out);

#endif
