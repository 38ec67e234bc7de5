/* vertex.c -- texture made on the surface itself [Turk01], by the engine of
 * room synth on charts that cover it. */
#include "method/vertex/vertex.h"

#include "analysis/exemplar_analysis.h"
#include "method/density.h"
#include "method/vertex/turk.h"
#include "seam/unit.h"
#include "territory/made.h"

enum
{
    CORE = 288, /* texels across, of what a chart makes */
    LEVELS = 5,
    STARTS = 4, /* by chance */
    MARGIN = 4  /* texels of a collar beyond what windows reach */
};

static const char *const STARTS_NAMES[] = {"auto", "patches", "random", NULL};

static const char *const MODES[] = {"auto", "charts", "paper", NULL};

static const otx_option OPTIONS[] = {
    {"mode", OTX_OPTION_CHOICE, offsetof(otx_vertex_settings, mode), 0, 0,
     OTX_VERTEX_MODE_AUTO, MODES,
     "How it is made: charts for places and angles of texels, all at once; "
     "paper as published, vertex by vertex along the field"},
    {"start", OTX_OPTION_CHOICE, offsetof(otx_vertex_settings, start), 0, 0,
     OTX_VERTEX_START_AUTO, STARTS_NAMES,
     "What it begins with: patches of the method hierarchical, or places by "
     "chance along the field"},
    {"tolerance", OTX_OPTION_REAL, offsetof(otx_vertex_settings, tolerance), 0,
     180, 10, NULL, "Degrees that a random start may depart from the field"},
    {"levels", OTX_OPTION_INTEGER, offsetof(otx_vertex_settings, levels), 0,
     OTX_PATTERN_LEVELS, 0, NULL,
     "Levels from coarse to fine; 0 chooses: the coarsest window is to be one "
     "or two features"},
    {"starts", OTX_OPTION_INTEGER, offsetof(otx_vertex_settings, starts), 0, 64,
     0, NULL,
     "Starts by chance, of which every chart keeps its best; 0 chooses"},
};

enum
{
    OPTION_COUNT = sizeof OPTIONS / sizeof OPTIONS[0]
};

static void
resolve(void *settings, const otx_exemplar *exemplar, const otx_cage *cage)
{
    otx_vertex_settings *s = settings;

    (void)exemplar, (void)cage;
    if (s->mode == OTX_VERTEX_MODE_AUTO)
        s->mode = OTX_VERTEX_MODE_CHARTS;
    if (s->levels == 0)
        s->levels = LEVELS;
    if (s->starts == 0)
        s->starts = STARTS;
}

/* ---- what it begins with ---- */

static otx_status
analyse(otx_vertex *v)
{
    const otx_exemplar *e = v->job->exemplars;

    if (v->job->request->analysis)
        v->analysis = *v->job->request->analysis;
    else
        OTX_TRY(otx_exemplar_analysis(v->run, e, &v->analysis));
    if (v->job->figures)
        v->job->figures->classes[0] = otx_analysis_name(v->analysis.kind);
    return OSDTEX_OK;
}

static void
choose_start(otx_vertex *v)
{
    const bool directed =
        v->job->request->guide || v->analysis.kind != OTX_ANALYSIS_ISOTROPIC;

    if (v->settings.mode == OTX_VERTEX_MODE_PAPER)
        v->settings.start = OTX_VERTEX_START_RANDOM;
    if (v->settings.start != OTX_VERTEX_START_AUTO)
        return;
    if (!directed && !otx_method_can_fill())
    {
        v->settings.start = OTX_VERTEX_START_RANDOM;
        return;
    }
    v->settings.start =
        directed ? OTX_VERTEX_START_RANDOM : OTX_VERTEX_START_PATCHES;
    otx_note(
        v->run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE, "%s",
        directed
            ? "the exemplar has a direction, which is to bend with the "
              "surface: it starts at random along the field"
            : "the exemplar has no direction: it starts from patches, whose "
              "features are whole");
}

static otx_status
make_guide(otx_vertex *v)
{
    const otx_map_request *request = v->job->request;
    otx_guide guide = {0};

    if (request->guide)
        guide = *request->guide;
    else if (
        v->analysis.kind != OTX_ANALYSIS_ISOTROPIC ||
        v->settings.mode == OTX_VERTEX_MODE_PAPER)
        OTX_TRY(otx_guide_make(
            v->run, v->mapping.surface, &v->analysis, request->constraints,
            &guide));
    if (!guide.directions)
        return OSDTEX_OK;
    return otx_vertex_comb(v->run, v->mapping.surface, &guide, &v->guide);
}

