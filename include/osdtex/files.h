/* files.h -- what files depend on. */
#ifndef OSDTEX_FILES_H
#define OSDTEX_FILES_H

#include <osdtex/context.h>

OSDTEX_BEGIN_DECLS

/* Called with the path of a file, which lives until the function returns. */
typedef void (*osdtex_file_visitor)(void *user, const char *path);

/* Visits the file `path` and those it names: of an OBJ its material libraries
 * and their maps. A name with <UDIM> or <UVTILE> stands for all files of its
 * folder that fit. Only files that are there are visited, some perhaps twice.
 * ARGUMENT, MEMORY. */
OSDTEX_API osdtex_status osdtex_file_references(
    osdtex_context *context, const char *path, osdtex_file_visitor visit,
    void *user);

/* Visits the colour configuration of the context and the look-up tables that it
 * finds with the variables of the environment; of the one built in there are
 * none. COLOUR, ARGUMENT, MEMORY. */
OSDTEX_API osdtex_status osdtex_colour_references(
    osdtex_context *context, osdtex_file_visitor visit, void *user);

/* Hash of all that conversions of the configuration depend on: its content,
 * the variables in it, the bytes of its tables, the version of OpenColorIO.
 * COLOUR, ARGUMENT, MEMORY. */
OSDTEX_API osdtex_status
osdtex_colour_hash(osdtex_context *context, char hash[OSDTEX_HASH_BYTES]);

OSDTEX_END_DECLS

#endif
