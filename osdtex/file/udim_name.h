/* udim_name.h -- files that are one for each UDIM tile.
 *
 * Their pattern has a token in the file's name, in capitals or not: <UDIM>
 * stands for 1001 and on, <UVTILE> for u1_v1 and on. */
#ifndef OTX_FILE_UDIM_NAME_H
#define OTX_FILE_UDIM_NAME_H

#include "base/arena.h"

/* Whether a path is such a pattern. */
bool otx_udim_name_is_pattern(const char *path);

/* The path of one tile, of a pattern; NULL when memory is out. */
const char *
otx_udim_name_of(otx_arena *arena, const char *pattern, int32_t tile);

#endif
