/* temporary.h -- names for files that are not finished.
 *
 * NAME.tmp-MACHINE-PROCESS-NUMBER beside NAME says who is writing it, so that
 * what a killed process left can be told from what another one is busy with,
 * on disks that several machines share as well. A name that would get too long
 * is made shorter by a hash. */
#ifndef OTX_FILE_TEMPORARY_H
#define OTX_FILE_TEMPORARY_H

#include "base/arena.h"

/* Makes a file that nobody else has beside `path`: an empty one or, with
 * `of`, a second name for that file. Its name lives in `arena`. Returns 0 or an
 * error number (ENOMEM when memory is out); then *out is NULL. */
int otx_temporary_create(
    otx_arena *arena, const char *path, const char *of, const char **out);

/* Removes temporaries from the folder of `path` whose processes ran on this
 * machine and are no more. Sets of files that they were giving names to are
 * completed first (file/journal.h). */
void otx_temporary_sweep(const char *path);

/* Removes those of this process, which is about to end. */
void otx_temporary_sweep_own(const char *path);

#endif
