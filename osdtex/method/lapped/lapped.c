/* lapped.c -- pieces of the exemplar pasted over one another until the surface
 * is covered [Praun00]. */
#include "method/lapped/lapped.h"

#include "analysis/exemplar_analysis.h"
#include "method/density.h"
#include "method/lapped/whole.h"
#include "seam/unit.h"

/* From sample to sample of the coverage, texels. */
static const double SPACING = 2.0;
/* Pieces on a surface, and the area of a leaf in squares of their radius. */
static const double PIECES_MOST = 2e5, FACE_MOST = 64.0;
/* Of pieces that choose their own size, texels. */
static const double RADIUS_LEAST = 32.0;
static const double TAU = 6.283185307179586;

static const char *const MODES[] = {
    "auto", "splotch", "clumps", "packing", "ordered", "paper", NULL};
static const char *const OUTLINES[] = {"splotch", "circle", NULL};

static const otx_option OPTIONS[] = {
    {"mode", OTX_OPTION_CHOICE, offsetof(otx_lapped_settings, mode), 0, 0,
     OTX_LAPPED_AUTO, MODES,
     "How pieces are cut and laid: splotch for pictures without features; of "
     "whole features clumps for leaves, packing for stones, ordered for "
     "scales; paper as published"},
    {"outline", OTX_OPTION_CHOICE, offsetof(otx_lapped_settings, outline), 0, 0,
     OTX_LAPPED_OUTLINE_SPLOTCH, OUTLINES, "Shape of pieces that have none"},
    {"radius", OTX_OPTION_REAL, offsetof(otx_lapped_settings, radius), 0, 16384,
     0, NULL, "Mean radius of pieces, in texels; 0 chooses"},
    {"feather", OTX_OPTION_REAL, offsetof(otx_lapped_settings, feather), -1,
     4096, -1, NULL,
     "Texels over which pieces fade at their outline; -1 chooses"},
};

enum
{
    OPTION_COUNT = sizeof OPTIONS / sizeof OPTIONS[0]
};

/* ---- settings ---- */

/* The largest radius whose bulges stay inside of the picture. */
static double
largest_radius(const otx_exemplar *e)
{
    const double w = e->wrap_x ? INFINITY : e->match.width;
    const double h = e->wrap_y ? INFINITY : e->match.height;

    return fmin(0.3 * fmin(w, h), 0.5 * fmax(e->match.width, e->match.height));
}

static void
resolve(void *settings, const otx_exemplar *e, const otx_cage *cage)
{
    otx_lapped_settings *s = settings;
    (void)cage;
    if (s->radius > 0.0)
        s->radius = fmin(s->radius, largest_radius(e));
    if (s->feather < 0.0)
        s->feather = s->mode == OTX_LAPPED_PAPER ? 3.0 : 2.0;
}

/* A ninth of the side of a square as large as the surface: pieces are as large
 * as still lie flat on most surfaces, and fewer show fewer rims. */
static void
choose_radius(otx_lapped *l)
{
    const double side = sqrt(l->surface->area) * l->texels;

    if (!(l->settings.radius > 0.0))
        l->settings.radius =
            fmin(fmax(RADIUS_LEAST, side / 9.0), largest_radius(l->exemplar));
}

/* ---- preparation ---- */

static otx_status
make_guide(otx_lapped *l)
{
    const otx_map_request *request = l->job->request;
    otx_analysis a;

    if (request->analysis)
        a = *request->analysis;
    else
        OTX_TRY(otx_exemplar_analysis(l->run, l->exemplar, &a));
    if (l->job->figures)
        l->job->figures->classes[0] = otx_analysis_name(a.kind);
    OTX_TRY(otx_lapped_find_features(l, a.kind));
    if (request->guide)
    {
        l->guide = *request->guide;
        return OSDTEX_OK;
    }
    /* Features stand upright along the field. */
    if (l->settings.mode == OTX_LAPPED_ORDERED)
    {
        a.symmetry = 1;
        a.angle = 0.25 * TAU;
    }
    if (a.kind == OTX_ANALYSIS_ISOTROPIC &&
        l->settings.mode != OTX_LAPPED_ORDERED)
        return OSDTEX_OK;
    return otx_guide_make(
        l->run, l->surface, &a, request->constraints, &l->guide);
}

