/* rehearsal.c -- everything of a mapping but the mapping. */
#include "api/rehearsal.h"

#include "api/call.h"
#include "api/map_input.h"
#include "api/map_resolve.h"
#include "api/method_settings.h"
#include "api/several.h"

#include <string.h>

static otx_status
choose_method(
    otx_run *run, const osdtex_map_options *options, osdtex_mapping *handle)
{
    const otx_job job = {
        .run = run,
        .surface = &handle->surface->surface,
        .exemplars = handle->exemplars,
        .exemplar_count = handle->source_count,
        .request = &handle->request,
    };

    return options->method && strcmp(options->method, "auto") == 0
               ? otx_method_choose(&job, &handle->method)
               : otx_resolve_method(run, options->method, &handle->method);
}

static otx_status
rehearse(
    otx_run *run, const osdtex_map_options *options, osdtex_mapping *handle)
{
    OTX_TRY(otx_map_input_options(run, options, &handle->request.constraints));
    OTX_TRY(otx_several_take(run, options, handle));
    OTX_TRY(otx_map_input_analysis(
        run, options, &handle->exemplar->exemplar, &handle->request.analysis));
    OTX_TRY(choose_method(run, options, handle));
    return otx_method_settings_read(
        run, handle->method, options->settings, options->setting_count,
        &handle->exemplar->exemplar, &handle->surface->cage->cage,
        &handle->settings);
}

/* An error that was found aside. */
static otx_status
repeat(otx_run *run, const otx_diagnostics *aside, otx_status status)
{
    const osdtex_diagnostic *d = otx_diagnostics_error(aside);
    const otx_where where = {d->file, d->line, d->face, d->vertex};

    if (status == OSDTEX_OK || status == OSDTEX_ERROR_CANCELLED ||
        d->status == OSDTEX_OK)
        return status;
    return otx_fail(run, status, d->stage, where, "%s", d->marked);
}

otx_status
otx_rehearse_map(
    otx_run *run, const osdtex_cage *cage, const otx_surface *draft,
    const osdtex_exemplar *exemplar, const osdtex_map_options *options,
    const otx_map_request *request, const char **method)
{
    osdtex_surface surface = {.cage = cage, .surface = *draft};
    osdtex_mapping handle = {
        .surface = &surface,
        .exemplar = exemplar,
        .request = *request,
    };
    otx_run aside = *run;
    otx_status status;

    aside.diagnostics = otx_diagnostics_create(run->allocator);
    if (!aside.diagnostics)
        return otx_fail_memory(run, "preflight");
    status = rehearse(&aside, options, &handle);
    if (status == OSDTEX_OK)
        *method = handle.method->name;
    status = repeat(run, aside.diagnostics, status);
    otx_diagnostics_destroy(aside.diagnostics);
    return status;
}
