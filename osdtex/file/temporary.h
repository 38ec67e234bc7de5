/* temporary.h -- names for files that are not finished.
 *
 * NAME.tmp-MACHINE-PROCESS-NUMBER beside NAME says who is writing it, so that
 * what a killed process left can be told from what another one is busy with,
 * on disks that several machines share as well. A name that would get too long
 * is made shorter by a hash. */
#ifndef OTX_FILE_TEMPORARY_H
#define OTX_FILE_TEMPORARY_H

#include "base/arena.h"

enum
{
    OTX_TEMPORARY_LEAD_BYTES = 64 /* ".tmp-MACHINE-", "PROCESS-NUMBER" */
};

/* Makes a file that nobody else has beside `path`: an empty one or, with
 * `of`, a second name for that file. Its name lives in `arena`. Returns 0 or an
 * error number (ENOMEM when memory is out); then *out is NULL. */
int otx_temporary_create(
    otx_arena *arena, const char *path, const char *of, const char **out);

/* ".tmp-MACHINE-", of which numbers of processes are: of one machine and, in
 * containers, one space of numbers. */
void otx_temporary_machine(char lead[OTX_TEMPORARY_LEAD_BYTES]);

/* The process in a name that ends in ".tmp-MACHINE-PROCESS-NUMBER"; 0 none.
 *
 *   machine  as otx_temporary_machine has it */
long otx_temporary_process(const char *name, const char *machine);

#endif
