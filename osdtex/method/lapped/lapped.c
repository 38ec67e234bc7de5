/* lapped.c -- pieces of the exemplar pasted over one another until the surface
 * is covered [Praun00]. */
#include "method/lapped/lapped.h"

#include "base/pqueue.h"
#include "base/random.h"
#include "method/density.h"
#include "method/lapped/radial_cut.h"
#include "seam/unit.h"

#include <string.h>

enum
{
    STAGE_ORDER = 0x6c617001, /* of random numbers */
    STAGE_SAMPLE,
    STAGE_TURN,
    STAGE_CENTRE,
    STAGE_SHAPE
};

enum
{
    WAVES = 5 /* around a splotch: 2 to WAVES + 1 bulges */
};

/* From sample to sample of the coverage, texels. */
static const double SPACING = 2.0;
/* Pieces on a surface, and the area of a leaf in squares of their radius. */
static const double PIECES_MOST = 2e5, FACE_MOST = 64.0;
static const double BULGE = 0.09; /* of the radius, each wave */
static const double TAU = 6.283185307179586;

static const char *const MODES[] = {"auto", "splotch", "paper", NULL};
static const char *const OUTLINES[] = {"splotch", "circle", NULL};

static const otx_option OPTIONS[] = {
    {"mode", OTX_OPTION_CHOICE, offsetof(otx_lapped_settings, mode), 0, 0,
     OTX_LAPPED_AUTO, MODES,
     "How pieces are cut and laid: splotch for pictures without features; "
     "paper "
     "as published"},
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
    const double side = fmin(e->match.width, e->match.height);

    (void)cage;
    if (s->mode == OTX_LAPPED_AUTO)
        s->mode = OTX_LAPPED_SPLOTCH;
    if (!(s->radius > 0.0))
        s->radius = fmax(48.0, side / 8.0);
    s->radius = fmin(s->radius, largest_radius(e));
    if (s->feather < 0.0)
        s->feather = s->mode == OTX_LAPPED_PAPER ? 3.0 : 2.0;
}

/* ---- preparation ---- */

static otx_status
make_guide(otx_lapped *l)
{
    const otx_map_request *request = l->job->request;
    otx_analysis a;

    if (request->guide)
    {
        l->guide = *request->guide;
        return OSDTEX_OK;
    }
    if (request->analysis)
        a = *request->analysis;
    else
        OTX_TRY(otx_analysis_run(
            l->run, &l->exemplar->lab, l->exemplar->wrap_x, l->exemplar->wrap_y,
            &a));
    if (l->job->figures)
        l->job->figures->classes[0] = otx_analysis_name(a.kind);
    if (a.kind == OTX_ANALYSIS_ISOTROPIC)
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
    otx_arena *scratch = l->run->scratch;
    const otx_surface *surface;

    OTX_TRY(otx_density_apply(
        l->run, l->job->surface, l->job->request->constraints, &surface));
    l->surface = surface;
    l->leaf = otx_surface_leaf(surface);
    l->texels = otx_unit_texels(l->exemplar, l->job->request->scale);
    OTX_TRY(otx_connection_build(
        l->run, surface, surface->level_count - 1, &l->connection));
    OTX_TRY(check_size(l));
    OTX_TRY(make_guide(l));
    OTX_TRY(
        otx_samples_create(l->run, surface, l->texels, SPACING, &l->samples));
    l->space.face_slot = OTX_NEW(scratch, int32_t, l->leaf->face_count);
    l->space.vert_slot = OTX_NEW(scratch, int32_t, l->leaf->vert_count);
    OTX_TRY(otx_run_ok(l->run));
    memset(l->space.face_slot, -1, (size_t)l->leaf->face_count * 4);
    memset(l->space.vert_slot, -1, (size_t)l->leaf->vert_count * 4);
    return OSDTEX_OK;
}

/* ---- order of seeds ---- */

/* How much the surface bends, and the field turns, around a face. */
static double
difficulty(const otx_lapped *l, int32_t face)
{
    double sum = 0.0;

    for (int32_t k = 0; k < otx_level_face_size(l->leaf, face); ++k)
    {
        const int32_t other = otx_level_neighbour(l->leaf, face, k);

        if (other >= 0)
            sum += 1.0 - otx_vec3_dot(
                             l->connection.normals[face],
                             l->connection.normals[other]);
    }
    return sum;
}

