/* edit_flags.h -- what flags say of spots that are to be textured again. */
#ifndef OTX_CLI_EDIT_FLAGS_H
#define OTX_CLI_EDIT_FLAGS_H

#include "cli/flag.h"

/* --redo FACE or X,Y,Z,RADIUS, of which --seed says which other texture is to
 * be tried. False after saying what is wrong. */
bool otx_edit_flags_redo(const otx_flag_values *values, osdtex_constraint *out);

#endif
