/* context.c -- the context, its findings, and what needs no context. */
#include "api/call.h"
#include "base/build.h"
#include "base/clock.h"
#include "base/hash.h"

#include <stdlib.h>

enum
{
    MAX_THREADS = 256
};

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

const char *
osdtex_version(void)
{
    return TEXT(OSDTEX_VERSION_MAJOR) "." TEXT(OSDTEX_VERSION_MINOR) "." TEXT(
        OSDTEX_VERSION_PATCH);
}

const char *
osdtex_build(void)
{
    return otx_build();
}

const char *
osdtex_status_name(osdtex_status status)
{
    static const char *const names[] = {
        "OK", "ARGUMENT", "FORMAT",    "TOPOLOGY", "LIMIT",  "NUMERIC",
        "IO", "MEMORY",   "CANCELLED", "SUPPORT",  "COLOUR", "INTERNAL"};
    const int32_t count = (int32_t)(sizeof names / sizeof names[0]);

    return status <= 0 && status > -count ? names[-status] : "UNKNOWN";
}

void
osdtex_hash(const void *data, size_t bytes, char text[OSDTEX_HASH_BYTES])
{
    otx_hash_text(data, bytes, text);
}

/* A copy of the words that the host was run with; false when memory is out. */
static bool
copy_arguments(osdtex_context *context)
{
    osdtex_context_options *options = &context->options;
    const int32_t count = options->arguments ? options->argument_count : 0;
    const char **words = OTX_NEW(context->arena, const char *, count);

    for (int32_t i = 0; words && i < count; ++i)
    {
        words[i] = otx_arena_strdup(context->arena, options->arguments[i]);
        if (!words[i])
            return false;
    }
    options->arguments = words;
    options->argument_count = count;
    return words != NULL;
}

/* Makes what `context` is missing; false when memory is out. */
static bool
furnish(osdtex_context *context)
{
    const osdtex_context_options *options = &context->options;
    const otx_allocator_hooks hooks = {
        options->alloc, options->release, options->alloc_user,
        options->memory_limit};

    context->allocator = otx_allocator_create(&hooks);
    if (!context->allocator)
        return false;
    context->arena = otx_arena_create(context->allocator);
    context->scratch = otx_arena_create(context->allocator);
    context->pool = otx_pool_create(context->allocator, options->threads);
    context->diagnostics = otx_diagnostics_create(context->allocator);
    if (!context->arena || !context->scratch || !context->pool ||
        !context->diagnostics)
        return false;
    context->begun = otx_clock_now();
    if (!copy_arguments(context))
        return false;
    if (options->colorconfig)
    {
        context->options.colorconfig =
            otx_arena_strdup(context->arena, options->colorconfig);
        if (!context->options.colorconfig)
            return false;
    }
    otx_diagnostics_listen(
        context->diagnostics, options->log, options->log_user);
    return true;
}

osdtex_status
osdtex_context_create(
    const osdtex_context_options *options, osdtex_context **out)
{
    osdtex_context_options ours = osdtex_context_options_default();
    osdtex_context *context;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    /* There is nowhere to put a sentence yet; with a size that makes sense
     * otx_call_options does not ask for a run. */
    if (options &&
        (options->size < sizeof options->size || options->size > 65536))
        return OSDTEX_ERROR_ARGUMENT;
    OTX_TRY(otx_call_options(NULL, &ours, sizeof ours, options));
    if (ours.threads < 0 || ours.threads > MAX_THREADS ||
        ours.argument_count < 0 || !ours.alloc != !ours.release)
        return OSDTEX_ERROR_ARGUMENT;
    context = calloc(1, sizeof *context);
    if (!context)
        return OSDTEX_ERROR_MEMORY;
    context->options = ours;
    if (!furnish(context))
    {
        osdtex_context_destroy(context);
        return OSDTEX_ERROR_MEMORY;
    }
    *out = context;
    return OSDTEX_OK;
}

void
osdtex_context_destroy(osdtex_context *context)
{
    if (!context)
        return;
    osdtex_outputs_drop(context);
    otx_pool_destroy(context->pool);
    otx_arena_destroy(context->scratch);
    otx_arena_destroy(context->arena);
    otx_diagnostics_destroy(context->diagnostics);
    otx_allocator_destroy(context->allocator);
    free(context);
}

const osdtex_diagnostic *
osdtex_context_error(const osdtex_context *context)
{
    static const osdtex_diagnostic no_context = {
        .severity = OSDTEX_SEVERITY_ERROR,
        .status = OSDTEX_ERROR_ARGUMENT,
        .stage = "context",
        .face = -1,
        .vertex = -1,
        .count = 1,
        .message = "no context is given",
        .marked = "no context is given",
    };

    return context ? otx_diagnostics_error(context->diagnostics) : &no_context;
}

int32_t
osdtex_diagnostic_count(const osdtex_context *context)
{
    return context ? otx_diagnostics_count(context->diagnostics) : 0;
}

osdtex_status
osdtex_diagnostic_get(
    const osdtex_context *context, int32_t index, osdtex_diagnostic *out)
{
    if (!out || index < 0 || index >= osdtex_diagnostic_count(context))
        return OSDTEX_ERROR_ARGUMENT;
    otx_diagnostics_get(context->diagnostics, index, out);
    return OSDTEX_OK;
}

osdtex_status
osdtex_diagnostic_clear(osdtex_context *context)
{
    otx_diagnostics *fresh;

    if (!context)
        return OSDTEX_ERROR_ARGUMENT;
    fresh = otx_diagnostics_create(context->allocator);
    if (!fresh)
        return OSDTEX_ERROR_MEMORY;
    otx_diagnostics_listen(
        fresh, context->options.log, context->options.log_user);
    otx_diagnostics_destroy(context->diagnostics);
    context->diagnostics = fresh;
    return OSDTEX_OK;
}
