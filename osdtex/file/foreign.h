/* foreign.h -- files of other programs that are taken for an OBJ. */
#ifndef OTX_FILE_FOREIGN_H
#define OTX_FILE_FOREIGN_H

#include <stddef.h>

/* What a file is by its first bytes, as "a USD file"; NULL: nothing known. */
const char *otx_foreign_kind(const char *bytes, size_t size);

#endif
