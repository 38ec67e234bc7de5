/* task_files.c -- what each task of a job reads and writes, compared. */
#include "cli/task_files.h"

#include "cli/guard.h"
#include "cli/map_flags.h"
#include "cli/saved_files.h"
#include "cli/task.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A file and a task that reads or writes it. */
typedef struct use
{
    const otx_path *path;
    int task, place; /* and which of its files it is */
    bool is_input;
    bool is_shared; /* by all tasks that bake tiles of one asset */
} use;

/* Of one task. */
typedef struct task_files
{
    otx_path_list inputs, outputs;
    bool is_shared;
} task_files;

/* Says nothing: a farm may hold files that this machine does not. */
static osdtex_status
look_for_files(
    osdtex_context *context, otx_flag_values *values, otx_map_flags *r)
{
    otx_session silent = {.context = context, .values = values};
    osdtex_status status;

    /* Where it is not there yet, a texture of its own is all that is known. */
    if (!values->inputs.saved.path ||
        access(values->inputs.saved.path, R_OK) != 0 ||
        otx_saved_files_take(&silent, &values->inputs.saved) != OSDTEX_OK)
        values->inputs.saved.exemplars += values->inputs.saved.exemplars == 0;
    status = otx_material_flags_take(
        &silent, values, 1, &r->exemplar_options, &r->material);
    if (status == OSDTEX_ERROR_ARGUMENT)
        return status;
    otx_also_flags_find(context, &values->inputs, &r->also);
    return values->inputs.saved.path && !otx_map_flags_name(r)
               ? OSDTEX_ERROR_ARGUMENT
               : OSDTEX_OK;
}

/* Of a tile only its own textures; the texts are like those of other tiles. */
static bool
list_files(
    osdtex_context *context, otx_task *task, otx_map_flags *r, task_files *out)
{
    otx_flag_values *values = &task->values;
    bool fine = otx_map_flags_parse(
        values, strcmp(task->command->name, "bake") == 0, r);

    fine = fine && look_for_files(context, values, r) == OSDTEX_OK;
    if (fine)
        otx_map_flags_outputs(r, &out->outputs);
    fine = fine &&
           otx_guard_named(context, values, false, &out->inputs) == OSDTEX_OK;
    out->is_shared = fine && r->bake_options.udim != 0;
    otx_material_flags_destroy(&r->material);
    otx_also_flags_destroy(&r->also);
    otx_saved_files_free(&values->inputs.saved);
    return fine && !out->inputs.out_of_memory && !out->outputs.out_of_memory;
}

static bool
list_task(
    osdtex_context *context, const otx_farm_job *job, int index,
    task_files *out)
{
    otx_map_flags *request = calloc(1, sizeof *request);
    otx_task task;
    bool fine = request && otx_task_parse(job, index, &task);

    if (!request)
        return false;
    fine = fine && list_files(context, &task, request, out);
    otx_task_free(&task);
    free(request);
    if (!fine)
        otx_session_refuse(
            "task %d of the job, '%s', is wrong", index,
            otx_farm_job_task_name(job, index));
    return fine;
}

/* ---- comparing ------------------------------------------------------------
 */

/* Of one file those that write it come first, in the order of tasks. */
static int
order(const void *a, const void *b)
{
    const use *p = a, *q = b;
    const int order = otx_path_list_order(p->path, q->path);

    return order != 0                   ? order
           : p->is_input != q->is_input ? p->is_input - q->is_input
                                        : p->task - q->task;
}

static bool
is_clash(const use *a, const use *b)
{
    return !(a->is_input && b->is_input) && a->task != b->task &&
           !(a->is_shared && b->is_shared && !a->is_input && !b->is_input) &&
           otx_path_list_is_same(a->path, b->path);
}

/* Whether a job comes to a pair before another. */
static bool
is_earlier(const use *a, const use *b, const use than[2])
{
    const int one = a->task > b->task ? a->task : b->task;
    const int other = than[0].task > than[1].task ? than[0].task : than[1].task;

    return one != other ? one < other : b->place < than[1].place;
}

/* The clash that the job comes to first; false none. */
static bool
find_clash(const use *list, size_t count, use out[2])
{
    size_t first = 0; /* use of the file */
    bool found = false;

    for (size_t i = 1; i < count; ++i)
    {
        const use *pairs[] = {&list[first], &list[i - 1]};

        if (!otx_path_list_is_same(list[first].path, list[i].path))
            first = i;
        for (int k = 0; k < 2; ++k)
            if (is_clash(pairs[k], &list[i]) &&
                (!found || is_earlier(pairs[k], &list[i], out)))
            {
                out[0] = *pairs[k];
                out[1] = list[i];
                found = true;
            }
    }
    return found;
}

static void
refuse(const otx_farm_job *job, const use pair[2])
{
    const use *a = &pair[0], *b = &pair[1];

    if (b->is_input)
        otx_session_refuse(
            "task %d ('%s') reads '%s', which task %d ('%s') writes, and a "
            "farm runs tasks in any order; make them two jobs",
            b->task, otx_farm_job_task_name(job, b->task), b->path->name,
            a->task, otx_farm_job_task_name(job, a->task));
    else
        otx_session_refuse(
            "tasks %d ('%s') and %d ('%s') would both write '%s'", a->task,
            otx_farm_job_task_name(job, a->task), b->task,
            otx_farm_job_task_name(job, b->task), b->path->name);
}

static size_t
put_uses(
    const otx_path_list *paths, int task, bool is_input, bool is_shared,
    use *out)
{
    for (int i = 0; i < paths->count; ++i)
        out[i] = (use){&paths->items[i], task, i, is_input, is_shared};
    return (size_t)paths->count;
}

static bool
are_apart(const otx_farm_job *job, const task_files *tasks)
{
    size_t count = 0;
    use *list, found[2] = {{0}};
    bool apart;

    for (int i = 0; i < job->task_count; ++i)
        count += (size_t)(tasks[i].inputs.count + tasks[i].outputs.count);
    list = calloc(count + 1, sizeof *list);
    count = 0;
    for (int i = 0; list && i < job->task_count; ++i)
    {
        const task_files *t = &tasks[i];

        count += put_uses(&t->outputs, i, false, t->is_shared, list + count);
        count += put_uses(&t->inputs, i, true, false, list + count);
    }
    if (list)
        qsort(list, count, sizeof *list, order);
    apart = list && !find_clash(list, count, found);
    if (list && !apart)
        refuse(job, found);
    free(list);
    return apart;
}

/* Names in a job are seen from its folder. */
bool
otx_task_files_are_apart(const otx_farm_job *job)
{
    const int here = open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    task_files *tasks = calloc((size_t)job->task_count, sizeof *tasks);
    osdtex_context *context = NULL;
    bool fine = tasks && here >= 0 && chdir(job->folder) == 0;

    if (!fine)
        otx_session_refuse("the folder '%s' cannot be entered", job->folder);
    fine = fine && osdtex_context_create(NULL, &context) == OSDTEX_OK;
    for (int i = 0; fine && i < job->task_count; ++i)
        fine = list_task(context, job, i, &tasks[i]);
    fine = fine && are_apart(job, tasks);
    osdtex_context_destroy(context);
    if (here >= 0 && fchdir(here) != 0)
        fine = false;
    if (here >= 0)
        close(here);
    for (int i = 0; tasks && i < job->task_count; ++i)
    {
        otx_path_list_free(&tasks[i].inputs);
        otx_path_list_free(&tasks[i].outputs);
    }
    free(tasks);
    return fine;
}
