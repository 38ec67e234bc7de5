/* field_flags.h -- what the flags say about a field. */
#ifndef OTX_CLI_FIELD_FLAGS_H
#define OTX_CLI_FIELD_FLAGS_H

#include "cli/flag.h"

/* False after saying what is wrong. */
bool
otx_field_flags_parse(const otx_flag_values *values, osdtex_field_options *out);

#endif