/* A mapping that shows one point, all of whose faces are to be made. */
static otx_status
begin_empty(otx_vertex *v)
{
    const otx_surface *surface;
    const otx_level *leaf;

    OTX_TRY(otx_density_apply(
        v->run, v->job->surface, v->job->request->constraints, &surface));
    if (v->settings.mode == OTX_VERTEX_MODE_PAPER && surface != v->job->surface)
    {
        otx_note(
            v->run, OSDTEX_SEVERITY_WARNING, "map", OTX_NOWHERE,
            "the published method has one size everywhere; the scales among "
            "the constraints are left out");
        surface = v->job->surface;
    }
    leaf = otx_surface_leaf(surface);
    v->mapping = (otx_mapping){
        .surface = surface,
        .scale = v->job->request->scale,
        .uvs = OTX_ZNEW(v->run->arena, float, 2 * (int64_t)leaf->corner_count),
        .face_patch = OTX_NEW(v->run->arena, int32_t, leaf->face_count),
        .patch_count = 1};
    OTX_TRY(otx_run_ok(v->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        v->mapping.face_patch[f] = leaf->face_hole[f] ? -1 : 0;
    OTX_TRY(make_guide(v));
    if (v->guide.directions)
    {
        otx_guide *guide = OTX_NEW(v->run->arena, otx_guide, 1);

        OTX_TRY(otx_run_ok(v->run));
        *guide = v->guide;
        v->mapping.guide = guide;
    }
    return OSDTEX_OK;
}

static otx_status
begin(otx_vertex *v)
{
    if (v->settings.start == OTX_VERTEX_START_PATCHES)
        return otx_method_patches(v->job, &v->mapping);
    return begin_empty(v);
}

/* ---- charts ---- */

static otx_status
lay_out(otx_vertex *v)
{
    otx_target_set *set = &v->set;
    const int32_t radius = otx_synth_making().coarse_radius;
    const double texels =
        otx_unit_texels(v->job->exemplars, v->job->request->scale);
    uint8_t *loose = NULL;

    if (v->guide.directions && v->settings.mode != OTX_VERTEX_MODE_PAPER)
        OTX_TRY(otx_vertex_find_poles(
            v->run, v->mapping.surface, &v->guide,
            0.5 * (1 + 2 * radius) * ldexp(1.0, v->settings.levels - 1) /
                texels,
            &loose));
    *set = (otx_target_set){
        .run = v->run,
        .mapping = &v->mapping,
        .exemplars = v->job->exemplars,
        .texels = texels,
        .guide = v->guide.directions ? &v->guide : NULL,
        .loose = loose,
        .whole = true};
    OTX_TRY(otx_target_set_lay_out(
        set, CORE, (double)(radius << (v->settings.levels - 1)) + MARGIN));
    v->charts = OTX_NEW(v->run->scratch, otx_synth_chart, set->territory.count);
    OTX_TRY(otx_run_ok(v->run));
    for (int32_t k = 0; k < set->territory.count; ++k)
        OTX_TRY(otx_target_fill(set, k));
    otx_target_charts(set, v->charts);
    return OSDTEX_OK;
}

static otx_synth_options
options_of(const otx_vertex *v)
{
    otx_synth_options options = otx_synth_making();

    options.levels = v->settings.levels;
    options.seed = v->run->seed;
    options.stage = "synth";
    options.starts = v->settings.starts;
    options.tolerance = v->settings.tolerance * OTX_PI / 180.0;
    if (v->guide.directions)
        options.symmetry = v->guide.symmetry;
    if (v->settings.start == OTX_VERTEX_START_RANDOM)
        return options;
    options.given = true;
    options.starts = 1;
    options.usage = 0.0;
    return options;
}

static otx_status
make(otx_vertex *v)
{
    const otx_synth_options options = options_of(v);
    const otx_arena_mark mark = otx_arena_here(v->run->scratch);
    otx_pattern pattern;

    OTX_TRY(otx_target_pattern(&v->set, options.levels, &pattern));
    OTX_TRY(otx_synth_run(
        v->run, &pattern, v->charts, v->set.territory.count, &options));
    otx_arena_release(v->run->scratch, mark);
    return OSDTEX_OK;
}

/* ---- the row ---- */

static otx_status
map(const otx_job *job, otx_mapping *out)
{
    otx_vertex *v = OTX_ZNEW(job->run->scratch, otx_vertex, 1);

    if (!v)
        return otx_fail_memory(job->run, "map");
    v->job = job;
    v->run = job->run;
    v->settings = *(const otx_vertex_settings *)job->settings;
    resolve(&v->settings, job->exemplars, job->surface->cage);
    OTX_TRY(analyse(v));
    choose_start(v);
    OTX_TRY(begin(v));
    otx_figures_stage(job->figures, "charts");
    OTX_TRY(lay_out(v));
    otx_figures_stage(job->figures, "synth");
    OTX_TRY(
        v->settings.mode == OTX_VERTEX_MODE_PAPER ? otx_turk_make(v) : make(v));
    otx_figures_stage(job->figures, "compose");
    OTX_TRY(otx_made_hand_out(&v->set, &v->mapping.field));
    if (v->settings.start == OTX_VERTEX_START_RANDOM)
        OTX_TRY(otx_vertex_lay_uvs(v));
    OTX_TRY(otx_vertex_report(v));
    *out = v->mapping;
    return OSDTEX_OK;
}

static otx_status
applicable(const otx_job *job, otx_suitability *out)
{
    (void)job;
    *out = (otx_suitability){
        0.4, "texture made on the surface suits any exemplar, and takes longer "
             "than patches"};
    return OSDTEX_OK;
}

extern const otx_method otx_method_vertex;

const otx_method otx_method_vertex = {
    .name = "vertex",
    .summary = "Makes texture on the surface itself, coarse to fine, along a "
               "field and without seams.",
    .source = "Turk: Texture Synthesis on Surfaces, 2001",
    .options = OPTIONS,
    .option_count = OPTION_COUNT,
    .settings_bytes = sizeof(otx_vertex_settings),
    .resolve = resolve,
    .applicable = applicable,
    .map = map,
};
