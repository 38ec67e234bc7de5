/* farm_job.h -- a list of tasks for a farm: JOB.json.
 *
 *     {
 *       "name": "shirts",
 *       "threads": 4,
 *       "tasks": [
 *         {"name": "shirt_red", "command": "bake",
 *          "arguments": "cages/shirt.obj red.exr -o out/shirt_red.obj"}
 *       ]
 *     }
 *
 * Or, instead of "arguments", a list of words, where one holds a blank. Paths
 * are relative to the folder of the file. A task is one asset: it needs no
 * other task, and running it again does no harm. */
#ifndef OTX_FARM_FARM_JOB_H
#define OTX_FARM_FARM_JOB_H

#include <jansson.h>
#include <stdbool.h>

enum
{
    OTX_FARM_JOB_ERROR_BYTES = 512,
    OTX_FARM_JOB_PATH_BYTES = 4096,
    OTX_FARM_JOB_NAME_BYTES = 101,
    OTX_FARM_JOB_TASKS_MAX = 100000
};

typedef struct otx_farm_job
{
    json_t *root;
    const char *name; /* with `_` for blanks */
    int threads;      /* of a task; 0 all */
    int task_count;
    char plain_name[OTX_FARM_JOB_NAME_BYTES]; /* what `name` points to */
    char path[OTX_FARM_JOB_PATH_BYTES];       /* of the file, absolute */
    char folder[OTX_FARM_JOB_PATH_BYTES];     /* of it */
} otx_farm_job;

/* False after saying in `error` what is wrong. */
bool otx_farm_job_read(
    const char *path, otx_farm_job *out, char error[OTX_FARM_JOB_ERROR_BYTES]);
void otx_farm_job_free(otx_farm_job *job);

/* "map", "bake". */
const char *otx_farm_job_command(const otx_farm_job *job, int task);
const char *otx_farm_job_task_name(const otx_farm_job *job, int task);

/* The words behind the command, as a new array of texts. */
json_t *otx_farm_job_words(const otx_farm_job *job, int task);

#endif
