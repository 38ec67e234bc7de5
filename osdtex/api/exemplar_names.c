/* exemplar_names.c -- from the names of files to numbers. */
#include "api/exemplar_names.h"

#include <stdio.h>
#include <string.h>

static const char STAGE[] = "constraints";

static const char *
file_of(const otx_exemplar *exemplar)
{
    const char *path = exemplar->source_path;
    const char *slash = path ? strrchr(path, '/') : NULL;

    return !path ? "in memory" : slash ? slash + 1 : path;
}

static bool
is_named(const otx_exemplar *exemplar, const char *name)
{
    const char *path = exemplar->source_path;
    const char *file = file_of(exemplar);
    const char *dot = strrchr(file, '.');

    if (!path)
        return false;
    return strcmp(name, path) == 0 || strcmp(name, file) == 0 ||
           (dot && strlen(name) == (size_t)(dot - file) &&
            strncmp(name, file, strlen(name)) == 0);
}

/* "1 'a.png', 2 'b.png'" */
static void
list_names(
    const otx_exemplar *exemplars, int32_t count, char *text, size_t bytes)
{
    size_t at = 0;

    for (int32_t k = 0; k < count && at + 1 < bytes; ++k)
        at += (size_t)snprintf(
            text + at, bytes - at, "%s%d '%.60s'", k > 0 ? ", " : "",
            (int)k + 1, file_of(&exemplars[k]));
}

static otx_status
refuse(
    otx_run *run, const otx_constraint_set *set, int32_t index,
    const char *wanted, const otx_exemplar *exemplars, int32_t count)
{
    char known[512];

    list_names(exemplars, count, known, sizeof known);
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, otx_where_file(set->path),
        "constraint %d asks for exemplar %.80s, which is not one of %s; {also} "
        "gives more, and a number tells apart what has one name",
        (int)index + 1, wanted, known);
}

static otx_status
resolve(
    otx_run *run, const otx_exemplar *exemplars, int32_t count,
    const otx_constraint_set *set, int32_t index, otx_constraint *item)
{
    char number[16];
    int32_t found = 0;

    if (!item->exemplar_name)
    {
        snprintf(number, sizeof number, "%d", (int)item->exemplar);
        return item->exemplar <= count
                   ? OSDTEX_OK
                   : refuse(run, set, index, number, exemplars, count);
    }
    for (int32_t k = 0; k < count; ++k)
        if (is_named(&exemplars[k], item->exemplar_name))
        {
            item->exemplar = k + 1;
            ++found;
        }
    return found == 1
               ? OSDTEX_OK
               : refuse(run, set, index, item->exemplar_name, exemplars, count);
}

otx_status
otx_exemplar_names_resolve(
    otx_run *run, const otx_exemplar *exemplars, int32_t count,
    const otx_constraint_set **set)
{
    otx_constraint_set *copy;
    otx_constraint *items;

    if (!*set || (*set)->count == 0)
        return OSDTEX_OK;
    copy = OTX_NEW(run->arena, otx_constraint_set, 1);
    items = OTX_NEW(run->arena, otx_constraint, (*set)->count);
    OTX_TRY(otx_run_ok(run));
    memcpy(items, (*set)->items, (size_t)(*set)->count * sizeof *items);
    for (int32_t i = 0; i < (*set)->count; ++i)
        OTX_TRY(resolve(run, exemplars, count, *set, i, &items[i]));
    *copy = **set;
    copy->items = items;
    *set = copy;
    return OSDTEX_OK;
}
