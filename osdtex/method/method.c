/* method.c -- the table of methods and the driver. */
#include "method/method.h"

#include "mapping/mapping_check.h"
#include "method/scale_check.h"

#include <string.h>

extern const otx_method otx_method_hierarchical;
extern const otx_method otx_method_lapped;
extern const otx_method otx_method_material;
extern const otx_method otx_method_tile;
extern const otx_method otx_method_vertex;

/* A line each, so that a method is taken out by deleting its own. */
/* clang-format off */
static const otx_method *const METHODS[] = {
    &otx_method_hierarchical,
    &otx_method_material,
    &otx_method_tile,
    &otx_method_lapped,
    &otx_method_vertex,
};
/* clang-format on */

int32_t
otx_method_count(void)
{
    return (int32_t)(sizeof METHODS / sizeof METHODS[0]);
}

const otx_method *
otx_method_at(int32_t index)
{
    return METHODS[index];
}

const otx_method *
otx_method_find(const char *name)
{
    for (int32_t i = 0; i < otx_method_count(); ++i)
        if (strcmp(METHODS[i]->name, name) == 0)
            return METHODS[i];
    return NULL;
}

const otx_method *
otx_method_for_tiles(void)
{
    for (int32_t i = 0; i < otx_method_count(); ++i)
        if (METHODS[i]->tiles)
            return METHODS[i];
    return NULL;
}

/* Requests that no method could answer. */
static otx_status
check(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request)
{
    if (!(request->scale > 0.0) || !isfinite(request->scale))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "the scale is %g; give the exemplar's width in scene units, a "
            "positive number",
            request->scale);
    if (request->first_face >= surface->cage->face_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map",
            (otx_where){surface->cage->path, 0, request->first_face, -1},
            "the first patch asks for face %d, and the cage has faces 0 to %d",
            (int)request->first_face, (int)surface->cage->face_count - 1);
    if (request->first_face >= 0 && surface->cage->face_hole &&
        surface->cage->face_hole[request->first_face])
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map",
            (otx_where){surface->cage->path, 0, request->first_face, -1},
            "the first patch asks for face %d, which is a hole; begin at one "
            "that is textured",
            (int)request->first_face);
    if (!(surface->area > 0.0))
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, "map",
            otx_where_file(surface->cage->path),
            "the surface has no area; there is nothing to texture");
    return otx_scale_check(run, surface, 1.0, exemplar, request->scale);
}

/* The first method of the table that the others may be told to leave a job
 * to. */
static const char *
mixing_method(void)
{
    for (int32_t i = 0; i < otx_method_count(); ++i)
        if (METHODS[i]->mixes)
            return METHODS[i]->name;
    return "none of this build";
}

static const char *
beginning_method(void)
{
    for (int32_t i = 0; i < otx_method_count(); ++i)
        if (METHODS[i]->begins)
            return METHODS[i]->name;
    return "none of this build";
}

/* What this method cannot answer. */
static otx_status
check_method(const otx_method *method, const otx_job *job)
{
    if (job->request->demand && !method->mixes)
        return otx_fail(
            job->run, OSDTEX_ERROR_SUPPORT, "map", OTX_NOWHERE,
            "the method '%s' takes one exemplar; several are for the method "
            "'%s'",
            method->name, mixing_method());
    if (job->request->first_face >= 0 && !method->begins)
        otx_note(
            job->run, OSDTEX_SEVERITY_WARNING, "map", OTX_NOWHERE,
            "the method '%s' has no first patch, and leaves it out; it is for "
            "the method '%s'",
            method->name, beginning_method());
    return OSDTEX_OK;
}

otx_status
otx_method_map(const otx_method *method, const otx_job *job, otx_mapping *out)
{
    const otx_arena_mark mark = otx_arena_here(job->run->scratch);

    if (job->figures)
        *job->figures = (otx_figures){0};
    *out = (otx_mapping){0};
    OTX_TRY(check(job->run, job->surface, job->exemplars, job->request));
    OTX_TRY(check_method(method, job));
    otx_figures_stage(job->figures, "prepare");
    OTX_TRY(method->map(job, out));
    otx_figures_stage(job->figures, NULL);
    otx_arena_release(job->run->scratch, mark);
    return otx_mapping_check(
        job->run, out, job->surface, job->exemplars, job->exemplar_count,
        method->name);
}

static const otx_method *
first_filler(void)
{
    for (int32_t i = 0; i < otx_method_count(); ++i)
        if (METHODS[i]->fill)
            return METHODS[i];
    return NULL;
}

bool
otx_method_can_fill(void)
{
    return first_filler() != NULL;
}

/* The first method of the table that can fill, with its own settings instead
 * of job->settings. */
static otx_status
find_filling(const otx_job *job, const otx_method **out, void **settings)
{
    const otx_method *method = first_filler();

    if (!method)
        return otx_fail(
            job->run, OSDTEX_ERROR_SUPPORT, "map", OTX_NOWHERE,
            "this build has no method that fills in patches");
    *settings = otx_arena_zalloc(job->run->arena, 1, method->settings_bytes);
    OTX_TRY(otx_run_ok(job->run));
    otx_option_defaults(method->options, method->option_count, *settings);
    *out = method;
    return OSDTEX_OK;
}

otx_status
otx_method_fill(
    const otx_job *job, const otx_patch_given *given, otx_mapping *out)
{
    const otx_method *method;
    otx_job filling = *job;
    void *settings;

    OTX_TRY(find_filling(job, &method, &settings));
    filling.settings = settings;
    return method->fill(&filling, given, out);
}

otx_status
otx_method_patches(const otx_job *job, otx_mapping *out)
{
    const otx_method *method;
    otx_job covering = *job;
    void *settings;

    OTX_TRY(find_filling(job, &method, &settings));
    if (method->resolve)
        method->resolve(settings, job->exemplars, job->surface->cage);
    covering.settings = settings;
    return method->map(&covering, out);
}

/* Says why the others were not taken. */
static void
note_others(
    const otx_job *job, const otx_method *taken,
    const otx_suitability *suitability)
{
    for (int32_t i = 0; i < otx_method_count(); ++i)
        if (METHODS[i] != taken && suitability[i].score == 0.0 &&
            suitability[i].why[0])
            otx_note(
                job->run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
                "method %s is not taken: %s", METHODS[i]->name,
                suitability[i].why);
}

otx_status
otx_method_choose(const otx_job *job, const otx_method **out)
{
    otx_suitability found[sizeof METHODS / sizeof METHODS[0]] = {{0}};
    int32_t best = 0;

    for (int32_t i = 0; i < otx_method_count(); ++i)
    {
        if (!METHODS[i]->applicable ||
            (job->request->demand && !METHODS[i]->mixes))
            continue;
        OTX_TRY(METHODS[i]->applicable(job, &found[i]));
        if (found[i].score > found[best].score)
            best = i;
    }
    *out = METHODS[best];
    otx_note(
        job->run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE, "method %s: %s",
        (*out)->name, found[best].why);
    note_others(job, *out, found);
    return OSDTEX_OK;
}
