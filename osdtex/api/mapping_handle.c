/* mapping_handle.c -- running a method, writing what it made. */
#include "api/mapping_handle.h"
#include "api/call.h"
#include "api/edit_call.h"
#include "api/heal_call.h"
#include "api/keep_call.h"
#include "api/map_input.h"
#include "api/map_resolve.h"
#include "api/mapping_info.h"
#include "api/material_axis.h"
#include "api/method_settings.h"
#include "api/place_call.h"
#include "api/several.h"
#include "word/near.h"

#include <string.h>

/* What the method is given; settings are added once they are read. */
static otx_job
job_of(otx_run *run, osdtex_mapping *handle)
{
    return (otx_job){
        .run = run,
        .surface = &handle->surface->surface,
        .exemplars = handle->exemplars,
        .exemplar_count = handle->source_count,
        .request = &handle->request,
        .settings = handle->settings,
        .figures = &handle->figures,
    };
}

static otx_status
choose_method(otx_run *run, const char *name, osdtex_mapping *handle)
{
    const otx_job job = job_of(run, handle);

    return name && strcmp(name, "auto") == 0
               ? otx_method_choose(&job, &handle->method)
               : otx_resolve_method(run, name, &handle->method);
}

/* The host's surface, or one that is refined for the exemplar's texels and
 * lives as long as the mapping. */
static otx_status
choose_surface(
    otx_call *call, const osdtex_cage *cage, const osdtex_exemplar *exemplar,
    const osdtex_map_options *options, const osdtex_surface **out)
{
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_surface *surface;
    otx_status status;

    *out = options->surface || !options->field ? options->surface
                                               : options->field->surface;
    if (options->field && options->field->surface != *out)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "the field is of another surface");
    if (*out && (!cage || (*out)->cage == cage))
        return otx_call_hold(&call->run, (*out)->arena);
    if (*out || !cage)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "no cage is given, or the surface is of another one");
    refine.level = options->level;
    if (options->keep)
        OTX_TRY(otx_keep_call_level(
            &call->run, options->keep, cage, &refine.level));
    refine.leaf_edge = osdtex_exemplar_leaf_edge(
        exemplar,
        options->scale > 0.0 ? options->scale : cage->info.default_scale);
    OTX_TRY(osdtex_surface_refine(call->context, cage, &refine, &surface));
    status = otx_call_hold(&call->run, surface->arena);
    osdtex_surface_destroy(surface);
    *out = surface;
    return status;
}

/* The mapping itself, with all that is settled in the handle. */
static otx_status
lay(otx_run *run, const osdtex_map_options *options,
    const otx_constraint_set *asked, osdtex_mapping *handle)
{
    const otx_job job = job_of(run, handle);

    if (options->keep)
        OTX_TRY(otx_keep_call_run(run, options->keep, handle));
    else
    {
        OTX_TRY(otx_method_map(handle->method, &job, &handle->mapping));
        OTX_TRY(otx_material_axis_take(run, options->along, handle));
    }
    OTX_TRY(otx_edit_call_apply(run, asked, 1, handle));
    return otx_heal_call(run, options->heal, handle);
}

static otx_status
map(otx_call *call, const osdtex_cage *cage, const osdtex_exemplar *exemplar,
    const osdtex_map_options *options, osdtex_mapping **out)
{
    otx_run *run = &call->run;
    const osdtex_surface *surface;
    osdtex_map_options ours = osdtex_map_options_default();
    const otx_constraint_set *asked;
    osdtex_mapping *handle = OTX_ZNEW(run->arena, osdtex_mapping, 1);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    if (ours.keep)
        OTX_TRY(otx_keep_call_options(run, ours.keep, &ours));
    if (!exemplar || (ours.setting_count > 0 && !ours.settings) ||
        ours.setting_count < 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "no exemplar or no settings are given");
    OTX_TRY(choose_surface(call, cage, exemplar, &ours, &surface));
    handle->arena = run->arena;
    handle->surface = surface;
    handle->exemplar = exemplar;
    handle->seed = ours.seed;
    OTX_TRY(otx_call_hold(run, exemplar->arena));
    if (ours.field)
        OTX_TRY(otx_call_hold(run, ours.field->arena));
    OTX_TRY(otx_resolve_request(
        run, surface->cage, &exemplar->info, &ours, &handle->request));
    OTX_TRY(otx_map_input_options(run, &ours, &asked));
    OTX_TRY(otx_edit_call_base(run, asked, &handle->request.constraints));
    OTX_TRY(otx_several_take(run, &ours, handle));
    OTX_TRY(otx_map_input_analysis(
        run, &ours, &exemplar->exemplar, &handle->request.analysis));
    OTX_TRY(choose_method(run, ours.method, handle));
    OTX_TRY(otx_method_settings_read(
        run, handle->method, ours.settings, ours.setting_count,
        &exemplar->exemplar, &surface->cage->cage, &handle->settings));
    run->seed = ours.seed;
    OTX_TRY(lay(run, &ours, asked, handle));
    OTX_TRY(otx_place_call(call, ours.place, handle));
    handle->info = otx_mapping_info_of(handle);
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_map(
    osdtex_context *context, const osdtex_cage *cage,
    const osdtex_exemplar *exemplar, const osdtex_map_options *options,
    osdtex_mapping **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "map", &call));
    return otx_call_end(&call, map(&call, cage, exemplar, options, out), out);
}

const osdtex_mapping_info *
osdtex_mapping_describe(const osdtex_mapping *mapping)
{
    return mapping ? &mapping->info : NULL;
}

const osdtex_surface *
osdtex_mapping_surface(const osdtex_mapping *mapping)
{
    return mapping ? mapping->surface : NULL;
}

void
osdtex_mapping_destroy(osdtex_mapping *mapping)
{
    if (mapping)
        otx_arena_destroy(mapping->arena);
}

otx_model_options
otx_mapping_handle_model_options(const osdtex_write_options *options)
{
    return (otx_model_options){
        .without_image = options->without_image != 0,
        .normals = options->normals != 0,
        .pastes = options->pastes != 0,
        .resolution = options->resolution,
        .comment_count = options->comment_count,
        .comments = options->comments};
}

static otx_status
write_mapping(
    otx_run *run, const osdtex_mapping *mapping, const char *path,
    const osdtex_write_options *options)
{
    osdtex_write_options ours = osdtex_write_options_default();
    otx_model_options how;
    otx_model_files files;

    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    if (!mapping || !path || ours.comment_count < 0 ||
        (ours.comment_count > 0 && !ours.comments))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "export", OTX_NOWHERE,
            "no mapping, no path, or no comments are given");
    how = otx_mapping_handle_model_options(&ours);
    how.path = path;
    return otx_model_write(
        run, &mapping->mapping, mapping->exemplars, &how, &files);
}

osdtex_status
osdtex_mapping_write(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path,
    const osdtex_write_options *options)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, "export", &call));
    return otx_call_drop(
        &call, write_mapping(&call.run, mapping, path, options));
}
