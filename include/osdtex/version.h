/* version.h -- of these headers, and of the library that is running.
 *
 *     #if OSDTEX_VERSION_MAJOR == 0 && OSDTEX_VERSION_MINOR < 2
 *     #error osdtex 0.2 is needed
 *     #endif
 *     printf("osdtex %s (%s)\n", osdtex_version(), osdtex_build());
 *
 * docs/conventions.md, "Versions", says what may change between two of them.
 * Texts are static. */
#ifndef OSDTEX_VERSION_H
#define OSDTEX_VERSION_H

#include <osdtex/common.h>

#define OSDTEX_VERSION_MAJOR 0
#define OSDTEX_VERSION_MINOR 2
#define OSDTEX_VERSION_PATCH 0

OSDTEX_BEGIN_DECLS

/* "0.1.0", of the library that is running. */
OSDTEX_API const char *osdtex_version(void);

/* Which build the library that is running is: "v1.2-3-g4df2b75+3f9a1c22d0e1",
 * what `git describe` said of the tree (of a release, the version) and a hash
 * of what was compiled and how. Two builds that may give other results have
 * other texts. */
OSDTEX_API const char *osdtex_build(void);

OSDTEX_END_DECLS

#endif
