/* atomic_file.h -- output files that appear together, or not at all.
 *
 * Every file of a set is written under a temporary name beside its final one.
 * Commit renames them all; anything else (an error, a cancelled run) removes
 * them, when the arena that the set was begun in is released. So a status that
 * travels up is all the cleaning that an interrupted job needs. */
#ifndef OTX_FILE_ATOMIC_FILE_H
#define OTX_FILE_ATOMIC_FILE_H

#include "base/run.h"

typedef struct otx_atomic_file_set otx_atomic_file_set;

/* Begins an empty set; what is not committed when `arena` is released past
 * this point is removed. */
otx_status otx_atomic_file_begin(
    otx_run *run, otx_arena *arena, otx_atomic_file_set **out);

/* Creates the temporary of `path`, empty, and gives its name in *temporary
 * (it lives in the set's arena) for whoever writes it. IO when the folder
 * does not exist or cannot be written to, or `path` is not a plain file. */
otx_status otx_atomic_file_add(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const char **temporary);

/* Renames all to their final names, in the order they were added. `durable`
 * waits until the disk has the bytes. When a rename fails, final names that
 * did not exist before are removed again, and the rest of the set with them;
 * a file that had already taken the place of an older one stays. */
otx_status
otx_atomic_file_commit(otx_run *run, otx_atomic_file_set *set, bool durable);

#endif
