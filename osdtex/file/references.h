/* references.h -- which other files an OBJ or an MTL names.
 *
 * Whoever is about to write files asks here what must not be replaced. So the
 * search is generous: programs disagree about blanks, quotes, slashes and
 * options in these lines, and every reading of a line counts whose file is
 * there. */
#ifndef OTX_FILE_REFERENCES_H
#define OTX_FILE_REFERENCES_H

#include "base/status.h"

/* Calls `visit` for `path` itself and, of an OBJ, for its material libraries
 * and the maps that these name; of an MTL, for its maps. A name with a UDIM
 * token stands for all files of its folder that fit it, in order of their
 * names. Only plain files that are there are visited; one may be visited more
 * than once. MEMORY. */
otx_status otx_references_visit(
    const char *path, void (*visit)(void *user, const char *path), void *user);

#endif
