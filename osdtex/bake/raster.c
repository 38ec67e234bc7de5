/* raster.c -- triangles row by row, rims by the distance to them. */
#include "bake/raster.h"

#include <string.h>

/* In barycentric coordinates: what is on an edge belongs to both faces, so
 * that rounding leaves no hole between them. */
static const double ON_EDGE = 1e-7;

bool
otx_raster_begin(otx_arena *arena, otx_raster *raster)
{
    const size_t texels = (size_t)raster->width * (size_t)raster->height;
    const size_t samples = texels * (size_t)raster->n * (size_t)raster->n;

    raster->facets = OTX_NEW(arena, int64_t, samples);
    if (raster->facets)
        memset(raster->facets, -1, samples * sizeof *raster->facets);
    return raster->facets;
}

bool
otx_raster_near_begin(
    otx_arena *arena, const otx_raster *raster, otx_raster_near *near)
{
    const size_t texels = (size_t)raster->width * (size_t)raster->height;

    near->edges = OTX_NEW(arena, int32_t, texels);
    near->distance = OTX_NEW(arena, float, texels);
    if (near->edges)
        memset(near->edges, -1, texels * sizeof *near->edges);
    return near->edges && near->distance;
}

/* One barycentric coordinate over the samples: c + x i + y j. */
typedef struct plane
{
    double c, x, y;
} plane;

/* Integers in [low, high], which may be far outside, cut to [0, count). */
static void
cut(double low, double high, int32_t count, int32_t *first, int32_t *end)
{
    *first = low > 0.0 ? low < count ? (int32_t)ceil(low) : count : 0;
    *end = high >= 0.0 ? high < count ? (int32_t)floor(high) + 1 : count : 0;
}

/* The planes of a triangle given in samples; false without area. */
static bool
set_planes(const otx_vec2 q[3], plane planes[3])
{
    const double area2 =
        otx_vec2_cross(otx_vec2_sub(q[1], q[0]), otx_vec2_sub(q[2], q[0]));

    if (!(fabs(area2) > 0.0) || !isfinite(1.0 / area2))
        return false;
    for (int k = 0; k < 3; ++k)
    {
        const otx_vec2 a = q[(k + 1) % 3], b = q[(k + 2) % 3];

        planes[k] = (plane){
            otx_vec2_cross(a, b) / area2, (a.y - b.y) / area2,
            (b.x - a.x) / area2};
    }
    return true;
}

/* Samples of row j inside all planes. */
static void
cut_row(
    const plane planes[3], int32_t j, int32_t count, int32_t *first,
    int32_t *end)
{
    double low = -1.0, high = count;

    for (int k = 0; k < 3; ++k)
    {
        const double at_zero = planes[k].c + planes[k].y * j + ON_EDGE;

        if (planes[k].x > 0.0)
            low = fmax(low, -at_zero / planes[k].x);
        else if (planes[k].x < 0.0)
            high = fmin(high, -at_zero / planes[k].x);
        else if (at_zero < 0.0)
            high = -1.0;
    }
    cut(low, high, count, first, end);
}

void
otx_raster_triangle(otx_raster *raster, const otx_vec2 p[3], int64_t id)
{
    const int32_t across = raster->width * raster->n;
    double low = INFINITY, high = -INFINITY;
    int32_t j, j_end;
    plane planes[3];
    otx_vec2 q[3];

    for (int k = 0; k < 3; ++k)
    {
        q[k] = (otx_vec2){
            (p[k].x - raster->origin.x) * raster->n - 0.5,
            (p[k].y - raster->origin.y) * raster->n - 0.5};
        low = fmin(low, q[k].y);
        high = fmax(high, q[k].y);
    }
    if (!set_planes(q, planes))
        return;
    cut(low - ON_EDGE, high + ON_EDGE, raster->height * raster->n, &j, &j_end);
    for (; j < j_end; ++j)
    {
        int64_t *row = raster->facets + (size_t)j * (size_t)across;
        int32_t i, i_end;

        cut_row(planes, j, across, &i, &i_end);
        for (; i < i_end; ++i)
            if (row[i] < 0)
                row[i] = id;
    }
}

double
otx_raster_nearest(otx_vec2 a, otx_vec2 b, otx_vec2 p)
{
    const otx_vec2 along = otx_vec2_sub(b, a);
    const double sq = otx_vec2_dot(along, along);
    const double t = otx_vec2_dot(otx_vec2_sub(p, a), along);

    return t > 0.0 ? t < sq ? t / sq : 1.0 : 0.0;
}

void
otx_raster_edge(
    const otx_raster *raster, const otx_vec2 p[2], double radius, int32_t edge,
    otx_raster_near *near)
{
    const double dx = raster->origin.x + 0.5, dy = raster->origin.y + 0.5;
    const otx_vec2 a = p[0], b = p[1];
    int32_t x_first, x_end, y, y_end;

    cut(fmin(a.x, b.x) - radius - dx, fmax(a.x, b.x) + radius - dx,
        raster->width, &x_first, &x_end);
    cut(fmin(a.y, b.y) - radius - dy, fmax(a.y, b.y) + radius - dy,
        raster->height, &y, &y_end);
    for (; y < y_end; ++y)
        for (int32_t x = x_first; x < x_end; ++x)
        {
            const size_t i = (size_t)y * (size_t)raster->width + (size_t)x;
            const otx_vec2 at = otx_raster_texel(raster, x, y);
            const otx_vec2 d = otx_vec2_sub(
                at, otx_vec2_lerp(a, b, otx_raster_nearest(a, b, at)));
            const float sq = (float)otx_vec2_dot(d, d);

            if (sq > radius * radius ||
                (near->edges[i] >= 0 && near->distance[i] <= sq))
                continue;
            near->edges[i] = edge;
            near->distance[i] = sq;
        }
}
