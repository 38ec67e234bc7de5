/* task.h -- a task of a job is a command line. */
#ifndef OTX_CLI_TASK_H
#define OTX_CLI_TASK_H

#include "cli/command.h"
#include "farm/farm_job.h"

typedef struct otx_task
{
    const otx_command *command;
    char **argv; /* [argc] what `values` points into */
    int argc;
    otx_flag_values values;
} otx_task;

/* Takes the words of a task apart, as with --update before them: what is done
 * is not done again. False after saying what is wrong; free it in any case. */
bool otx_task_parse(const otx_farm_job *job, int index, otx_task *out);
void otx_task_free(otx_task *task);

#endif
