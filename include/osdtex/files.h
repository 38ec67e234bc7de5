/* files.h -- files that appear together, and what files depend on.
 *
 * Each call that writes leaves all of its files or none. Several calls become
 * one such set:
 *
 *     osdtex_outputs_begin(context);
 *     status = osdtex_bake(context, mapping, "shirt.obj", NULL);
 *     if (status == OSDTEX_OK)
 *         status = osdtex_report_write(context, mapping, "shirt.json");
 *     if (status == OSDTEX_OK)
 *         status = osdtex_outputs_commit(context);
 *     else
 *         osdtex_outputs_drop(context);
 *
 * Until the commit they lie beside their places under temporary names; a
 * process that dies leaves those alone. Destroying the context drops the set.
 */
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

/* From here on, what calls of this context write appears when the set is
 * committed: all of it or, when something goes wrong before, nothing, and what
 * was there before stays. ARGUMENT (a set has been begun), MEMORY. */
OSDTEX_API osdtex_status osdtex_outputs_begin(osdtex_context *context);

/* Says which job the files of the set are of: each carries it, with a seal by
 * which it is known to be whole, in a comment or an attribute.
 *
 *   job     a hash as osdtex_hash gives it; NULL none
 *   source  the file that they are made from; its name counts, not its folder.
 *           NULL none
 *
 * ARGUMENT. */
OSDTEX_API osdtex_status osdtex_outputs_mark(
    osdtex_context *context, const char *job, const char *source);

enum
{
    OSDTEX_SOURCE_BYTES = 81
};

/* The name of a source as marks have it: without its folder, in plain letters.
 */
OSDTEX_API void
osdtex_outputs_source(const char *path, char source[OSDTEX_SOURCE_BYTES]);

/* Makes of a name, in place, what files beside NAME.obj are called by: `_`
 * stands for what readers of OBJ, MTL, USD or MaterialX would not take. */
OSDTEX_API void osdtex_outputs_word(char *name);

/* What a file says of itself. */
typedef struct osdtex_output_mark
{
    char job[OSDTEX_HASH_BYTES];      /* "" none */
    char source[OSDTEX_SOURCE_BYTES]; /* the name, as plain letters; "" not
                                         known */
    bool is_ours;                     /* it was written by osdtex */
    bool is_whole;                    /* and nothing of it has changed since */
} osdtex_output_mark;

/* Reads the mark of a file; one of zeros when there is none.
 *
 *   check_seal  reads all of the file, for is_whole */
OSDTEX_API void osdtex_outputs_inspect(
    const char *path, bool check_seal, osdtex_output_mark *out);

/* Makes a file of the caller's own part of the set: an empty one, which has
 * been closed by the time of the commit.
 *
 *   path       what it will be called
 *   temporary  what it is called until then; lives as long as the set
 *
 * ARGUMENT (no set), IO (no such folder, `path` is a link, protected or no
 * plain file), MEMORY. */
OSDTEX_API osdtex_status osdtex_outputs_add(
    osdtex_context *context, const char *path, const char **temporary);

/* Does all of a commit that takes time or may fail for a reason: seals the
 * files and has the disk store them. What is left is to rename them. CANCELLED
 * by progress, ARGUMENT (no set), IO. */
OSDTEX_API osdtex_status osdtex_outputs_seal(osdtex_context *context);

/* Seals what is not sealed, gives all files their names, but for those of calls
 * that failed, and ends the set in any case. CANCELLED by progress, ARGUMENT
 * (no set), IO. */
OSDTEX_API osdtex_status osdtex_outputs_commit(osdtex_context *context);

/* Ends the set without its files; nothing where there is none. */
OSDTEX_API void osdtex_outputs_drop(osdtex_context *context);

/* Removes the unfinished files of this process from the folder of `path`: for a
 * program that ends without waiting for the calls that write them. From any
 * thread. */
OSDTEX_API void osdtex_outputs_sweep(const char *path);

OSDTEX_END_DECLS

#endif
