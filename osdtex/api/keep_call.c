/* keep_call.c -- a mapping made from one that is to be kept. */
#include "api/keep_call.h"

#include "api/call.h"
#include "api/edit_call.h"
#include "api/saved_about.h"
#include "edit/apply.h"
#include "edit/carry_decals.h"
#include "edit/keep.h"
#include "edit/project.h"
#include "mapping/mapping_check.h"
#include "place/spot.h"

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
    return OSDTEX_OK;
}

static otx_status
compare_faces(
    otx_run *run, const osdtex_mapping *keep, const osdtex_cage *cage,
    bool *same)
{
    const char *a, *b;

    OTX_TRY(otx_saved_topology(run, &keep->surface->cage->cage, &a));
    OTX_TRY(otx_saved_topology(run, &cage->cage, &b));
    *same = strcmp(a, b) == 0 &&
            keep->surface->cage->cage.scheme == cage->cage.scheme;
    return OSDTEX_OK;
}

otx_status
otx_keep_call_level(
    otx_run *run, const osdtex_mapping *keep, const osdtex_cage *cage,
    int32_t *level)
{
    bool same;

    if (*level != OSDTEX_LEVEL_AUTO)
        return OSDTEX_OK;
    OTX_TRY(compare_faces(run, keep, cage, &same));
    if (same)
        *level = keep->surface->info.level;
    else
        *level = otx_surface_level_for(
            &cage->cage, keep->surface->surface.mean_edge_length);
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

/* The surface that the mapping was made for, without a density. */
static otx_status
find_surface(otx_run *run, const osdtex_mapping *keep, const otx_surface **out)
{
    const osdtex_surface *surface = keep->surface;
    otx_cage *cage;
    otx_surface *before;

    *out = &surface->surface;
    if (!keep->made_for)
        return OSDTEX_OK;
    cage = OTX_NEW(run->arena, otx_cage, 1);
    before = OTX_NEW(run->arena, otx_surface, 1);
    OTX_TRY(otx_run_ok(run));
    *cage = surface->cage->cage;
    cage->points = keep->made_for;
    OTX_TRY(otx_surface_refine(run, cage, surface->info.level, 0, before));
    *out = before;
    return OSDTEX_OK;
}

/* The same relative to the origin of another cage. */
static otx_status
shift_surface(otx_run *run, const otx_cage *to, const otx_surface **surface)
{
    const size_t count = 3 * (size_t)otx_surface_leaf(*surface)->vert_count;
    const double *from = (*surface)->cage->origin;
    otx_surface *moved;
    float *points;

    if (memcmp(from, to->origin, sizeof to->origin) == 0)
        return OSDTEX_OK;
    moved = OTX_NEW(run->arena, otx_surface, 1);
    points = OTX_NEW(run->arena, float, count);
    OTX_TRY(otx_run_ok(run));
    for (size_t i = 0; i < count; ++i)
        points[i] =
            (float)((double)(*surface)->points[i] + from[i % 3] - to->origin[i % 3]);
    *moved = **surface;
    moved->points = points;
    *surface = moved;
    return OSDTEX_OK;
}

/* What was asked at a face of the cage that is no more is asked around its
 * middle. */
static void
move_to_points(
    const osdtex_surface *surface, otx_constraint_set *set,
    otx_constraint *items)
{
    const double *o = surface->cage->cage.origin;

    for (int32_t i = 0; i < set->count; ++i)
    {
        otx_spot spot;

        if (items[i].face < 0)
            continue;
        spot = otx_spot_of_face(&surface->surface, items[i].face);
        items[i].face = -1;
        items[i].point = otx_vec3_add(spot.point, (otx_vec3){o[0], o[1], o[2]});
        items[i].radius = 0.5 * surface->cage->cage.mean_edge_length;
    }
}

/* What was asked of the mapping, and its settings, go on with it. */
static otx_status
take_over(
    otx_run *run, const osdtex_mapping *keep, bool same, osdtex_mapping *handle)
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
    if (!same)
        move_to_points(keep->surface, set, items);
    handle->request.constraints = set;
    return OSDTEX_OK;
}

/* The mapping on the new faces, as otx_keep_run wants it.
 *
 *   decals  out: on the new faces, in the arena of the job's run */
static otx_status
project(
    otx_run *run, const osdtex_mapping *keep, const otx_surface *made_for,
    otx_projected *out, otx_keep *what, const otx_decals **decals)
{
    otx_project ask = {
        &keep->mapping, made_for, keep->exemplars, what->job->surface};

    OTX_TRY(otx_edit_check(run, what->method, &keep->mapping, keep->exemplars));
    OTX_TRY(shift_surface(run, ask.to->cage, &ask.made_for));
    OTX_TRY(otx_project_run(run, &ask, out));
    OTX_TRY(otx_carry_decals(what->job->run, &ask, out, decals));
    what->from = &out->mapping;
    what->points = out->points;
    what->loose = out->loose;
    return OSDTEX_OK;
}

/* Makes the mapping, with what is needed on the way in `run`'s arena. */
static otx_status
keep_it(
    otx_run *run, const osdtex_mapping *keep, bool same, otx_keep *what,
    otx_mapping *out, otx_keep_tally *tally)
{
    const otx_decals *decals = keep->mapping.decals;
    const otx_surface *made_for;
    otx_projected projected;

    OTX_TRY(find_surface(run, keep, &made_for));
    what->points = made_for->points;
    if (!same)
        OTX_TRY(project(run, keep, made_for, &projected, what, &decals));
    OTX_TRY(otx_keep_run(what, out, tally));
    out->decals = decals;
    /* Their pictures stay where they are. */
    return decals ? otx_call_hold(what->job->run, keep->arena) : OSDTEX_OK;
}

static void
report(const otx_keep_tally *t, otx_figures *figures)
{
    otx_figures_count(figures, "kept.held", "faces", t->held);
    otx_figures_count(figures, "kept.moved", "faces", t->moved);
    otx_figures_count(figures, "kept.covered", "faces", t->covered);
    otx_figures_real(figures, "kept.texels", "of the area", t->texels);
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
    otx_keep what = {
        .job = &job, .method = handle->method, .from = &keep->mapping};
    otx_keep_tally tally;
    otx_status status;
    bool same;

    OTX_TRY(compare_faces(run, keep, handle->surface->cage, &same));
    same = same && keep->surface->info.level == handle->surface->info.level;
    OTX_TRY(check_exemplars(run, keep, handle));
    OTX_TRY(take_over(run, keep, same, handle));
    handle->figures = (otx_figures){0};
    otx_figures_stage(&handle->figures, STAGE);
    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, STAGE);
    status = keep_it(&aside, keep, same, &what, &handle->mapping, &tally);
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
