/* convexity.c -- curvature by edges, spread by averages. */
#include "surface/convexity.h"

#include "math/vec.h"

#include <math.h>
#include <string.h>

enum
{
    ROUNDS_MOST = 400
};

/* Adds at both ends of every edge what `value` says, and divides. */
static void
by_edges(
    const otx_surface *surface, int32_t *counts, double *sums,
    double (*value)(const otx_surface *, int32_t, int32_t, const double *),
    const double *before)
{
    const otx_level *level = otx_surface_leaf(surface);
    const size_t count = (size_t)level->vert_count;

    memset(counts, 0, sizeof *counts * count);
    memset(sums, 0, sizeof *sums * count);
    for (int32_t e = 0; e < level->edge_count; ++e)
        for (int32_t k = 0; k < 2; ++k)
        {
            const int32_t *ends = level->edge_verts + 2 * (size_t)e;

            sums[ends[k]] += value(surface, ends[k], ends[1 - k], before);
            ++counts[ends[k]];
        }
    for (size_t v = 0; v < count; ++v)
        if (counts[v] > 0)
            sums[v] /= counts[v];
}

/* Of the circle through both ends that is tangent to the surface in the first:
 * the normal curvature that way [Taubin95, eq. 1]. */
static double
edge_curvature(
    const otx_surface *surface, int32_t from, int32_t to, const double *before)
{
    const otx_vec3 e = otx_vec3_sub(
        otx_vec3_load(surface->points, from),
        otx_vec3_load(surface->points, to));
    const otx_vec3 n = otx_vec3_load(surface->normals, from);
    const double squared = otx_vec3_dot(e, e);

    (void)before;
    return squared > 0.0 ? 2.0 * otx_vec3_dot(n, e) / squared : 0.0;
}

static double
of_neighbour(
    const otx_surface *surface, int32_t from, int32_t to, const double *before)
{
    (void)surface;
    return 0.5 * (before[from] + before[to]);
}

/* A round spreads by about .7 of an edge, rounds by the root of their number.*/
static int32_t
rounds_for(const otx_surface *surface, double radius)
{
    const double edges = radius / fmax(surface->mean_edge_length, 1e-300);

    return (int32_t)fmin(ceil(2.0 * edges * edges), ROUNDS_MOST);
}

otx_status
otx_convexity(
    otx_run *run, const otx_surface *surface, double radius, double *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    const int32_t rounds = rounds_for(surface, radius);
    int32_t *counts = OTX_NEW(run->scratch, int32_t, count);
    double *next = OTX_NEW(run->scratch, double, count);

    OTX_TRY(otx_run_ok(run));
    by_edges(surface, counts, out, edge_curvature, NULL);
    for (int32_t i = 0; i < rounds; ++i)
    {
        OTX_TRY(otx_pulse(run));
        by_edges(surface, counts, next, of_neighbour, out);
        memcpy(out, next, sizeof *out * (size_t)count);
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}