/* Refuses what would take for ever: pieces that are tiny on the surface, and
 * faces so large that samples would miss them. */
static otx_status
check_size(const otx_lapped *l)
{
    const double r = l->settings.radius;
    const double count =
        2.0 * l->surface->area * l->texels * l->texels / (0.5 * TAU * r * r);

    if (!(count < PIECES_MOST))
        return otx_fail(
            l->run, OSDTEX_ERROR_LIMIT, "map", OTX_NOWHERE,
            "the surface would take about %.2g pieces of the exemplar; raise "
            "{scale} or the setting 'radius'",
            count);
    for (int32_t f = 0; f < l->leaf->face_count; ++f)
    {
        const double texels = otx_lapped_texels(l, f);

        if (otx_level_face_size(l->leaf, f) > OTX_LAPPED_CORNERS)
            return otx_fail(
                l->run, OSDTEX_ERROR_SUPPORT, "map",
                (otx_where){
                    l->surface->cage->path, 0, l->leaf->face_cage[f], -1},
                "a face has more than a thousand corners, which pieces cannot "
                "be laid on");
        if (l->connection.areas[f] * texels * texels > FACE_MOST * r * r)
            return otx_fail(
                l->run, OSDTEX_ERROR_LIMIT, "map",
                (otx_where){
                    l->surface->cage->path, 0, l->leaf->face_cage[f], -1},
                "a leaf of face %d is much larger than a piece of the "
                "exemplar; raise {level} or {scale}",
                (int)l->leaf->face_cage[f]);
    }
    return OSDTEX_OK;
}

static otx_status
prepare(otx_lapped *l)
{
    const otx_surface *surface;

    OTX_TRY(otx_density_apply(
        l->run, l->job->surface, l->job->request->constraints, &surface));
    l->surface = surface;
    l->leaf = otx_surface_leaf(surface);
    l->texels = otx_unit_texels(l->exemplar, l->job->request->scale);
    OTX_TRY(otx_connection_build(
        l->run, surface, surface->level_count - 1, &l->connection));
    choose_radius(l);
    OTX_TRY(check_size(l));
    OTX_TRY(make_guide(l));
    return otx_samples_create(l->run, surface, l->texels, SPACING, &l->samples);
}

static otx_status
map(const otx_job *job, otx_mapping *out)
{
    otx_lapped *l = OTX_ZNEW(job->run->scratch, otx_lapped, 1);

    if (!l)
        return otx_fail_memory(job->run, "map");
    l->job = job;
    l->run = job->run;
    l->exemplar = &job->exemplars[0];
    l->settings = *(const otx_lapped_settings *)job->settings;
    resolve(&l->settings, l->exemplar, job->surface->cage);
    OTX_TRY(prepare(l));
    otx_figures_stage(job->figures, "paste");
    OTX_TRY(otx_lapped_paste_all(l));
    otx_figures_stage(job->figures, "compose");
    return otx_lapped_compose(l, out);
}

static otx_status
applicable(const otx_job *job, otx_suitability *out)
{
    otx_features features;

    *out = (otx_suitability){
        0.3, "overlapping pieces suit any exemplar, where seams may show"};
    if (job->exemplar_count > 1 || !otx_features_are_cut_out(job->exemplars))
        return OSDTEX_OK;
    OTX_TRY(otx_features_find(job->run, job->exemplars, &features));
    /* Others would show what is transparent. */
    if (otx_features_are_clear(&features))
        *out = (otx_suitability){
            0.9, "its alpha cuts out whole things, which are laid over one "
                 "another"};
    return OSDTEX_OK;
}

extern const otx_method otx_method_lapped;

const otx_method otx_method_lapped = {
    .name = "lapped",
    .summary = "Pastes irregular pieces of the exemplar over one another along "
               "a field until the surface is covered.",
    .source = "Praun, Finkelstein, Hoppe: Lapped Textures, 2000",
    .options = OPTIONS,
    .option_count = OPTION_COUNT,
    .settings_bytes = sizeof(otx_lapped_settings),
    .resolve = resolve,
    .applicable = applicable,
    .map = map,
};
