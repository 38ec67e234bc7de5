/* keep.c -- a mapping kept through a change of the cage. */
#include "edit/keep.h"

#include "edit/apply.h"
#include "edit/refit.h"
#include "flatten/stretch.h"
#include "mapping/source.h"
#include "seam/unit.h"
#include "surface/subset.h"

#include <string.h>

/* Largest singular value of the change of a leaf, or its inverse, up to which
 * it counts as unchanged: texture that is a twentieth off is not seen. */
static const double CHANGED = 1.05;

/* A change that is no more than rounding. */
static const double ROUNDING = 1.0001;

/* Largest stretch of the texture that small changes may add up to. */
static const double TOLERATED = 1.25;

/* And beyond which a leaf is covered anew; as relaxation has it. */
static const double STRETCHED = 1.6;

/* Texels around leaves that are covered anew in which the new may spread. */
static const double COLLAR = 24.0;

/* Of a leaf: the larger of stretch and its inverse, of its change and of its
 * texture before and after. */
typedef struct strain
{
    double change, before, after;
} strain;

static double
badness(const double sigma[2])
{
    return sigma[1] > 0.0 ? fmax(sigma[0], 1.0 / sigma[1]) : INFINITY;
}

/* Adds a triangle of the fan of a leaf. */
static void
add_triangle(
    const otx_keep *k, const int32_t corners[3], double texels,
    const otx_image *match, strain *s)
{
    const otx_level *leaf = otx_surface_leaf(k->job->surface);
    otx_vec3 was[3], now[3];
    otx_vec2 uv[3], flat[3];
    double sigma[2];

    for (int i = 0; i < 3; ++i)
    {
        const int32_t v = leaf->face_verts[corners[i]];
        const float *at = k->from->uvs + 2 * (size_t)corners[i];

        was[i] = otx_vec3_scale(texels, otx_vec3_load(k->points, v));
        now[i] =
            otx_vec3_scale(texels, otx_vec3_load(k->job->surface->points, v));
        uv[i] = (otx_vec2){
            (double)at[0] * match->width, (double)at[1] * match->height};
    }
    otx_stretch_layout(was, flat);
    otx_stretch_singular(now, flat, sigma);
    s->change = fmax(s->change, badness(sigma));
    otx_stretch_singular(was, uv, sigma);
    s->before = fmax(s->before, badness(sigma));
    otx_stretch_singular(now, uv, sigma);
    s->after = fmax(s->after, badness(sigma));
}

static strain
strain_of(const otx_keep *k, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(k->job->surface);
    const otx_exemplar *exemplars = k->job->exemplars;
    const otx_image *match = &exemplars[otx_source_of(k->from, face)].match;
    const int32_t first = leaf->face_first[face];
    const int32_t end = leaf->face_first[face + 1];
    const double texels =
        otx_unit_texels(exemplars, k->from->scale) *
        otx_surface_density(
            k->from->surface, leaf->face_verts + first, end - first);
    strain s = {1.0, 1.0, 1.0};

    for (int32_t c = first + 1; c + 1 < end; ++c)
        add_triangle(k, (const int32_t[3]){first, c, c + 1}, texels, match, &s);
    return s;
}

static uint8_t
state_of(const otx_keep *k, int32_t face)
{
    strain s;

    if (otx_surface_leaf(k->job->surface)->face_hole[face])
        return OTX_REFIT_HELD;
    if (k->from->face_patch[face] < 0)
        return OTX_REFIT_OPEN;
    s = strain_of(k, face);
    if (s.change <= ROUNDING ||
        (s.change <= CHANGED && s.after <= fmax(TOLERATED, s.before)))
        return k->loose && k->loose[face] ? OTX_REFIT_FREE : OTX_REFIT_HELD;
    return s.after <= fmax(STRETCHED, s.before) ? OTX_REFIT_FREE
                                                : OTX_REFIT_OPEN;
}

/* What lies around faces that are covered anew may be, too. */
static otx_status
mark_collar(const otx_keep *k, uint8_t *state)
{
    otx_run *run = k->job->run;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t faces = otx_surface_leaf(k->job->surface)->face_count;
    uint8_t *marked = OTX_NEW(run->scratch, uint8_t, faces);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < faces; ++f)
        marked[f] = state[f] == OTX_REFIT_OPEN;
    OTX_TRY(otx_subset_widen(
        run, k->job->surface,
        COLLAR / otx_unit_texels(k->job->exemplars, k->from->scale), 2,
        marked));
    for (int32_t f = 0; f < faces; ++f)
        if (marked[f] == 2)
            state[f] = OTX_REFIT_EITHER;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_keep_states(const otx_keep *keep, uint8_t *state)
{
    const int32_t faces = otx_surface_leaf(keep->job->surface)->face_count;

    for (int32_t f = 0; f < faces; ++f)
        state[f] = state_of(keep, f);
    return mark_collar(keep, state);
}

