/* usda_name.h -- names as USD allows them. */
#ifndef OTX_FILE_USDA_NAME_H
#define OTX_FILE_USDA_NAME_H

#include "base/arena.h"

/* `name` as an identifier of USD: letters, digits and `_`, not a digit first,
 * not empty. In `arena`; NULL when memory is out. */
char *otx_usda_identifier(otx_arena *arena, const char *name);

#endif
