/* preflight.c -- what can be known of a job before it runs. */
#include "api/call.h"
#include "api/handle.h"
#include "api/keep_call.h"
#include "api/map_resolve.h"
#include "api/rehearsal.h"
#include "bake/charts.h"
#include "bake/uv_choice.h"
#include "image/udim.h"
#include "method/scale_check.h"
#include "surface/draft.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "preflight";

/* Bytes that mapping a leaf face takes besides the surface's own: measured as
 * peaks of processes at levels 4 to 6 (docs/notes/preflight.md). */
static const double MAP_BYTES = 600.0;

/* Texels of the exemplar to one of the bake, from which a warning is due. */
static const double COARSE = 4.0;

typedef struct look
{
    osdtex_context *context;
    otx_run *run;
    const osdtex_cage *cage;
    const osdtex_exemplar *exemplar;
    osdtex_surface_options surface;
    osdtex_map_options map;
    osdtex_bake_options bake;
    bool bakes;
    otx_map_request request;
    otx_surface draft;
    osdtex_forecast forecast;
} look;

static otx_status
take_options(look *l, const osdtex_job *theirs)
{
    osdtex_job job = osdtex_job_none();

    OTX_TRY(otx_call_options(l->run, &job, sizeof job, theirs));
    l->surface = osdtex_surface_options_default();
    l->map = osdtex_map_options_default();
    l->bake = osdtex_bake_options_default();
    l->bakes = job.bake != NULL;
    OTX_TRY(
        otx_call_options(l->run, &l->surface, sizeof l->surface, job.surface));
    OTX_TRY(otx_call_options(l->run, &l->map, sizeof l->map, job.map));
    if (!job.surface)
        l->surface.level = l->map.level;
    if (l->map.keep)
        OTX_TRY(otx_keep_call_level(
            l->run, l->map.keep, l->cage, &l->surface.level));
    return otx_call_options(l->run, &l->bake, sizeof l->bake, job.bake);
}

/* ---- mapping ------------------------------------------------------------- */

static double
predict_bytes(const otx_cage *cage, int32_t level)
{
    return (double)otx_surface_bytes(cage, level) +
           MAP_BYTES * otx_surface_face_count(cage, level);
}

static otx_status
refuse_memory(const look *l, double limit)
{
    const otx_cage *cage = &l->cage->cage;
    const osdtex_forecast *f = &l->forecast;
    const double gib = 1024.0 * 1024.0 * 1024.0;
    int32_t best = f->level - 1;

    while (best > 0 && predict_bytes(cage, best) > limit)
        --best;
    return otx_fail(
        l->run, OSDTEX_ERROR_LIMIT, STAGE, otx_where_file(cage->path),
        "level %d has %.0f faces, and mapping them needs about %.2g GiB, over "
        "the limit of %.2g GiB; use level %d, or raise the limit",
        f->level, f->face_count, f->bytes / gib, limit / gib, best);
}

/* The level, and whether its elements and memory can be had. */
static otx_status
check_level(look *l)
{
    const otx_cage *cage = &l->cage->cage;
    const size_t limit = l->context->options.memory_limit;
    osdtex_forecast *f = &l->forecast;

    OTX_TRY(otx_resolve_level(
        l->run, l->cage, &l->surface,
        l->surface.leaf_edge != 0.0
            ? l->surface.leaf_edge
            : osdtex_exemplar_leaf_edge(l->exemplar, f->scale),
        &f->level));
    f->face_count = otx_surface_face_count(cage, f->level);
    f->bytes = predict_bytes(cage, f->level);
    otx_scale_warn(l->run, cage, f->level, f->scale);
    OTX_TRY(otx_surface_check_level(l->run, cage, f->level, limit));
    return limit == 0 || f->bytes <= (double)limit
               ? OSDTEX_OK
               : refuse_memory(l, (double)limit);
}

/* Heights that would reach beyond the cage are told. */
static void
tell_heights(const look *l)
{
    const otx_cage *cage = &l->cage->cage;
    const otx_companions *set = &l->exemplar->exemplar.companions;
    const double range = set->height_range;
    const double far = fmax(
        fabs(range * set->height_middle),
        fabs(range * (1.0 - set->height_middle)));

    if (range > 0.0 && far > cage->diagonal)
        otx_note(
            l->run, OSDTEX_SEVERITY_WARNING, STAGE, otx_where_file(cage->path),
            "wrong units? The heights reach %g scene units from the surface, "
            "and the cage is %g across",
            far, cage->diagonal);
}

static otx_status
check_mapping(look *l)
{
    const osdtex_exemplar_info *e = &l->exemplar->info;
    const otx_cage *cage = &l->cage->cage;
    int32_t missing;

    OTX_TRY(otx_resolve_request(l->run, l->cage, e, &l->map, &l->request));
    l->forecast.scale = l->request.scale;
    if (e->tile_size == 0)
        l->forecast.scale *= (double)e->source_width / e->width;
    l->forecast.density = e->width / l->request.scale;
    tell_heights(l);
    OTX_TRY(check_level(l));
    OTX_TRY(otx_surface_draft(l->run, cage, l->forecast.level, &l->draft));
    OTX_TRY(otx_rehearse_map(
        l->run, l->cage, &l->draft, l->exemplar, &l->map, &l->request,
        &l->forecast.method));
    missing = cage->scheme == OTX_SCHEME_NONE
                  ? 0
                  : l->forecast.level - (l->draft.level_count - 1);
    return otx_scale_check(
        l->run, &l->draft, ldexp(1.0, missing), &l->exemplar->exemplar,
        l->request.scale);
}

