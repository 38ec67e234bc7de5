/* farm_command.c -- osdtex plan and osdtex run: a job for a farm, and a task
 * of it. */
#include "cli/session.h"
#include "cli/value.h"
#include "farm/engine.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *
engine_name(int index)
{
    const otx_engine *engine = otx_engine_at(index);

    return engine ? engine->name : NULL;
}

static bool
make_folder(const char *path)
{
    struct stat status;

    mkdir(path, 0777);
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Without the slashes that it ends with. */
static int
folder_length(const char *path)
{
    int length = (int)strlen(path);

    while (length > 1 && path[length - 1] == '/')
        --length;
    return length;
}

/* Where this program is: what the farm runs unless --program says else. */
static const char *
program_path(const otx_flag_values *values, char own[OTX_JOB_PATH_BYTES])
{
    const char *given = values->text[OTX_FLAG_PROGRAM];
    const ssize_t length =
        given ? 0 : readlink("/proc/self/exe", own, OTX_JOB_PATH_BYTES - 1);

    if (given || length <= 0)
        return given ? given : "osdtex";
    own[length] = '\0';
    return own;
}

/* The job, or an exit code. */
static int
read_job(const otx_flag_values *values, otx_job *out)
{
    const char *path = values->operands[0];
    char error[OTX_JOB_ERROR_BYTES];

    if (access(path, R_OK) != 0)
    {
        otx_session_refuse(
            "%s: the file cannot be read: %s", path, strerror(errno));
        return OTX_EXIT_IO;
    }
    if (otx_job_read(path, out, error))
        return OTX_EXIT_OK;
    otx_session_refuse("%s", error);
    return OTX_EXIT_DATA;
}

static int
plan(
    const otx_flag_values *values, const otx_engine *engine, const otx_job *job)
{
    const char *output = values->text[OTX_FLAG_OUTPUT];
    char own[OTX_JOB_PATH_BYTES], error[OTX_JOB_ERROR_BYTES];

    if (!make_folder(output))
    {
        otx_session_refuse("the folder '%s' cannot be made", output);
        return OTX_EXIT_IO;
    }
    if (!otx_engine_write(
            engine, job, program_path(values, own), output, error))
    {
        otx_session_refuse("%s", error);
        return OTX_EXIT_IO;
    }
    printf("%d tasks: ", job->task_count);
    for (const char *c = engine->submit; *c; ++c)
    {
        if (strncmp(c, "%s", 2) != 0)
        {
            putchar(*c);
            continue;
        }
        printf("%.*s", folder_length(output), output);
        ++c;
    }
    putchar('\n');
    return OTX_EXIT_OK;
}

int
otx_plan_command_run(const otx_flag_values *values)
{
    const char *name = values->text[OTX_FLAG_ENGINE];
    const otx_engine *engine = otx_engine_find(name ? name : "make");
    otx_job job;
    int code;

    if (!engine)
        return otx_session_refuse(
            "there is no engine '%s'; there are %s, %s, %s and %s", name,
            engine_name(0), engine_name(1), engine_name(2), engine_name(3));
    if (!values->text[OTX_FLAG_OUTPUT])
        return otx_session_refuse(
            "the engine's files go to a folder: osdtex plan %s -o FOLDER",
            values->operands[0]);
    code = read_job(values, &job);
    if (code != OTX_EXIT_OK)
        return code;
    code = plan(values, engine, &job);
    otx_job_free(&job);
    return code;
}

/* ---------------------------------------------------------------------- */

/* A task is a command line, so it is run as one, with --update: what is done
 * is not done again. */
static int
run_words(const otx_job *job, int task, json_t *words)
{
    const otx_command *command = otx_command_find(otx_job_command(job, task));
    const size_t count = json_array_size(words);
    char **argv = calloc(count + 3, sizeof *argv);
    otx_flag_values values;
    int code = OTX_EXIT_USAGE;

    if (!argv)
        return OTX_EXIT_LIMIT;
    argv[0] = strdup(command->name);
    argv[1] = strdup("--update");
    for (size_t i = 0; i < count; ++i)
        argv[i + 2] = strdup(json_string_value(json_array_get(words, i)));
    if (!otx_flag_parse((int)count + 2, argv, command->flags, &values))
        code = OTX_EXIT_USAGE;
    else if (
        values.operand_count < command->operands_min ||
        values.operand_count > command->operands_max)
        otx_session_refuse(
            "task %d: osdtex %s takes %s", task, command->name,
            command->operands);
    else
    {
        values.job = job->path;
        code = command->run(&values);
    }
    for (size_t i = 0; i < count + 2; ++i)
        free(argv[i]);
    free(argv);
    return code;
}

static int
run_task(const otx_flag_values *values, const otx_job *job)
{
    const char *text = values->text[OTX_FLAG_TASK];
    json_t *words;
    int64_t task;
    int code;

    if (!text)
        return otx_session_refuse(
            "say which task to run: --task, a number from 0 to %d",
            job->task_count - 1);
    if (!otx_value_int(text, 0, job->task_count - 1, &task))
        return otx_session_refuse(
            "--task takes a number from 0 to %d, not '%s'", job->task_count - 1,
            text);
    if (chdir(job->folder) != 0)
    {
        otx_session_refuse("the folder '%s' cannot be entered", job->folder);
        return OTX_EXIT_IO;
    }
    words = otx_job_words(job, (int)task);
    code = run_words(job, (int)task, words);
    json_decref(words);
    return code;
}

int
otx_run_command_run(const otx_flag_values *values)
{
    otx_job job;
    int code = read_job(values, &job);

    if (code != OTX_EXIT_OK)
        return code;
    code = run_task(values, &job);
    otx_job_free(&job);
    return code;
}