static void
count(const uint8_t *state, int32_t faces, otx_keep_tally *tally)
{
    *tally = (otx_keep_tally){0};
    for (int32_t f = 0; f < faces; ++f)
    {
        tally->held += state[f] == OTX_REFIT_HELD;
        tally->moved += state[f] == OTX_REFIT_FREE;
        tally->covered += state[f] >= OTX_REFIT_EITHER;
    }
}

/* Whether a face shows within a texel what it was given. */
static bool
shows_the_same(const otx_keep *k, const otx_mapping *made, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(k->job->surface);
    const otx_image *match =
        &k->job->exemplars[otx_source_of(made, face)].match;

    if (made->face_patch[face] != k->from->face_patch[face])
        return false;
    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
    {
        const float *a = made->uvs + 2 * (size_t)c;
        const float *b = k->from->uvs + 2 * (size_t)c;

        if (hypot(
                ((double)a[0] - (double)b[0]) * match->width,
                ((double)a[1] - (double)b[1]) * match->height) > 1.0)
            return false;
    }
    return true;
}

static double
area_of(const otx_keep *k, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(k->job->surface);
    const float *points = k->job->surface->points;
    const int32_t first = leaf->face_first[face];
    const otx_vec3 p = otx_vec3_load(points, leaf->face_verts[first]);
    otx_vec3 sum = {0.0, 0.0, 0.0};

    for (int32_t c = first + 1; c + 1 < leaf->face_first[face + 1]; ++c)
        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(
                otx_vec3_sub(otx_vec3_load(points, leaf->face_verts[c]), p),
                otx_vec3_sub(
                    otx_vec3_load(points, leaf->face_verts[c + 1]), p)));
    return 0.5 * otx_vec3_length(sum);
}

/* Share of a face that shows what it did: what lies beyond its patch does not,
 * as far as corners tell. */
static double
share_of_face(const otx_keep *k, const otx_mapping *made, int32_t face)
{
    const int32_t size =
        otx_level_face_size(otx_surface_leaf(k->job->surface), face);
    const int32_t beyond = k->loose ? k->loose[face] : 0;

    return shows_the_same(k, made, face) ? 1.0 - (double)beyond / size : 0.0;
}

/* Share of the area that shows what it did. */
static double
share_of_the_same(const otx_keep *k, const otx_mapping *made)
{
    const otx_level *leaf = otx_surface_leaf(k->job->surface);
    double all = 0.0, same = 0.0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const double area = leaf->face_hole[f] ? 0.0 : area_of(k, f);

        all += area;
        same += area > 0.0 ? area * share_of_face(k, made, f) : 0.0;
    }
    return all > 0.0 ? same / all : 1.0;
}

/* What each face shows is what it is asked for; NULL of one exemplar. */
static otx_status
demand_shown(const otx_keep *k, otx_run *run, const uint8_t **out)
{
    const int32_t faces = otx_surface_leaf(k->job->surface)->face_count;
    uint8_t *demand;

    *out = NULL;
    if (otx_source_count(k->from) == 1)
        return OSDTEX_OK;
    demand = OTX_NEW(run->arena, uint8_t, faces);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < faces; ++f)
        demand[f] = (uint8_t)otx_source_of(k->from, f);
    *out = demand;
    return OSDTEX_OK;
}

static otx_status
keep_on(const otx_keep *k, otx_run *aside, otx_mapping *out, otx_keep_tally *t)
{
    const int32_t faces = otx_surface_leaf(k->job->surface)->face_count;
    uint8_t *state = OTX_NEW(aside->arena, uint8_t, faces);
    otx_surface surface = *k->job->surface;
    otx_map_request request = *k->job->request;
    otx_job job = *k->job;
    const otx_refit refit = {
        .job = &job,
        .method = k->method->fill ? k->method : NULL,
        .from = k->from,
        .state = state};
    otx_mapping made;

    OTX_TRY(otx_run_ok(aside));
    OTX_TRY(otx_keep_states(k, state));
    count(state, faces, t);
    surface.density = k->from->surface->density;
    request.guide = k->from->guide;
    request.constraints = NULL;
    request.first_face = -1;
    OTX_TRY(demand_shown(k, aside, &request.demand));
    job.run = aside;
    job.surface = &surface;
    job.request = &request;
    OTX_TRY(otx_refit_run(&refit, &made));
    t->texels = share_of_the_same(k, &made);
    made.lattice = NULL;
    if (!surface.density)
        made.surface = k->job->surface;
    return otx_edit_copy(k->job->run, &made, out);
}

otx_status
otx_keep_run(const otx_keep *keep, otx_mapping *out, otx_keep_tally *tally)
{
    otx_run *run = keep->job->run, aside = *run;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_status status;

    OTX_TRY(
        otx_edit_check(run, keep->method, keep->from, keep->job->exemplars));
    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, "keep");
    status = keep_on(keep, &aside, out, tally);
    otx_arena_destroy(aside.arena);
    otx_arena_release(run->scratch, mark);
    return status;
}