/* ---- bake ---------------------------------------------------------------- */

/* The resolution at which a tile would show all of the exemplar: a multiple of
 * 256 texels. */
static double
full_side(const look *l)
{
    const double side =
        l->bake.resolution * l->forecast.density / l->forecast.bake_density;

    return 256.0 * ceil(side / 256.0);
}

/* Digits by which a number is printed with %g: three, or all before the
 * point. */
static int
digits(double x)
{
    return x >= 1000.0 && x < 1e15 ? (int)log10(x) + 1 : 3;
}

static void
tell_density(const look *l)
{
    const osdtex_forecast *f = &l->forecast;
    const double ratio = f->density / f->bake_density;
    const double side = full_side(l);
    const char *way = side <= 32768.0 ? "" : ", over several UDIM tiles";

    if (ratio > 1.05)
        otx_note(
            l->run,
            ratio > COARSE ? OSDTEX_SEVERITY_WARNING : OSDTEX_SEVERITY_INFO,
            "bake", OTX_NOWHERE,
            "about %.*g texels are baked to a scene unit where the exemplar "
            "has %.*g: %.1fx coarser than the exemplar; a resolution of %.0f "
            "would show all of it%s",
            digits(f->bake_density), f->bake_density, digits(f->density),
            f->density, ratio, side, way);
    else
        otx_note(
            l->run, OSDTEX_SEVERITY_INFO, "bake", OTX_NOWHERE,
            "about %.*g texels are baked to a scene unit where the exemplar "
            "has %.*g: %.1fx finer than the exemplar",
            digits(f->bake_density), f->bake_density, digits(f->density),
            f->density, 1.0 / ratio);
}

/* Whether the bake has the one tile that is asked for. How many tiles an atlas
 * takes is known but roughly.
 *
 *   tile_count  of an atlas; 0: own UVs */
static otx_status
check_udim(const look *l, int32_t tile_count)
{
    const int32_t tile = l->bake.udim;
    const bool is_there =
        tile_count > 0 ? tile - OTX_UDIM_FIRST <= tile_count + tile_count / 4
                       : otx_uv_survey_has_tile(&l->draft, tile);

    if (tile == 0 || is_there)
        return OSDTEX_OK;
    return otx_fail(
        l->run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
        "the bake has no tile %d", (int)tile);
}

static otx_status
pack_atlas(look *l, bool charts)
{
    const otx_atlas_options how = {
        l->bake.resolution, l->bake.margin, l->bake.texels_per_unit};
    otx_atlas atlas;

    OTX_TRY((charts ? otx_charts_make : otx_atlas_pack)(
        l->run, &l->draft, &how, &atlas));
    l->forecast.bake_density = atlas.texels_per_unit;
    return check_udim(l, atlas.tile_count);
}

static otx_status
check_bake(look *l)
{
    otx_layout_source source;
    otx_uv_survey survey;

    if (!l->bakes)
        return OSDTEX_OK;
    if (l->bake.uvs < OSDTEX_BAKE_UVS_AUTO ||
        l->bake.uvs > OSDTEX_BAKE_UVS_CHARTS || l->bake.resolution < 1)
        return otx_fail(
            l->run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "there are no such UVs, or no such resolution");
    OTX_TRY(otx_uv_choose(
        l->run, &l->draft, (otx_layout_source)l->bake.uvs, &source, &survey));
    l->forecast.uvs = (osdtex_bake_uvs)source;
    l->forecast.uv_overlap = survey.overlap;
    if (source != OTX_LAYOUT_OWN)
        OTX_TRY(pack_atlas(l, source == OTX_LAYOUT_CHARTS));
    else
        OTX_TRY(check_udim(l, 0));
    if (source == OTX_LAYOUT_OWN && survey.side > 0.0)
        l->forecast.bake_density = l->bake.resolution / survey.side;
    if (l->forecast.bake_density > 0.0)
        tell_density(l);
    return OSDTEX_OK;
}

/* ---- all of it ----------------------------------------------------------- */

static otx_status
preflight(otx_call *call, const osdtex_job *job, look *l)
{
    l->context = call->context;
    l->run = &call->run;
    if (!l->cage || !l->exemplar)
        return otx_fail(
            l->run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no cage or no exemplar is given");
    OTX_TRY(take_options(l, job));
    OTX_TRY(check_mapping(l));
    return check_bake(l);
}

osdtex_status
osdtex_preflight(
    osdtex_context *context, const osdtex_cage *cage,
    const osdtex_exemplar *exemplar, const osdtex_job *job,
    osdtex_forecast *out)
{
    look l = {.cage = cage, .exemplar = exemplar};
    osdtex_status status;
    otx_call call;

    if (out)
        *out = (osdtex_forecast){0};
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    status = preflight(&call, job, &l);
    if (out && status == OSDTEX_OK)
        *out = l.forecast;
    return otx_call_drop(&call, status);
}