/* All faces in the order in which they are tried: difficult ones first, where
 * later pastes may cover what comes out badly [Praun00, sec. 3.3], then by
 * chance. */
static otx_status
order_faces(const otx_lapped *l, otx_pqueue *out)
{
    const double mild = 0.15;

    *out = otx_pqueue_make(l->run->scratch);
    for (int32_t f = 0; f < l->leaf->face_count; ++f)
    {
        const double chance =
            otx_random_unit(l->run->seed, STAGE_ORDER, (uint64_t)f);
        const double hard = difficulty(l, f);

        if (!l->leaf->face_hole[f])
            otx_pqueue_push(out, hard > mild ? chance - 1.0 : chance, f);
    }
    return otx_run_ok(l->run);
}

/* ---- a paste ---- */

/* A shape that bulges, or a circle [Praun00, sec. 3.1]. */
static otx_radial
make_outline(const otx_lapped *l)
{
    const uint64_t seed = otx_random_bits(
        l->run->seed, STAGE_SHAPE, (uint64_t)(uint32_t)l->paste_count);
    const bool bulges = l->settings.outline == OTX_LAPPED_OUTLINE_SPLOTCH;
    otx_radial o = {.feather = (float)l->settings.feather};

    for (int32_t i = 0; i < OTX_RADIAL_ANGLES; ++i)
    {
        double r = 1.0;

        for (uint64_t w = 0; bulges && w < WAVES; ++w)
            r += BULGE * sin((double)(w + 2) * TAU * i / OTX_RADIAL_ANGLES +
                             TAU * otx_random_unit(seed, STAGE_SHAPE, w));
        o.radius[i] = (float)(l->settings.radius * r);
    }
    otx_radial_bound(&o);
    return o;
}

/* One of the samples of a face that are not covered. */
static int32_t
open_sample(const otx_lapped *l, int32_t face)
{
    const uint8_t *covered = l->samples.covered + l->samples.first[face];
    const uint64_t element =
        ((uint64_t)(uint32_t)l->paste_count << 32) + (uint64_t)(uint32_t)face;
    int32_t wanted = (int32_t)(otx_random_unit(
                                   l->run->seed, STAGE_SAMPLE, element) *
                               l->samples.open[face]);

    for (int32_t i = 0;; ++i)
        if (!covered[i] && wanted-- == 0)
            return i;
}

static otx_lapped_seed
seed_at(const otx_lapped *l, int32_t face, int32_t sample)
{
    const double turn = otx_random_unit(
        l->run->seed, STAGE_TURN, (uint64_t)(uint32_t)l->paste_count);

    return (otx_lapped_seed){
        face, otx_samples_at(&l->samples, face, sample),
        otx_vec2_polar(TAU * turn)};
}

/* Where along an axis a piece that reaches so far is taken from. */
static double
place_on_axis(double random, double side, bool wraps, double reach)
{
    const double least = wraps ? 0.0 : fmin(reach, 0.5 * side);

    return least + random * (side - 2.0 * least);
}

/* Any place of the exemplar. */
static otx_vec2
choose_centre(const otx_lapped *l, double reach)
{
    const otx_exemplar *e = l->exemplar;
    const uint64_t n = 2 * (uint64_t)(uint32_t)l->paste_count;
    const double x = otx_random_unit(l->run->seed, STAGE_CENTRE, n);
    const double y = otx_random_unit(l->run->seed, STAGE_CENTRE, n + 1);

    return (otx_vec2){
        place_on_axis(x, e->match.width, e->wrap_x, reach),
        place_on_axis(y, e->match.height, e->wrap_y, reach)};
}

