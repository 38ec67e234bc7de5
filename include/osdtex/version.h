/* version.h -- of these headers, and of the library that is running. */
#ifndef OSDTEX_VERSION_H
#define OSDTEX_VERSION_H

#include <osdtex/common.h>

#define OSDTEX_VERSION_MAJOR 0
#define OSDTEX_VERSION_MINOR 1
#define OSDTEX_VERSION_PATCH 0

OSDTEX_BEGIN_DECLS

/* "0.1.0", of the library that is running. */
OSDTEX_API const char *osdtex_version(void);

OSDTEX_END_DECLS

#endif
