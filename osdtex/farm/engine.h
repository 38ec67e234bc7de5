/* engine.h -- a job in the words of somebody else's farm. */
#ifndef OTX_FARM_ENGINE_H
#define OTX_FARM_ENGINE_H

#include "farm/farm_job.h"

#include <stdio.h>

typedef struct otx_engine
{
    const char *name;
    const char *submit; /* how the files are handed over; %s is the folder */
    /* [file_count] files of the folder, and what is in them. */
    int file_count;
    struct
    {
        const char *name;
        const char *sign; /* stands near the beginning of every such file */
        void (*put)(FILE *out, const otx_farm_job *job, const char *program);
    } files[2];
    /* Why a name (of the job's file, of the program) cannot be told to the
     * engine; NULL when it can. */
    const char *(*refuse)(const char *name);
} otx_engine;

/* NULL behind the end. */
const otx_engine *otx_engine_at(int index);
const otx_engine *otx_engine_find(const char *name);

/* Whether the engine can be told of the job and the program. False after
 * saying in `error` what is wrong. */
bool otx_engine_check(
    const otx_engine *engine, const otx_farm_job *job, const char *program,
    char error[OTX_FARM_JOB_ERROR_BYTES]);

/* Name of the engine's file `index` in `folder`. */
void otx_engine_path(
    const otx_engine *engine, int index, const char *folder,
    char path[OTX_FARM_JOB_PATH_BYTES]);

/* Whether a file of this name is not there, is empty, or was written for the
 * engine by us: another one is somebody's own. */
bool
otx_engine_may_replace(const otx_engine *engine, int index, const char *path);

/* Writes a file of the engine.
 *
 *   path     as its writer knows it, perhaps a temporary name
 *   program  what runs a task, as the machines of the farm know it */
bool otx_engine_write(
    const otx_engine *engine, int index, const otx_farm_job *job,
    const char *program, const char *path);

#endif
