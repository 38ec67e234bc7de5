/* keep_call.c -- a mapping made from one that is to be kept. */
#include "api/keep_call.h"

#include "api/call.h"
#include "api/edit_call.h"
#include "api/saved_about.h"
#include "edit/keep.h"
#include "mapping/mapping_check.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "keep";

otx_status
otx_keep_call_options(
    otx_run *run, const osdtex_mapping *keep, osdtex_map_options *options)
{
    const double scale = keep->mapping.scale;

    if (options->constraints || options->constraint_count > 0 ||
        options->follow || options->field)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "constraints and fields are asked of a mapping that is kept; keep "
            "it first, and edit what comes of it");
    if (options->method && strcmp(options->method, keep->method->name) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the mapping that is kept was made by the method '%s'; leave "
            "{method} out, or map anew",
            keep->method->name);
    if (options->setting_count > 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the mapping that is kept has its settings; leave {set} out, or "
            "map anew");
    if (options->scale != 0.0 && fabs(options->scale - scale) > 1e-6 * scale)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the mapping that is kept has the scale %g, not %g; leave {scale} "
            "out, or map anew",
            scale, options->scale);
    options->scale = scale;
    options->method = keep->method->name;
    if (options->level == OSDTEX_LEVEL_AUTO)
        options->level = keep->surface->info.level;
    return OSDTEX_OK;
}

static otx_status
check_faces(
    otx_run *run, const osdtex_mapping *keep, const osdtex_mapping *handle)
{
    const char *a, *b;

    OTX_TRY(otx_saved_topology(run, &keep->surface->cage->cage, &a));
    OTX_TRY(otx_saved_topology(run, &handle->surface->cage->cage, &b));
    if (strcmp(a, b) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE,
            otx_where_file(handle->surface->cage->info.path),
            "the cage has other faces than the one that was mapped, and a "
            "mapping is kept by its faces; map it anew");
    if (keep->surface->info.level != handle->surface->info.level)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the mapping that is kept is of level %d, not %d; leave {level} "
            "out",
            (int)keep->surface->info.level, (int)handle->surface->info.level);
    return OSDTEX_OK;
}

static otx_status
check_exemplars(
    otx_run *run, const osdtex_mapping *keep, const osdtex_mapping *handle)
{
    bool same = keep->source_count == handle->source_count;

    for (int32_t k = 0; same && k < keep->source_count; ++k)
        same = keep->exemplars[k].match.width ==
                   handle->exemplars[k].match.width &&
               keep->exemplars[k].match.height ==
                   handle->exemplars[k].match.height;
    return same ? OSDTEX_OK
                : otx_fail(
                      run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                      "the mapping that is kept was made of other exemplars, "
                      "or of other sizes of them; give the same ones");
}

/* The leaf points that the mapping was made for. */
static otx_status
find_points(otx_run *run, const osdtex_mapping *keep, const float **out)
{
    const osdtex_surface *surface = keep->surface;
    otx_cage *cage;
    otx_surface *before;

    *out = surface->surface.points;
    if (!keep->made_for)
        return OSDTEX_OK;
    cage = OTX_NEW(run->arena, otx_cage, 1);
    before = OTX_NEW(run->arena, otx_surface, 1);
    OTX_TRY(otx_run_ok(run));
    *cage = surface->cage->cage;
    cage->points = keep->made_for;
    OTX_TRY(otx_surface_refine(run, cage, surface->info.level, 0, before));
    *out = before->points;
    return OSDTEX_OK;
}

/* What was asked of the mapping, and its settings, go on with it. */
static otx_status
take_over(otx_run *run, const osdtex_mapping *keep, osdtex_mapping *handle)
{
    const size_t bytes = keep->method->settings_bytes;
    void *settings = otx_arena_alloc(run->arena, 1, bytes);
    otx_constraint_set *set;
    otx_constraint *items;

    OTX_TRY(otx_run_ok(run));
    memcpy(settings, keep->settings, bytes);
    handle->settings = settings;
    handle->seed = keep->seed;
    if (!keep->request.constraints)
        return OSDTEX_OK;
    OTX_TRY(
        otx_edit_call_copy(run, keep->request.constraints, 0, &set, &items));
    handle->request.constraints = set;
    return OSDTEX_OK;
}

static void
report(const otx_keep_tally *t, otx_figures *figures)
{
    otx_figures_count(figures, "kept.held", "faces", t->held);
    otx_figures_count(figures, "kept.moved", "faces", t->moved);
    otx_figures_count(figures, "kept.covered", "faces", t->covered);
}

otx_status
otx_keep_call_run(
    otx_run *run, const osdtex_mapping *keep, osdtex_mapping *handle)
{
    const otx_job job = {
        .run = run,
        .surface = &handle->surface->surface,
        .exemplars = handle->exemplars,
        .exemplar_count = handle->source_count,
        .request = &handle->request,
        .settings = keep->settings,
    };
    otx_run aside = *run;
    otx_keep what = {&job, handle->method, &keep->mapping, NULL};
    otx_keep_tally tally;
    otx_status status;

    OTX_TRY(check_faces(run, keep, handle));
    OTX_TRY(check_exemplars(run, keep, handle));
    OTX_TRY(take_over(run, keep, handle));
    handle->figures = (otx_figures){0};
    otx_figures_stage(&handle->figures, STAGE);
    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, STAGE);
    status = find_points(&aside, keep, &what.points);
    if (status == OSDTEX_OK)
        status = otx_keep_run(&what, &handle->mapping, &tally);
    otx_arena_destroy(aside.arena);
    OTX_TRY(status);
    /* What is placed over the mapping is not copied, and lives with it. */
    if (handle->mapping.decals)
        OTX_TRY(otx_call_hold(run, keep->arena));
    otx_figures_stage(&handle->figures, NULL);
    report(&tally, &handle->figures);
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
        "%d leaf faces are kept as they were, %d are moved, %d are covered "
        "anew or lie beside such",
        (int)tally.held, (int)tally.moved, (int)tally.covered);
    return otx_mapping_check(
        run, &handle->mapping, &handle->surface->surface, handle->exemplars,
        handle->source_count, handle->method->name);
}
