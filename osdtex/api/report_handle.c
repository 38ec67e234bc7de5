/* report_handle.c -- a report in memory, or in a file. */
#include "api/call.h"
#include "api/handle.h"
#include "api/report.h"
#include "api/report_figures.h"
#include "file/atomic_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "report";

struct osdtex_report
{
    otx_arena *arena;
    osdtex_report_info info;
};

/* The text in the arena of the call. MEMORY. */
static otx_status
print(otx_run *run, const json_t *root, const char **out)
{
    char *text = json_dumps(
        root, JSON_SORT_KEYS | JSON_INDENT(2) | JSON_REAL_PRECISION(9));

    *out = text ? otx_arena_strdup(run->arena, text) : NULL;
    free(text);
    return *out ? OSDTEX_OK : otx_fail_memory(run, STAGE);
}

static otx_status
create(
    otx_call *call, const osdtex_mapping *mapping,
    const osdtex_report_options *options, osdtex_report **out)
{
    osdtex_report_options ours = osdtex_report_options_default();
    otx_run *run = &call->run;
    osdtex_report *handle = OTX_ZNEW(run->arena, osdtex_report, 1);
    json_t *root;

    if (!handle)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    if (!mapping || ours.windows < 0 || ours.windows > 65536)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping is given, or windows are not 0 to 65536");
    OTX_TRY(otx_report_build(call, mapping, ours.windows, &root));
    OTX_TRY(print(run, root, &handle->info.json));
    OTX_TRY(otx_report_figures(
        run, root, &mapping->figures, &handle->info.figures,
        &handle->info.figure_count));
    handle->info.json_bytes = strlen(handle->info.json);
    handle->arena = run->arena;
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_report_create(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_report_options *options, osdtex_report **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_end(&call, create(&call, mapping, options, out), out);
}

const osdtex_report_info *
osdtex_report_describe(const osdtex_report *report)
{
    return report ? &report->info : NULL;
}

void
osdtex_report_destroy(osdtex_report *report)
{
    if (report)
        otx_arena_destroy(report->arena);
}

static otx_status
write_text(otx_run *run, const char *text, const char *path)
{
    otx_where where = OTX_NOWHERE;
    otx_atomic_file_set *set;
    const char *temporary;
    FILE *file;
    bool written;

    where.file = path;
    OTX_TRY(otx_atomic_file_begin(run, run->arena, &set));
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));
    file = fopen(temporary, "w");
    written = file && fputs(text, file) != EOF && fputc('\n', file) != EOF &&
              fflush(file) == 0;
    if (file && fclose(file) != 0)
        written = false;
    if (!written)
        return otx_fail(
            run, OSDTEX_ERROR_IO, STAGE, where,
            "the report cannot be written: %s", strerror(errno));
    return otx_atomic_file_commit(run, set, false);
}

static otx_status
write_report(otx_call *call, const osdtex_mapping *mapping, const char *path)
{
    const int32_t windows = osdtex_report_options_default().windows;
    otx_run *run = &call->run;
    const char *text;
    json_t *root;

    if (!mapping || !path)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping or no path is given");
    OTX_TRY(otx_report_build(call, mapping, windows, &root));
    OTX_TRY(print(run, root, &text));
    return write_text(run, text, path);
}

osdtex_status
osdtex_report_write(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, write_report(&call, mapping, path));
}
