/* farm_command.c -- osdtex plan and osdtex run: a job for a farm, and a task
 * of it. */
#include "cli/dispatch.h"
#include "cli/session.h"
#include "cli/task.h"
#include "cli/task_files.h"
#include "cli/value.h"
#include "farm/engine.h"
#include "regress/process.h"

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
program_path(const otx_flag_values *values, char own[OTX_FARM_JOB_PATH_BYTES])
{
    const char *given = values->text[OTX_FLAG_PROGRAM];
    const ssize_t length =
        given ? 0
              : readlink("/proc/self/exe", own, OTX_FARM_JOB_PATH_BYTES - 1);

    if (given || length <= 0)
        return given ? given : "osdtex";
    own[length] = '\0';
    return own;
}

/* The job, or an exit code. */
static int
read_job(const otx_flag_values *values, otx_farm_job *out)
{
    const char *path = values->operands[0];
    char error[OTX_FARM_JOB_ERROR_BYTES];

    if (access(path, R_OK) != 0)
    {
        otx_session_refuse(
            "%s: the file cannot be read: %s", path, strerror(errno));
        return OTX_EXIT_IO;
    }
    if (otx_farm_job_read(path, out, error))
        return OTX_EXIT_OK;
    otx_session_refuse("%s", error);
    return OTX_EXIT_DATA;
}

/* Whether none of the engine's files is somebody's own. */
static bool
may_replace(const otx_engine *engine, const char *folder)
{
    char path[OTX_FARM_JOB_PATH_BYTES];

    for (int i = 0; i < engine->file_count; ++i)
    {
        otx_engine_path(engine, i, folder, path);
        if (otx_engine_may_replace(engine, i, path))
            continue;
        otx_session_refuse(
            "'%s' is there and was not written by osdtex plan; choose another "
            "folder",
            path);
        return false;
    }
    return true;
}

/* The engine's files, as one set. */
static osdtex_status
write_files(
    otx_session *session, const otx_engine *engine, const otx_farm_job *job,
    const char *program, const char *folder)
{
    char path[OTX_FARM_JOB_PATH_BYTES];
    const char *temporary;

    for (int i = 0; i < engine->file_count; ++i)
    {
        osdtex_status status;

        otx_engine_path(engine, i, folder, path);
        status = osdtex_outputs_add(session->context, path, &temporary);
        if (status != OSDTEX_OK)
            return status;
        if (!otx_engine_write(engine, i, job, program, temporary))
        {
            otx_session_refuse("'%s' cannot be written", path);
            return OSDTEX_ERROR_IO;
        }
    }
    return otx_session_commit(session);
}

static void
say_how(const otx_engine *engine, const otx_farm_job *job, const char *folder)
{
    printf("%d tasks: ", job->task_count);
    for (const char *c = engine->submit; *c; ++c)
    {
        if (strncmp(c, "%s", 2) != 0)
        {
            putchar(*c);
            continue;
        }
        otx_process_put_word(stdout, folder, (size_t)folder_length(folder));
        ++c;
    }
    putchar('\n');
}

static int
plan(
    const otx_flag_values *values, const otx_engine *engine,
    const otx_farm_job *job)
{
    const char *output = values->text[OTX_FLAG_OUTPUT];
    char own[OTX_FARM_JOB_PATH_BYTES], error[OTX_FARM_JOB_ERROR_BYTES];
    const char *program = program_path(values, own);
    osdtex_status status;
    otx_session session;

    if (!otx_engine_check(engine, job, program, error))
    {
        otx_session_refuse("%s", error);
        return OTX_EXIT_DATA;
    }
    if (!otx_task_files_are_apart(job))
        return OTX_EXIT_DATA;
    if (!make_folder(output))
    {
        otx_session_refuse("the folder '%s' cannot be made", output);
        return OTX_EXIT_IO;
    }
    if (!may_replace(engine, output))
        return OTX_EXIT_IO;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    status = write_files(&session, engine, job, program, output);
    if (status == OSDTEX_OK)
        say_how(engine, job, output);
    return otx_session_end(&session, status);
}

int
otx_plan_command_run(const otx_flag_values *values)
{
    const char *name = values->text[OTX_FLAG_ENGINE];
    const otx_engine *engine = otx_engine_find(name ? name : "make");
    otx_farm_job job;
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
    otx_farm_job_free(&job);
    return code;
}

/* ---------------------------------------------------------------------- */

static int
run_task(const otx_flag_values *values, const otx_farm_job *job)
{
    const char *text = values->text[OTX_FLAG_TASK];
    otx_task task;
    int64_t index;
    int code = OTX_EXIT_USAGE;

    if (!text)
        return otx_session_refuse(
            "say which task to run: --task, a number from 0 to %d",
            job->task_count - 1);
    if (!otx_value_int(text, 0, job->task_count - 1, &index))
        return otx_session_refuse(
            "--task takes a number from 0 to %d, not '%s'", job->task_count - 1,
            text);
    if (chdir(job->folder) != 0)
    {
        otx_session_refuse("the folder '%s' cannot be entered", job->folder);
        return OTX_EXIT_IO;
    }
    if (otx_task_parse(job, (int)index, &task))
        code = otx_dispatch(task.command, &task.values);
    otx_task_free(&task);
    return code;
}

int
otx_run_command_run(const otx_flag_values *values)
{
    otx_farm_job job;
    int code = read_job(values, &job);

    if (code != OTX_EXIT_OK)
        return code;
    code = run_task(values, &job);
    otx_farm_job_free(&job);
    return code;
}
