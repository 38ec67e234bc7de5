/* outputs_call.c -- files of several calls that appear together. */
#include "api/call.h"
#include "export/names.h"
#include "file/atomic_file.h"
#include "file/leftovers.h"
#include "file/temporary.h"

#include <string.h>

static const char STAGE[] = "write";

void
osdtex_outputs_drop(osdtex_context *context)
{
    if (!context)
        return;
    otx_arena_destroy(context->outputs_arena);
    context->outputs_arena = NULL;
    context->outputs = NULL;
}

static otx_status
begin(otx_call *call)
{
    if (!call->context->outputs)
        return otx_atomic_file_share(
            &call->run, call->run.arena, &call->context->outputs);
    return otx_fail(
        &call->run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
        "a set of outputs has been begun already; commit or drop it first");
}

osdtex_status
osdtex_outputs_begin(osdtex_context *context)
{
    otx_arena *arena = NULL; /* of the set, as of a handle */
    osdtex_status status;
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    status = begin(&call);
    arena = call.run.arena;
    status = otx_call_end(&call, status, &arena);
    if (status != OSDTEX_OK)
        return status;
    context->outputs_arena = arena;
    context->mark = (otx_mark){0};
    return status;
}

static otx_status
need_outputs(otx_call *call)
{
    if (call->context->outputs)
        return OSDTEX_OK;
    return otx_fail(
        &call->run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
        "no set of outputs has been begun");
}

osdtex_status
osdtex_outputs_mark(
    osdtex_context *context, const char *job, const char *source)
{
    otx_mark mark = {0};

    if (!context || (job && strlen(job) != sizeof mark.job - 1) ||
        (job && strspn(job, "0123456789abcdef") != sizeof mark.job - 1))
        return OSDTEX_ERROR_ARGUMENT;
    if (job)
        strcpy(mark.job, job);
    if (source)
        otx_mark_set_source(&mark, source);
    context->mark = mark;
    return OSDTEX_OK;
}

void
osdtex_outputs_source(const char *path, char source[OSDTEX_SOURCE_BYTES])
{
    otx_mark mark = {0};

    otx_mark_set_source(&mark, path);
    strcpy(source, mark.source);
}

void
osdtex_outputs_word(char *name)
{
    if (name)
        otx_names_make_word(name);
}

void
osdtex_outputs_inspect(
    const char *path, bool check_seal, osdtex_output_mark *out)
{
    otx_mark_found found;

    *out = (osdtex_output_mark){0};
    if (!path || !otx_mark_read(path, check_seal, &found))
        return;
    strcpy(out->job, found.mark.job);
    strcpy(out->source, found.mark.source);
    out->is_whole = found.is_whole;
    out->is_ours = true;
}

static otx_status
add(otx_call *call, const char *path, const char **temporary)
{
    OTX_TRY(need_outputs(call));
    OTX_TRY(otx_atomic_file_add(
        &call->run, call->context->outputs, path, temporary));
    return otx_atomic_file_commit(&call->run, call->context->outputs, false);
}

osdtex_status
osdtex_outputs_add(
    osdtex_context *context, const char *path, const char **temporary)
{
    otx_call call;

    if (!path || !temporary)
        return OSDTEX_ERROR_ARGUMENT;
    *temporary = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, add(&call, path, temporary));
}

static otx_status
seal(otx_call *call)
{
    OTX_TRY(need_outputs(call));
    return otx_atomic_file_seal(&call->run, call->context->outputs);
}

osdtex_status
osdtex_outputs_seal(osdtex_context *context)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, seal(&call));
}

/* The last moment to stop: from here on there is no way back. */
static otx_status
commit(otx_call *call)
{
    OTX_TRY(seal(call));
    OTX_TRY(otx_progress(&call->run, STAGE, 1.0));
    return otx_atomic_file_publish(&call->run, call->context->outputs);
}

osdtex_status
osdtex_outputs_commit(osdtex_context *context)
{
    osdtex_status status;
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    status = otx_call_drop(&call, commit(&call));
    osdtex_outputs_drop(context);
    return status;
}

void
osdtex_outputs_sweep(const char *path)
{
    if (path)
        otx_leftovers_sweep_own(path);
}
