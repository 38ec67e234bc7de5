/* colour.c -- opening a colour configuration, finding spaces in it, and
 * converting pictures with it. */
#include "colour/colour.h"

#include "colour/few_values.h"
#include "word/near.h"

#include <stdio.h>

static const char stage[] = "colour";

static const char *
name_at(const void *list, int32_t index)
{
    return otx_ocio_name(list, index);
}

otx_status
otx_colour_find(
    otx_run *run, const otx_colour *colour, const char *what, const char *name,
    const char **space)
{
    char near[256];

    *space = otx_ocio_find(colour->config, name);
    if (*space)
        return OSDTEX_OK;
    otx_near_text(name, name_at, colour->config, near);
    if (!near[0])
        snprintf(
            near, sizeof near, "; it has '%.60s', '%.60s' and others",
            otx_ocio_space_name(colour->config, 0),
            otx_ocio_space_name(colour->config, 1));
    return otx_fail(
        run, OSDTEX_ERROR_COLOUR, stage, otx_where_file(colour->path),
        "%s: the colour configuration has no space '%s'%s; `osdtex info%s%s` "
        "lists all",
        what, name, near, colour->path ? " " : "",
        colour->path ? colour->path : "");
}

static void
close_config(void *config)
{
    otx_ocio_close(config);
}

static otx_status
fail_open(otx_run *run, const otx_colour *colour, const char *message)
{
    return otx_fail(
        run, OSDTEX_ERROR_COLOUR, stage, otx_where_file(colour->path),
        "the colour configuration cannot be used: %s", message);
}

/* A configuration that OpenColorIO carries, or what stands in for it. */
static otx_status
open_carried(otx_run *run, const char *path, otx_ocio **out, char *message)
{
    char version[OTX_OCIO_MESSAGE_BYTES];
    const otx_status status =
        otx_ocio_open_carried(path, out, message, version);

    if (status == OSDTEX_OK && version[0])
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, stage, otx_where_file(path),
            "OpenColorIO %s carries no configurations of its own, which 2.2 "
            "and "
            "later do; osdtex's few spaces stand in for it, with ACEScg as "
            "scene_linear as there: give the file of the configuration for the "
            "others",
            version);
    return status;
}

otx_status
otx_colour_open(
    otx_run *run, const char *path, const char *environment, otx_colour *out)
{
    const bool asked = path && path[0];
    const char *file = asked ? path : environment;
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *config = NULL;
    otx_status status;

    *out = (otx_colour){0};
    if (file && file[0])
    {
        out->path = otx_arena_strdup(run->arena, file);
        OTX_TRY(otx_run_ok(run));
        status = otx_ocio_is_carried(out->path)
                     ? open_carried(run, out->path, &config, message)
                     : otx_ocio_open(out->path, &config, message);
    }
    else
        status = otx_ocio_open_builtin(&config, message);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(run, stage);
    if (status != OSDTEX_OK)
        return fail_open(run, out, message);
    if (!otx_arena_defer(run->arena, close_config, config))
    {
        otx_ocio_close(config);
        return otx_fail_memory(run, stage);
    }
    out->config = config;
    out->is_from_environment = out->path && !asked;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, OTX_NOWHERE, "configuration: %s (%s)",
        out->path ? out->path : "built in",
        asked       ? "asked for"
        : out->path ? "from $OCIO"
                    : "neither asked for nor in $OCIO");
    if (otx_ocio_validate(config, message) != OSDTEX_OK)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, stage, otx_where_file(out->path),
            "OpenColorIO finds a fault in the configuration: %s; spaces that "
            "need the faulty part will fail",
            message);
    return OSDTEX_OK;
}

static void
destroy_conversion(void *conversion)
{
    otx_ocio_conversion_destroy(conversion);
}

typedef struct convert_job
{
    const otx_ocio_conversion *conversion;
    const otx_image *image;
    bool is_apart;                            /* a curve for each channel */
    char (*messages)[OTX_OCIO_MESSAGE_BYTES]; /* one a worker */
} convert_job;

static otx_status
convert_row(void *context, int64_t y, otx_worker *worker)
{
    const convert_job *job = context;
    const otx_image *image = job->image;
    float *row = otx_image_at(image, 0, (int32_t)y);
    char *message = job->messages[worker->index];

    return job->is_apart ? otx_few_values_apply(
                               job->conversion, row, image->width,
                               image->channels, message)
                         : otx_ocio_conversion_apply(
                               job->conversion, row, image->width,
                               image->channels, message);
}

static otx_status
fail_convert(
    otx_run *run, const otx_colour *colour, const char *from, const char *to,
    const char *message)
{
    return otx_fail(
        run, OSDTEX_ERROR_COLOUR, stage, otx_where_file(colour->path),
        "cannot convert from '%s' to '%s': %s", from, to, message);
}

static otx_status
convert_rows(
    otx_run *run, const otx_colour *colour, const char *from, const char *to,
    otx_image *image)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio_conversion *conversion = NULL;
    const size_t threads = (size_t)otx_pool_threads(run->pool);
    convert_job job = {0};

    if (otx_ocio_convert(colour->config, from, to, &conversion, message) !=
        OSDTEX_OK)
        return fail_convert(run, colour, from, to, message);
    if (!otx_arena_defer(run->scratch, destroy_conversion, conversion))
    {
        otx_ocio_conversion_destroy(conversion);
        return otx_fail_memory(run, stage);
    }
    if (otx_ocio_conversion_is_identity(conversion))
        return OSDTEX_OK;
    job.conversion = conversion;
    job.is_apart = otx_ocio_conversion_is_apart(conversion);
    job.image = image;
    job.messages =
        otx_arena_zalloc(run->scratch, threads, OTX_OCIO_MESSAGE_BYTES);
    OTX_TRY(otx_run_ok(run));

    const otx_status status =
        otx_pool_for(run->pool, image->height, convert_row, &job);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(run, stage);
    if (status != OSDTEX_OK)
        return fail_convert(run, colour, from, to, "OpenColorIO failed on it");
    return OSDTEX_OK;
}

otx_status
otx_colour_convert(
    otx_run *run, const otx_colour *colour, const char *from, const char *to,
    otx_image *image)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_status status = convert_rows(run, colour, from, to, image);

    otx_arena_release(run->scratch, mark);
    return status;
}
