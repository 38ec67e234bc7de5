/* spool.h -- inputs that come through pipes.
 *
 * What an input is and whether a result is up to date is seen by looking into
 * files before they are read, and a pipe can be read once. So a pipe that
 * stands for an input (`<(…)`, /dev/stdin, a named pipe) is read into memory
 * first, and the commands are given that as a file. */
#ifndef OTX_CLI_SPOOL_H
#define OTX_CLI_SPOOL_H

#include "cli/flag.h"

/* Reads all inputs of `values` that are pipes. The memory is the process's
 * until it ends. False after saying what is wrong. */
bool otx_spool_inputs(otx_flag_values *values);

/* What the user called the file `path`. */
const char *otx_spool_name(const otx_flag_values *values, const char *path);

#endif
