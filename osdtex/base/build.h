/* build.h -- which build of osdtex this is.
 *
 * The source is written at every build by tools/cmake/BuildIdentity.cmake and
 * is part of the library. Tests are linked with one that never changes, since
 * all of them would be linked again after each commit. */
#ifndef OTX_BASE_BUILD_H
#define OTX_BASE_BUILD_H

/* "TREE+HASH": what `git describe` says of the tree, or the version where there
 * is no git; and 12 hexadecimal digits of what was compiled and how. */
const char *otx_build(void);

#endif
