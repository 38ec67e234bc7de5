/* task.c -- a task of a job is a command line. */
#include "cli/task.h"

#include "cli/session.h"

#include <stdlib.h>
#include <string.h>

static bool
copy_words(const otx_farm_job *job, int index, otx_task *task)
{
    json_t *words = otx_farm_job_words(job, index);
    const size_t count = json_array_size(words);
    bool whole = true;

    task->argv = calloc(count + 3, sizeof *task->argv);
    task->argc = task->argv ? (int)count + 2 : 0;
    for (int i = 0; i < task->argc; ++i)
    {
        const char *word =
            i == 0   ? task->command->name
            : i == 1 ? "--update"
                     : json_string_value(json_array_get(words, (size_t)i - 2));

        task->argv[i] = strdup(word);
        whole = whole && task->argv[i];
    }
    json_decref(words);
    return task->argv && whole;
}

bool
otx_task_parse(const otx_farm_job *job, int index, otx_task *out)
{
    *out = (otx_task){
        .command = otx_command_find(otx_farm_job_command(job, index))};
    if (!copy_words(job, index, out))
    {
        otx_session_refuse("memory is out");
        return false;
    }
    if (!otx_flag_parse(
            out->argc, out->argv, out->command->flags, &out->values))
        return false;
    out->values.job = job->path;
    if (otx_command_takes(out->command, &out->values))
        return true;
    otx_session_refuse(
        "task %d: osdtex %s takes %s", index, out->command->name,
        out->command->operands);
    return false;
}

void
otx_task_free(otx_task *task)
{
    for (int i = 0; i < task->argc; ++i)
        free(task->argv[i]);
    free(task->argv);
    *task = (otx_task){0};
}