/* A chart in memory of its own size. */
static otx_status
keep_chart(otx_lapped *l, const otx_lapped_chart *from, otx_lapped_chart *out)
{
    otx_arena *arena = l->run->arena;
    const size_t faces = (size_t)from->face_count;
    const size_t verts = (size_t)from->vert_count;
    const size_t corners = (size_t)from->first[faces];

    *out = (otx_lapped_chart){
        .face_count = from->face_count,
        .vert_count = from->vert_count,
        .faces = OTX_NEW(arena, int32_t, faces),
        .first = OTX_NEW(arena, int32_t, faces + 1),
        .corners = OTX_NEW(arena, int32_t, corners),
        .verts = OTX_NEW(arena, int32_t, verts),
        .flat = OTX_NEW(arena, otx_vec2, verts),
        .rights = OTX_NEW(arena, otx_vec3, faces)};
    OTX_TRY(otx_run_ok(l->run));
    memcpy(out->faces, from->faces, faces * sizeof *out->faces);
    memcpy(out->first, from->first, (faces + 1) * sizeof *out->first);
    memcpy(out->corners, from->corners, corners * sizeof *out->corners);
    memcpy(out->verts, from->verts, verts * sizeof *out->verts);
    memcpy(out->flat, from->flat, verts * sizeof *out->flat);
    memcpy(out->rights, from->rights, faces * sizeof *out->rights);
    return OSDTEX_OK;
}

static otx_status
next_paste(otx_lapped *l, otx_lapped_paste **out)
{
    if (l->paste_count == l->paste_capacity)
    {
        const int32_t to = 2 * l->paste_capacity + 64;
        otx_lapped_paste *wider = OTX_NEW(l->run->arena, otx_lapped_paste, to);

        if (!wider)
            return otx_fail_memory(l->run, "map");
        if (l->paste_count > 0)
            memcpy(wider, l->pastes, (size_t)l->paste_count * sizeof *wider);
        l->pastes = wider;
        l->paste_capacity = to;
    }
    *out = &l->pastes[l->paste_count];
    return OSDTEX_OK;
}

static otx_status
paste_at(otx_lapped *l, int32_t face, int32_t sample)
{
    const otx_lapped_seed seed = seed_at(l, face, sample);
    const otx_arena_mark here = otx_arena_here(l->run->scratch);
    const otx_radial outline = make_outline(l);
    otx_lapped_chart chart;
    otx_lapped_paste *paste = NULL;
    otx_status status;

    OTX_TRY(next_paste(l, &paste));
    status = otx_lapped_unfold(l, &seed, &outline, l->run->scratch, &chart);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(l->run, "map");
    if (status == OSDTEX_ERROR_SUPPORT)
        return otx_fail(
            l->run, status, "map", otx_where_file(l->surface->cage->path),
            "a face has more than a thousand corners, which pieces cannot be "
            "laid on");
    OTX_TRY(status);
    OTX_TRY(keep_chart(l, &chart, &paste->chart));
    paste->centre = choose_centre(l, (double)outline.most);
    paste->cut = OTX_NEW(l->run->arena, otx_radial, 1);
    OTX_TRY(otx_run_ok(l->run));
    *paste->cut = outline;
    if (l->settings.mode != OTX_LAPPED_PAPER)
        OTX_TRY(otx_lapped_cut(l, &outline, paste));
    OTX_TRY(otx_lapped_rim(l, paste->cut, l->run->arena, &paste->chart));
    otx_lapped_mark(l, paste);
    otx_arena_release(l->run->scratch, here);
    /* Its own seed, whatever comes of rounding. */
    otx_samples_set(&l->samples, face, sample);
    ++l->paste_count;
    return OSDTEX_OK;
}

static otx_status
paste_all(otx_lapped *l)
{
    const double all = (double)l->samples.left;
    otx_pqueue_entry entry;
    otx_pqueue faces;

    OTX_TRY(order_faces(l, &faces));
    while (otx_pqueue_pop(&faces, &entry))
        while (l->samples.open[entry.item] > 0)
        {
            OTX_TRY(paste_at(l, entry.item, open_sample(l, entry.item)));
            OTX_TRY(otx_progress(
                l->run, "paste", 1.0 - (double)l->samples.left / all));
        }
    return OSDTEX_OK;
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
    OTX_TRY(paste_all(l));
    otx_figures_stage(job->figures, "compose");
    return otx_lapped_compose(l, out);
}

static otx_status
applicable(const otx_job *job, otx_suitability *out)
{
    (void)job;
    *out = (otx_suitability){
        0.3, "overlapping pieces suit any exemplar, where seams may show"};
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
