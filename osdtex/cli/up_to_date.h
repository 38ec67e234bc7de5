/* up_to_date.h -- has this very job been done before?
 *
 * A job is the hash of the program's version, the bytes of its input files and
 * the text of every flag that changes the result. `map` writes it as a comment
 * into the OBJ, `bake` into its textures too, and since outputs appear together
 * or not at all, a file that carries the hash says that the job is done. Times
 * of files are not looked at: farms copy files about. */
#ifndef OTX_CLI_UP_TO_DATE_H
#define OTX_CLI_UP_TO_DATE_H

#include "cli/flag.h"

/* Hash of the job. False when an input cannot be read. */
bool
otx_up_to_date_job(const otx_flag_values *values, char job[OSDTEX_HASH_BYTES]);

/* Whether the OBJ or texture at `path` carries that hash. */
bool otx_up_to_date_check(const char *path, const char job[OSDTEX_HASH_BYTES]);

/* What stands before the hash in the comment. */
#define OTX_UP_TO_DATE_COMMENT "osdtex job "

#endif
