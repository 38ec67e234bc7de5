/* task.c -- a task of a job is a command line. */
#include "cli/task.h"

#include "cli/map_request.h"
#include "cli/session.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool
copy_words(const otx_job *job, int index, otx_task *task)
{
    json_t *words = otx_job_words(job, index);
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
otx_task_parse(const otx_job *job, int index, otx_task *out)
{
    *out = (otx_task){.command = otx_command_find(otx_job_command(job, index))};
    if (!copy_words(job, index, out))
    {
        otx_session_refuse("memory is out");
        return false;
    }
    if (!otx_flag_parse(
            out->argc, out->argv, out->command->flags, &out->values))
        return false;
    out->values.job = job->path;
    if (out->values.operand_count >= out->command->operands_min &&
        out->values.operand_count <= out->command->operands_max)
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

/* ---- two tasks, one file --------------------------------------------------
 */

/* A file and the task that writes it. */
typedef struct output
{
    const otx_path *path;
    int task;
    bool is_shared; /* by all tasks that bake tiles of one asset */
} output;

typedef struct all_outputs
{
    otx_path_list paths;
    int *tasks;       /* [task_count + 1] where the paths of each begin */
    bool *are_shared; /* [task_count] */
} all_outputs;

/* Of a tile only its own textures; the texts are like those of other tiles. */
static bool
add_outputs(const otx_job *job, int index, all_outputs *all)
{
    otx_map_request *request = malloc(sizeof *request);
    otx_task task;
    bool fine = request && otx_task_parse(job, index, &task);

    if (!request)
        return false;
    fine = fine &&
           otx_map_request_parse(
               &task.values, strcmp(task.command->name, "bake") == 0, request);
    if (fine)
        otx_map_request_outputs(request, &all->paths);
    all->are_shared[index] = fine && request->bake_options.udim != 0;
    all->tasks[index + 1] = all->paths.count;
    otx_task_free(&task);
    free(request);
    if (!fine)
        otx_session_refuse(
            "task %d of the job, '%s', is wrong", index,
            otx_job_task_name(job, index));
    return fine;
}

static int
order(const void *a, const void *b)
{
    const output *p = a, *q = b;
    const int order = otx_path_list_order(p->path, q->path);

    return order != 0 ? order : p->task - q->task;
}

static bool
is_clash(const output *a, const output *b)
{
    return otx_path_list_is_same(a->path, b->path) && a->task != b->task &&
           !(a->is_shared && b->is_shared);
}

static bool
are_apart(const otx_job *job, const all_outputs *all)
{
    const size_t count = (size_t)all->paths.count;
    output *list = calloc(count + 1, sizeof *list);
    const output *found = NULL; /* the first that the job comes to */
    bool apart;

    for (int task = 0; list && task < job->task_count; ++task)
        for (int i = all->tasks[task]; i < all->tasks[task + 1]; ++i)
            list[i] =
                (output){&all->paths.items[i], task, all->are_shared[task]};
    if (list)
        qsort(list, count, sizeof *list, order);
    for (size_t i = 1; list && i < count; ++i)
        if (is_clash(&list[i - 1], &list[i]) &&
            (!found || list[i].path < found[1].path))
            found = &list[i - 1];
    if (found)
        otx_session_refuse(
            "tasks %d ('%s') and %d ('%s') would both write '%s'",
            found[0].task, otx_job_task_name(job, found[0].task), found[1].task,
            otx_job_task_name(job, found[1].task), found[1].path->name);
    apart = list && !found;
    free(list);
    return apart;
}

/* Names in a job are seen from its folder. */
bool
otx_task_are_apart(const otx_job *job)
{
    const int here = open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const size_t count = (size_t)job->task_count;
    all_outputs all = {
        .tasks = calloc(count + 1, sizeof *all.tasks),
        .are_shared = calloc(count, sizeof *all.are_shared)};
    bool fine =
        all.tasks && all.are_shared && here >= 0 && chdir(job->folder) == 0;

    if (!fine)
        otx_session_refuse("the folder '%s' cannot be entered", job->folder);
    for (int i = 0; fine && i < job->task_count; ++i)
        fine = add_outputs(job, i, &all);
    fine = fine && are_apart(job, &all);
    if (here >= 0 && fchdir(here) != 0)
        fine = false;
    if (here >= 0)
        close(here);
    otx_path_list_free(&all.paths);
    free(all.tasks);
    free(all.are_shared);
    return fine;
}
