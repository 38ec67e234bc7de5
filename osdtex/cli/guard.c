/* guard.c -- what is read must not be written, nor anything be written twice.
 */
#include "cli/guard.h"

#include "cli/also_flags.h"
#include "cli/saved_files.h"
#include "cli/stop.h"
#include "cli/value.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void
add(void *list, const char *path)
{
    otx_path_list_add(list, path);
}

/* A file, and what it names. */
static osdtex_status
add_file(
    osdtex_context *context, bool deep, otx_path_list *list, const char *path)
{
    const int count = list->count;
    osdtex_status status = OSDTEX_OK;

    if (!path || !*path)
        return OSDTEX_OK;
    if (deep || strchr(path, '<'))
        status = osdtex_file_references(context, path, add, list);
    /* It may be a pipe. */
    if (status == OSDTEX_OK && list->count == count)
        otx_path_list_add(list, path);
    return status;
}

/* The files of FILE,FILE,... */
static osdtex_status
add_listed(
    osdtex_context *context, bool deep, otx_path_list *list, const char *text)
{
    osdtex_status status = OSDTEX_OK;

    while (text && *text && status == OSDTEX_OK)
    {
        const size_t length = strcspn(text, ",");
        char *path = strndup(text, length);

        status =
            path ? add_file(context, deep, list, path) : OSDTEX_ERROR_MEMORY;
        free(path);
        text += length + (text[length] == ',');
    }
    return status;
}

osdtex_status
otx_guard_named(
    osdtex_context *context, const otx_flag_values *values, bool deep,
    otx_path_list *out)
{
    static const otx_flag_id files[] = {
        OTX_FLAG_MASK, OTX_FLAG_CONSTRAINTS, OTX_FLAG_FOR, OTX_FLAG_KEEP,
        OTX_FLAG_REST};
    osdtex_status status = OSDTEX_OK;

    for (int i = 0; i < values->operand_count && status == OSDTEX_OK; ++i)
        status = add_file(context, deep, out, values->operands[i]);
    for (int i = 0; i < 5 && status == OSDTEX_OK; ++i)
        status = add_file(context, deep, out, values->text[files[i]]);
    if (status == OSDTEX_OK)
        status = add_file(context, true, out, values->text[OTX_FLAG_PLACE]);
    for (int i = 0; i < values->also_count && status == OSDTEX_OK; ++i)
    {
        const char *file = otx_also_flags_file(values->also[i]);

        /* Of a folder its files are listed below. */
        if (!otx_path_list_is_folder(file))
            status = add_file(context, deep, out, file);
    }
    for (int i = 0; i < values->inputs.map_count && status == OSDTEX_OK; ++i)
        status = add_file(context, deep, out, values->inputs.maps[i]);
    if (status == OSDTEX_OK)
        status = add_listed(context, deep, out, values->text[OTX_FLAG_MASKS]);
    if (status == OSDTEX_OK)
        status = add_file(
            context, deep, out, otx_value_map_of(values->text[OTX_FLAG_ALONG]));
    if (status == OSDTEX_OK)
        status = add_file(context, deep, out, values->inputs.saved.path);
    /* Operands stand in the place of the first ones. */
    for (int i = values->operand_count;
         i < values->inputs.saved.count && status == OSDTEX_OK; ++i)
        status = add_file(context, deep, out, values->inputs.saved.files[i]);
    return status;
}

osdtex_status
otx_guard_inputs(
    osdtex_context *context, const otx_flag_values *values, otx_path_list *out)
{
    osdtex_status status = otx_guard_named(context, values, true, out);

    otx_path_list_add(out, values->job);
    if (status == OSDTEX_OK && otx_flag_is_taken(values, OTX_FLAG_COLORCONFIG))
        status = osdtex_colour_references(context, add, out);
    else
        otx_path_list_add(out, getenv("OCIO"));
    return status;
}

/* ---- places ---------------------------------------------------------------
 */

static bool
folder_is_writable(const otx_path *path)
{
    const char *slash = strrchr(path->name, '/');
    char *folder = slash ? strndup(path->name, (size_t)(slash - path->name) + 1)
                         : strdup(".");
    const bool fine = folder && access(folder, W_OK | X_OK) == 0;

    free(folder);
    return fine;
}

/* What speaks against writing there; NULL nothing. */
static const char *
obstacle(const otx_path *path)
{
    struct stat info;

    if (!folder_is_writable(path))
        return "cannot be written: its folder is not there or is read-only";
    if (lstat(path->name, &info) != 0)
        return errno == ENAMETOOLONG ? "cannot be written: its name is too long"
                                     : NULL;
    if (S_ISLNK(info.st_mode))
        return "is a link, which would be replaced by a file; remove it, or "
               "name the file itself";
    if (!S_ISREG(info.st_mode))
        return "is a folder or a device, not a file; give the output a name of "
               "its own";
    if (!(info.st_mode & 0222) || access(path->name, W_OK) != 0)
        return "is write-protected; make it writable, or choose another name "
               "for the output";
    return NULL;
}

/* ---------------------------------------------------------------------- */

