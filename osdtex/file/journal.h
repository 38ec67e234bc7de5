/* journal.h -- renames that are under way, written down.
 *
 * A process that is killed between two renames leaves half a set: new files
 * beside old ones. So before the first of them each folder gets a journal that
 * says what is about to be called what. The next one who sweeps the folder
 * completes what the journal says: all the files that it names were whole when
 * it was written. Once something else has taken one of the names, nothing is
 * completed.
 *
 * A journal speaks of its own folder only, and only of temporaries of the
 * process that wrote it; one of another user counts for nothing. */
#ifndef OTX_FILE_JOURNAL_H
#define OTX_FILE_JOURNAL_H

#include "base/arena.h"

/* Names of the file that is one, in front of what makes it a temporary. */
#define OTX_JOURNAL_NAME ".osdtex-set"

typedef struct otx_journal_line
{
    const char *temporary; /* FOLDER/NAME.tmp-... */
    const char *path;      /* FOLDER/NAME, what it will be called */
} otx_journal_line;

/* Writes the lines that are of the folder of lines[0]. Its name lives in
 * `arena`. Returns 0 or an error number; then there is none, and *out is
 * NULL. */
int otx_journal_write(
    otx_arena *arena, const otx_journal_line *lines, int32_t count,
    const char **out);

/* Completes what a journal says that a process left; does nothing where it
 * says nothing that can be done. The journal stays.
 *
 *   folder       that it is in
 *   name         of it, within the folder
 *   is_leftover  whether that is the name of a temporary of the same process */
void otx_journal_complete(
    int folder, const char *name,
    bool (*is_leftover)(const void *of, const char *name), const void *of);

#endif
