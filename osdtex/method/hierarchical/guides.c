/* guides.c -- the fields that patches follow, and the sizes they have. */
#include "method/hierarchical/guides.h"

#include "analysis/exemplar_analysis.h"
#include "method/density.h"
#include "method/hierarchical/first_direction.h"
#include "method/hierarchical/settings.h"

/* Whether it is left open how the exemplar is to lie. */
static bool
is_open(const otx_map_request *request)
{
    const otx_constraint_set *set = request->constraints;

    if (request->first_face >= 0)
        return false;
    for (int32_t i = 0; set && i < set->count; ++i)
        if (set->items[i].has_direction)
            return false;
    return !set || !(set->follows || set->follow != OTX_FOLLOW_NOTHING ||
                     set->symmetry > 0 || set->field.directions);
}

/* Of a picture with a top: its top goes up the scene, as an arrow. */
static otx_status
stand_upright(
    const otx_job *job, otx_analysis *a, const otx_constraint_set **out)
{
    otx_constraint_set *set = OTX_ZNEW(job->run->arena, otx_constraint_set, 1);

    OTX_TRY(otx_run_ok(job->run));
    if (job->request->constraints)
        *set = *job->request->constraints;
    set->follow = OTX_FOLLOW_AXIS;
    set->axis = (otx_vec3){0, 1, 0};
    a->angle = 0.5 * OTX_PI;
    a->symmetry = 1;
    *out = set;
    otx_note(
        job->run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
        "the exemplar has a top, as its rows or its light tell: it is laid "
        "upright, along y; {follow} smooth or an axis and {exemplar-class} say "
        "otherwise");
    return OSDTEX_OK;
}

/* A field for patches to follow, where exemplar k has a direction.
 *
 *   known  what the exemplar is taken for; NULL: it is analysed
 *   kind   out: its name */
static otx_status
make_guide(
    const otx_job *job, const otx_surface *surface, int32_t k,
    const otx_analysis *known, otx_guide *guide, const char **kind)
{
    otx_run *run = job->run;
    const otx_exemplar *exemplar = &job->exemplars[k];
    const otx_constraint_set *constraints;
    otx_analysis a;

    if (known)
        a = *known;
    else
        OTX_TRY(otx_exemplar_analysis(run, exemplar, &a));
    *kind = otx_analysis_name(a.kind);
    if (a.upright && is_open(job->request))
    {
        OTX_TRY(stand_upright(job, &a, &constraints));
        return otx_guide_make(run, surface, &a, constraints, guide);
    }
    if (a.kind == OTX_ANALYSIS_ISOTROPIC)
        return OSDTEX_OK;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
        "the exemplar is %s, at %.0f degrees: patches follow a field of "
        "symmetry %d",
        otx_analysis_name(a.kind), a.angle * 180.0 / OTX_PI, (int)a.symmetry);
    OTX_TRY(otx_first_constrain(
        run, surface, job->request, k, a.angle, &constraints));
    return otx_guide_make(run, surface, &a, constraints, guide);
}

otx_status
otx_guides_make(
    const otx_job *job, const otx_surface *surface, otx_guide *guides)
{
    const otx_patch_settings *settings = job->settings;
    const otx_map_request *request = job->request;

    if (request->guide)
        guides[0] = *request->guide;
    if (settings->guide != OTX_PATCH_AUTO || settings->mode == OTX_PATCH_PAPER)
        return OSDTEX_OK;
    for (int32_t k = request->guide ? 1 : 0; k < job->exemplar_count; ++k)
    {
        const char *kind;

        OTX_TRY(make_guide(
            job, surface, k, k == 0 ? request->analysis : NULL, &guides[k],
            &kind));
        if (job->figures)
            job->figures->classes[k] = kind;
    }
    return OSDTEX_OK;
}

/* The sizes that the user asks for. */
otx_status
otx_guides_density(const otx_job *job, const otx_surface **surface)
{
    const otx_patch_settings *settings = job->settings;

    OTX_TRY(otx_density_apply(
        job->run, job->surface, job->request->constraints, surface));
    if (settings->flatten != OTX_PATCH_RECURSIVE &&
        settings->mode != OTX_PATCH_PAPER)
        return OSDTEX_OK;
    if (*surface != job->surface)
        otx_note(
            job->run, OSDTEX_SEVERITY_WARNING, "map", OTX_NOWHERE,
            "the published method has one size everywhere; the scales among "
            "the constraints are left out");
    *surface = job->surface;
    return OSDTEX_OK;
}
