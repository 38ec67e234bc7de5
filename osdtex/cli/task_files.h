/* task_files.h -- tasks of a job that get in each other's way. */
#ifndef OTX_CLI_TASK_FILES_H
#define OTX_CLI_TASK_FILES_H

#include "farm/farm_job.h"

/* Whether no two tasks of a job write one file, and none reads what another
 * writes: a farm runs them in any order. Those that bake single tiles of one
 * asset share its texts. False after naming both and the file, or saying which
 * task is wrong. */
bool otx_task_files_are_apart(const otx_farm_job *job);

#endif
