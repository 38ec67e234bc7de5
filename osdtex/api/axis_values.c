/* axis_values.c -- height, bends, what hides and how far, as one number. */
#include "api/axis_values.h"

#include "api/mask_pictures.h"
#include "base/random.h"
#include "base/sort.h"
#include "bridge/charconv.h"
#include "render/openness.h"
#include "surface/convexity.h"
#include "surface/edge_distance.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "map";

/* Cells beyond which doubles tell none apart. */
static const double FAR = 1e12;

/* ---- what an axis says --------------------------------------------------- */

static const char *const NAMES[OTX_AXIS_COUNT] = {
    "x",        "y",       "z",   "curvature", "ridges", "hollows", "occlusion",
    "boundary", "creases", "red", "green",     "blue",   "scatter",
};

static const char MAP[] = "map:";

static bool
takes_reach(otx_axis_kind kind)
{
    return kind == OTX_AXIS_BOUNDARY || kind == OTX_AXIS_CREASES ||
           kind == OTX_AXIS_SCATTER;
}

static bool
parse_reach(const char *text, double *out)
{
    const char *end = text + strlen(text), *rest;

    return otx_charconv_read_double(text, end, out, &rest) == OTX_CHARCONV_OK &&
           rest == end && *out > 0.0 && isfinite(*out);
}

otx_status
otx_axis_parse(otx_run *run, const char *text, otx_axis *out)
{
    const char *name = text ? text : "y";
    const char *colon;

    *out = (otx_axis){.is_reversed = *name == '-'};
    name += out->is_reversed;
    if (strncmp(name, MAP, strlen(MAP)) == 0 && name[strlen(MAP)])
    {
        out->kind = OTX_AXIS_MAP;
        out->path = name + strlen(MAP);
        return OSDTEX_OK;
    }
    colon = strchr(name, ':');
    for (int k = 0; k < OTX_AXIS_COUNT; ++k)
    {
        const size_t length = colon ? (size_t)(colon - name) : strlen(name);

        if (strlen(NAMES[k]) != length || memcmp(NAMES[k], name, length) != 0)
            continue;
        out->kind = (otx_axis_kind)k;
        if (colon &&
            !(takes_reach(out->kind) && parse_reach(colon + 1, &out->reach)))
            break;
        return OSDTEX_OK;
    }
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
        "{along} is x, y, z, curvature, ridges, hollows, occlusion, "
        "boundary[:LENGTH], creases[:LENGTH], red, green, blue, "
        "scatter[:LENGTH] or map:FILE, with a minus the other way round, not "
        "'%.40s'",
        text);
}

/* ---- values at vertices -------------------------------------------------- */

static void
climb(const otx_surface *surface, int coordinate, double *out)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    double low = (double)INFINITY, high = -(double)INFINITY;

    for (int32_t v = 0; v < count; ++v)
    {
        out[v] = (double)surface->points[3 * (size_t)v + (size_t)coordinate];
        low = fmin(low, out[v]);
        high = fmax(high, out[v]);
    }
    for (int32_t v = 0; v < count; ++v)
        out[v] = high > low ? (out[v] - low) / (high - low) : 0.0;
}

/* What all but a fiftieth of the values are below, above 0. */
static otx_status
usual_most(otx_run *run, const double *values, int32_t count, double *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    double *sorted = OTX_NEW(run->scratch, double, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < count; ++v)
        sorted[v] = fabs(values[v]);
    otx_sort_doubles(sorted, (size_t)count);
    *out = fmax(sorted[(int64_t)(count - 1) * 49 / 50], 1e-300);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* Over a fifth of the picture, so that single edges of the cage do not show. */
static otx_status
bend(
    otx_run *run, const otx_surface *surface, otx_axis_kind kind, double width,
    double *out)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    double most;

    OTX_TRY(otx_convexity(run, surface, 0.2 * width, out));
    OTX_TRY(usual_most(run, out, count, &most));
    for (int32_t v = 0; v < count; ++v)
    {
        const double bent = out[v] / most;

        out[v] = kind == OTX_AXIS_CURVATURE ? 0.5 + 0.5 * bent
                 : kind == OTX_AXIS_RIDGES  ? bent
                                            : -bent;
    }
    return OSDTEX_OK;
}

static otx_status
hide(otx_run *run, const otx_surface *surface, double *out)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    double most;

    OTX_TRY(otx_openness(run, surface, out));
    for (int32_t v = 0; v < count; ++v)
        out[v] = 1.0 - out[v];
    OTX_TRY(usual_most(run, out, count, &most));
    for (int32_t v = 0; v < count; ++v)
        out[v] /= most;
    return OSDTEX_OK;
}

