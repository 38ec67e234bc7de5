/* engine.h -- a job in the words of somebody else's farm. */
#ifndef OTX_FARM_ENGINE_H
#define OTX_FARM_ENGINE_H

#include "farm/job.h"

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
        void (*put)(FILE *out, const otx_job *job, const char *program);
    } files[2];
} otx_engine;

/* NULL behind the end. */
const otx_engine *otx_engine_at(int index);
const otx_engine *otx_engine_find(const char *name);

/* Writes the files into `folder`, which exists.
 *
 *   program  what runs a task, as the machines of the farm know it */
bool otx_engine_write(
    const otx_engine *engine, const otx_job *job, const char *program,
    const char *folder, char error[OTX_JOB_ERROR_BYTES]);

#endif
