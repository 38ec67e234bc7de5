/* farm_job.c -- reading a job, checking it as a whole before a farm has it. */
#include "farm/farm_job.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool refuse(char *error, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool
refuse(char *error, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(error, OTX_FARM_JOB_ERROR_BYTES, format, arguments);
    va_end(arguments);
    return false;
}

static json_t *
task_at(const otx_farm_job *job, int task)
{
    return json_array_get(json_object_get(job->root, "tasks"), (size_t)task);
}

static const char *
text_at(const otx_farm_job *job, int task, const char *key)
{
    return json_string_value(json_object_get(task_at(job, task), key));
}

const char *
otx_farm_job_command(const otx_farm_job *job, int task)
{
    return text_at(job, task, "command");
}

const char *
otx_farm_job_task_name(const otx_farm_job *job, int task)
{
    return text_at(job, task, "name");
}

json_t *
otx_farm_job_words(const otx_farm_job *job, int task)
{
    json_t *given = json_object_get(task_at(job, task), "arguments");
    const char *text = json_string_value(given);
    json_t *words;

    if (json_is_array(given))
        return json_copy(given);
    words = json_array();
    while (text && *(text += strspn(text, " ")) != '\0')
    {
        const size_t length = strcspn(text, " ");

        json_array_append_new(words, json_stringn(text, length));
        text += length;
    }
    return words;
}

/* Names stand in scripts and file names of engines. */
static bool
is_plain(const char *name)
{
    if (!name || !*name || strlen(name) > 100 || name[0] == '-')
        return false;
    for (; *name; ++name)
        if (!(*name >= 'a' && *name <= 'z') &&
            !(*name >= 'A' && *name <= 'Z') &&
            !(*name >= '0' && *name <= '9') && !strchr("._-", *name))
            return false;
    return true;
}

/* Only commands that know whether they are done: a farm runs tasks again. */
static bool
check_task(const otx_farm_job *job, int task, char *error)
{
    const char *command = otx_farm_job_command(job, task);
    json_t *words = otx_farm_job_words(job, task), *word;
    bool texts = json_array_size(words) > 0;
    size_t i;

    json_array_foreach(words, i, word)
    {
        texts = texts && json_is_string(word);
    }
    json_decref(words);
    if (!command ||
        (strcmp(command, "map") != 0 && strcmp(command, "bake") != 0))
        return refuse(
            error, "task %d: \"command\" is \"map\" or \"bake\"", task);
    if (!texts)
        return refuse(
            error, "task %d: \"arguments\" is a text or a list of texts", task);
    if (!is_plain(otx_farm_job_task_name(job, task)))
        return refuse(
            error, "task %d: \"name\" is letters, digits, '.', '_' and '-'",
            task);
    return true;
}

/* Engines and log files know no blanks. */
static bool
take_name(otx_farm_job *job)
{
    const char *name = json_string_value(json_object_get(job->root, "name"));

    if (!name || strlen(name) >= sizeof job->plain_name)
        return false;
    strcpy(job->plain_name, name);
    for (char *c = job->plain_name; *c; ++c)
        if (*c == ' ')
            *c = '_';
    job->name = job->plain_name;
    return is_plain(job->name);
}

static bool
check(otx_farm_job *job, char *error)
{
    const json_t *tasks = json_object_get(job->root, "tasks");
    const json_t *threads = json_object_get(job->root, "threads");

    if (!take_name(job))
        return refuse(
            error,
            "the job needs a \"name\" of letters, digits, blanks, '.', '_' and "
            "'-'");
    if (!json_is_array(tasks) || json_array_size(tasks) == 0 ||
        json_array_size(tasks) > OTX_FARM_JOB_TASKS_MAX)
        return refuse(
            error, "the job has no \"tasks\": a list of 1 to %d",
            OTX_FARM_JOB_TASKS_MAX);
    if (threads &&
        (!json_is_integer(threads) || json_integer_value(threads) < 0 ||
         json_integer_value(threads) > 256))
        return refuse(error, "the job's \"threads\" is a number up to 256");
    job->threads = (int)json_integer_value(threads);
    job->task_count = (int)json_array_size(tasks);
    for (int i = 0; i < job->task_count; ++i)
        if (!check_task(job, i, error))
            return false;
    return true;
}

bool
otx_farm_job_read(
    const char *path, otx_farm_job *out, char error[OTX_FARM_JOB_ERROR_BYTES])
{
    char *whole = realpath(path, NULL);
    json_error_t wrong;

    *out = (otx_farm_job){0};
    if (!whole || strlen(whole) >= OTX_FARM_JOB_PATH_BYTES)
    {
        free(whole);
        return refuse(error, "'%.300s' cannot be found", path);
    }
    snprintf(out->path, sizeof out->path, "%s", whole);
    snprintf(
        out->folder, sizeof out->folder, "%.*s",
        (int)(strrchr(whole, '/') - whole), whole);
    free(whole);
    out->root = json_load_file(path, JSON_REJECT_DUPLICATES, &wrong);
    if (!out->root)
        return refuse(error, "%.300s:%d: %s", path, wrong.line, wrong.text);
    if (check(out, error))
        return true;
    otx_farm_job_free(out);
    return false;
}

void
otx_farm_job_free(otx_farm_job *job)
{
    json_decref(job->root);
    *job = (otx_farm_job){0};
}