/* What no way leads to is as far as can be. */
static otx_status
depart(otx_run *run, const otx_surface *surface, const otx_axis *a, double *out)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    const bool by_creases = a->kind == OTX_AXIS_CREASES;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    double most = a->reach;
    uint8_t *marked;
    int32_t found;

    OTX_TRY(otx_edge_mark(
        run, surface, by_creases ? OTX_EDGE_CREASE : OTX_EDGE_BOUNDARY, &marked,
        &found));
    if (found == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "{along} %s asks for what the cage has none of", NAMES[a->kind]);
    OTX_TRY(otx_edge_distance(run, surface, marked, out));
    for (int32_t v = 0; v < count && !(a->reach > 0.0); ++v)
        if (isfinite(out[v]))
            most = fmax(most, out[v]);
    for (int32_t v = 0; v < count; ++v)
        out[v] = most > 0.0 ? out[v] / most : 0.0;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* What is born of an edge or a face is the mean of its ends or corners. */
static void
descend(const otx_level *from, double *out)
{
    for (int32_t e = 0; e < from->edge_count; ++e)
    {
        const int32_t *ends = from->edge_verts + 2 * (size_t)e;

        out[from->edge_child_vert[e]] = 0.5 * (out[ends[0]] + out[ends[1]]);
    }
    for (int32_t f = 0; f < from->face_count; ++f)
    {
        const int32_t size = otx_level_face_size(from, f);
        double sum = 0.0;

        for (int32_t k = 0; k < size; ++k)
            sum += out[from->face_verts[from->face_first[f] + k]];
        if (from->face_child_vert[f] >= 0)
            out[from->face_child_vert[f]] = sum / size;
    }
}

static otx_status
take_colour(
    otx_run *run, const otx_surface *surface, otx_axis_kind kind, double *out)
{
    const otx_cage *cage = surface->cage;
    const otx_level *first = &surface->levels[0];
    const size_t channel = (size_t)(kind - OTX_AXIS_RED);

    if (!cage->colors)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "{along} %s asks for the colours of vertices, and the cage has "
            "none; they stand behind positions, as `v x y z r g b`",
            NAMES[kind]);
    /* Corners of the cage, since refinement may part a vertex. */
    for (int32_t c = 0; c < first->corner_count; ++c)
        out[first->face_verts[c]] =
            (double)cage->colors[3 * (size_t)cage->face_verts[c] + channel];
    for (int32_t k = 0; k + 1 < surface->level_count; ++k)
        descend(&surface->levels[k], out);
    return OSDTEX_OK;
}

/* The value of the nearest of points that lie one to a cell of space. */
static double
nearest_value(const double at[3], int32_t slices)
{
    double best = (double)INFINITY, value = 0.0;

    for (int k = 0; k < 27; ++k)
    {
        const int64_t cell[3] = {
            (int64_t)floor(at[0]) + k % 3 - 1,
            (int64_t)floor(at[1]) + k / 3 % 3 - 1,
            (int64_t)floor(at[2]) + k / 9 - 1};
        const uint64_t name = otx_random_bits(
            (uint64_t)cell[0], (uint32_t)cell[1], (uint64_t)cell[2]);
        double square = 0.0;

        for (uint32_t c = 0; c < 3; ++c)
        {
            const double d =
                (double)cell[c] + otx_random_unit(name, c, 0) - at[c];

            square += d * d;
        }
        if (square < best)
        {
            best = square;
            value = floor(otx_random_unit(name, 3, 0) * slices) / (slices - 1);
        }
    }
    return value;
}

/* Another of the slices every so far: whole ones, since a mixture of two that
 * differ in all but their features is flat. */
static otx_status
scatter(
    otx_run *run, const otx_surface *surface, const otx_axis *a, double width,
    double *out)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    const double cell = a->reach > 0.0 ? a->reach : 0.5 * width;
    const int32_t slices = a->slices > 1 ? a->slices : 2;

    for (int32_t v = 0; v < count; ++v)
    {
        double at[3];

        for (size_t c = 0; c < 3; ++c)
            at[c] = fmax(
                fmin((double)surface->points[3 * (size_t)v + c] / cell, FAR),
                -FAR);
        out[v] = nearest_value(at, slices);
        if (v % 1024 == 0)
            OTX_TRY(otx_pulse(run));
    }
    return OSDTEX_OK;
}

otx_status
otx_axis_values(
    otx_run *run, const otx_surface *surface, const otx_axis *a, double width,
    float *along)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    double *values = OTX_ZNEW(run->scratch, double, count);

    OTX_TRY(otx_run_ok(run));
    if (a->kind <= OTX_AXIS_Z)
        climb(surface, (int)a->kind, values);
    else if (a->kind <= OTX_AXIS_HOLLOWS)
        OTX_TRY(bend(run, surface, a->kind, width, values));
    else if (a->kind == OTX_AXIS_OCCLUSION)
        OTX_TRY(hide(run, surface, values));
    else if (a->kind == OTX_AXIS_MAP)
        OTX_TRY(otx_mask_pictures_values(run, surface, a->path, values));
    else if (a->kind == OTX_AXIS_SCATTER)
        OTX_TRY(scatter(run, surface, a, width, values));
    else if (a->kind >= OTX_AXIS_RED)
        OTX_TRY(take_colour(run, surface, a->kind, values));
    else
        OTX_TRY(depart(run, surface, a, values));
    for (int32_t v = 0; v < count; ++v)
    {
        const double value = fmin(fmax(values[v], 0.0), 1.0);

        along[v] = (float)(a->is_reversed ? 1.0 - value : value);
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}
