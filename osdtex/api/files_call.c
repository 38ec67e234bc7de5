/* files_call.c -- what files and colour configurations depend on. */
#include "api/call.h"
#include "base/hash.h"
#include "file/references.h"

#include <stdio.h>
#include <stdlib.h>

static const char STAGE[] = "files";

static otx_status
visit_references(
    otx_run *run, const char *path, osdtex_file_visitor visit, void *user)
{
    if (otx_references_visit(path, visit, user) != OSDTEX_OK)
        return otx_fail_memory(run, STAGE);
    return OSDTEX_OK;
}

osdtex_status
osdtex_file_references(
    osdtex_context *context, const char *path, osdtex_file_visitor visit,
    void *user)
{
    otx_call call;

    if (!path || !visit)
        return OSDTEX_ERROR_ARGUMENT;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, visit_references(&call.run, path, visit, user));
}

/* ---- colour ---------------------------------------------------------------
 */

static otx_status
visit_needs(
    otx_call *call, void (*visit)(void *, otx_ocio_need, const char *),
    void *user, const char **path)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    const otx_colour *colour;

    OTX_TRY(otx_call_colour(call, &colour));
    if (path)
        *path = colour->path;
    if (otx_ocio_visit_needs(colour->config, visit, user, message) == OSDTEX_OK)
        return OSDTEX_OK;
    return otx_fail(
        &call->run, OSDTEX_ERROR_COLOUR, STAGE, otx_where_file(colour->path),
        "what the colour configuration depends on cannot be found out: %s",
        message);
}

typedef struct file_filter
{
    osdtex_file_visitor visit;
    void *user;
} file_filter;

static void
pass_file(void *user, otx_ocio_need need, const char *text)
{
    const file_filter *filter = user;

    if (need == OTX_OCIO_NEED_FILE)
        filter->visit(filter->user, text);
}

static otx_status
visit_colour_files(otx_call *call, file_filter filter)
{
    const char *asked = call->context->options.colorconfig;
    const char *path = NULL;

    if (!(asked && *asked) && !(getenv("OCIO") && *getenv("OCIO")))
        return OSDTEX_OK;
    OTX_TRY(visit_needs(call, pass_file, &filter, &path));
    if (path)
        filter.visit(filter.user, path);
    return OSDTEX_OK;
}

osdtex_status
osdtex_colour_references(
    osdtex_context *context, osdtex_file_visitor visit, void *user)
{
    otx_call call;

    if (!visit)
        return OSDTEX_ERROR_ARGUMENT;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(
        &call, visit_colour_files(&call, (file_filter){visit, user}));
}

/* A table counts by its bytes, wherever it was found. */
static void
put_need(void *user, otx_ocio_need need, const char *text)
{
    char hash[OTX_HASH_TEXT_BYTES];
    FILE *words = user;

    if (need == OTX_OCIO_NEED_FILE)
        text = otx_hash_file(text, hash) ? hash : "unreadable";
    fprintf(words, "%d %s\n", (int)need, text);
}

static otx_status
hash_colour(otx_call *call, char hash[OSDTEX_HASH_BYTES])
{
    char *text = NULL;
    size_t bytes = 0;
    FILE *words = open_memstream(&text, &bytes);
    otx_status status = words ? visit_needs(call, put_need, words, NULL)
                              : otx_fail_memory(&call->run, STAGE);

    if (words && fclose(words) != 0 && status == OSDTEX_OK)
        status = otx_fail_memory(&call->run, STAGE);
    if (status == OSDTEX_OK)
        otx_hash_text(text, bytes, hash);
    free(text);
    return status;
}

osdtex_status
osdtex_colour_hash(osdtex_context *context, char hash[OSDTEX_HASH_BYTES])
{
    otx_call call;

    if (!hash)
        return OSDTEX_ERROR_ARGUMENT;
    hash[0] = '\0';
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, hash_colour(&call, hash));
}