static bool
is_listed_before(const otx_path_list *list, int i)
{
    for (int k = 0; k < i; ++k)
        if (otx_path_list_is_same(&list->items[k], &list->items[i]))
            return true;
    return false;
}

static osdtex_status
check_pairs(const otx_path_list *inputs, const otx_path_list *outputs)
{
    for (int i = 0; i < outputs->count; ++i)
    {
        const otx_path *one = &outputs->items[i];

        if (otx_path_list_find(inputs, one))
        {
            otx_session_refuse(
                "'%s' is an input and would be replaced; choose another name "
                "for the output",
                one->name);
            return OSDTEX_ERROR_ARGUMENT;
        }
        if (is_listed_before(outputs, i))
        {
            otx_session_refuse("'%s' would be written twice", one->name);
            return OSDTEX_ERROR_ARGUMENT;
        }
    }
    return OSDTEX_OK;
}

static osdtex_status
check_places(const otx_path_list *outputs)
{
    for (int i = 0; i < outputs->count; ++i)
    {
        const char *why = obstacle(&outputs->items[i]);

        if (!why)
            continue;
        otx_session_refuse("'%s' %s", outputs->items[i].name, why);
        return OSDTEX_ERROR_IO;
    }
    return OSDTEX_OK;
}

/* ---- whose files they are ------------------------------------------------
 */

/* What is known of the files that are there. */
typedef struct ownership
{
    const char *foreign;              /* made from something else; NULL none */
    char source[OSDTEX_SOURCE_BYTES]; /* from what */
    const char *unknown;              /* not made by osdtex; NULL none */
    bool is_ours;                     /* one of them was made from the same */
} ownership;

static bool
is_empty(const char *path)
{
    struct stat info;

    return stat(path, &info) != 0 || info.st_size == 0;
}

/* A file that a flag names in full is asked for by that name: only the model or
 * texture of another job is kept from it. */
static void
look_at(const char *path, bool is_named, const char *source, ownership *out)
{
    osdtex_output_mark mark;

    osdtex_outputs_inspect(path, false, &mark);
    if (!mark.is_ours)
    {
        if (!is_named && !is_empty(path))
            out->unknown = path;
    }
    else if (mark.source[0] && strcmp(mark.source, source) != 0)
    {
        if (is_named && !mark.job[0])
            return;
        out->foreign = path;
        strcpy(out->source, mark.source);
    }
    else
        out->is_ours = true;
}

static osdtex_status
check_owners(const otx_flag_values *values, const otx_path_list *outputs)
{
    const char *const named[] = {
        values->text[OTX_FLAG_PREVIEW], values->text[OTX_FLAG_JSON_REPORT]};
    const char *from = otx_saved_files_source(values);
    char source[OSDTEX_SOURCE_BYTES];
    ownership o = {0};

    if (values->text[OTX_FLAG_REPLACE] || !from)
        return OSDTEX_OK;
    osdtex_outputs_source(from, source);
    for (int i = 0; i < outputs->count; ++i)
    {
        const char *path = outputs->items[i].name;
        bool is_named = outputs->count == 1;

        for (int k = 0; k < 2; ++k)
            is_named |= named[k] && strcmp(named[k], path) == 0;
        look_at(path, is_named, source, &o);
    }
    if (o.foreign)
        otx_session_refuse(
            "'%s' belongs to another job: it was made from %s; choose another "
            "name for the output, or give --replace",
            o.foreign, o.source);
    else if (o.unknown && !o.is_ours)
        otx_session_refuse(
            "'%s' is there and was not made by osdtex; choose another name for "
            "the output, or give --replace",
            o.unknown);
    else
        return OSDTEX_OK;
    return OSDTEX_ERROR_ARGUMENT;
}

osdtex_status
otx_guard_check(
    otx_session *session, const otx_flag_values *values,
    const otx_path_list *outputs)
{
    otx_path_list inputs = {0};
    osdtex_status status;

    otx_stop_watch(outputs);
    status = otx_guard_inputs(session->context, values, &inputs);
    if (status == OSDTEX_OK && (inputs.out_of_memory || outputs->out_of_memory))
        status = OSDTEX_ERROR_MEMORY;
    if (status == OSDTEX_OK)
        status = check_pairs(&inputs, outputs);
    if (status == OSDTEX_OK)
        status = check_places(outputs);
    if (status == OSDTEX_OK)
        status = check_owners(values, outputs);
    otx_path_list_free(&inputs);
    return status;
}

osdtex_status
otx_guard_check_flags(otx_session *session, const otx_flag_values *values)
{
    otx_path_list outputs = {0};
    osdtex_status status;

    otx_path_list_add(&outputs, values->text[OTX_FLAG_OUTPUT]);
    otx_path_list_add(&outputs, values->text[OTX_FLAG_PREVIEW]);
    otx_path_list_add(&outputs, values->text[OTX_FLAG_JSON_REPORT]);
    status = otx_guard_check(session, values, &outputs);
    otx_path_list_free(&outputs);
    if (status != OSDTEX_OK)
        return status;
    return osdtex_outputs_mark(
        session->context, NULL, otx_saved_files_source(values));
}
