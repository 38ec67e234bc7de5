/* up_to_date.h -- has this very job been done before?
 *
 * A job is the hash of all that its results depend on: the build, the bytes of
 * every input, what the colour configuration resolves to, and every flag of the
 * command but a listed few. What is written carries it, with a seal that tells
 * whether the file is as it was written. Times of files are not looked at:
 * farms copy files about. */
#ifndef OTX_CLI_UP_TO_DATE_H
#define OTX_CLI_UP_TO_DATE_H

#include "cli/flag.h"

/* Hash of the job. False when an input or the colour configuration cannot be
 * read. */
bool otx_up_to_date_job(
    osdtex_context *context, const otx_flag_values *values,
    char job[OSDTEX_HASH_BYTES]);

/* Whether a flag is part of the job: all are, but for those that say how the
 * work is done or where its results go. */
bool otx_up_to_date_is_part(otx_flag_id id);

/* Whether the file is whole, and of that job.
 *
 *   job  NULL: of any */
bool otx_up_to_date_check(const char *path, const char *job);

#endif
