/* obj_origin.c -- where the points of an OBJ are counted from. */
#include "file/obj_origin.h"

#include <inttypes.h>
#include <math.h>

#define STAGE "obj"

/* A thing whose distance from the origin is below this many times its size
 * keeps the scene's origin: it loses four of a float's 24 bits at most. */
static const double NEAR = 16.0;

/* From here on programs that hold positions as floats show steps: ten bits are
 * left for the thing. */
static const double FAR = 16384.0;

/* An edge whose length a float changes by more than this share is one that it
 * does not hold. */
static const double EDGE_CHANGE = 1.0 / 32.0;

typedef struct box
{
    double low[3], high[3];
} box;

/* Around the points that faces use. */
static box
box_of(const otx_obj_places *p)
{
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    const int32_t corners =
        p->face_count > 0 ? p->face_first[p->face_count] : 0;

    for (int32_t c = 0; c < corners; ++c)
        for (int k = 0; k < 3; ++k)
        {
            const double x = p->places[3 * (size_t)p->face_verts[c] + k];

            b.low[k] = fmin(b.low[k], x);
            b.high[k] = fmax(b.high[k], x);
        }
    return b;
}

static double
extent_of(const box *b)
{
    double extent = 0.0;

    for (int k = 0; k < 3; ++k)
        extent = fmax(extent, b->high[k] - b->low[k]);
    return extent;
}

static double
distance_of(const box *b)
{
    double distance = 0.0;

    for (int k = 0; k < 3; ++k)
        distance = fmax(distance, fmax(fabs(b->low[k]), fabs(b->high[k])));
    return distance;
}

/* In steps of a power of two of the box's size, so that few bits are used. */
static void
choose(const box *b, double extent, double origin[3])
{
    const double step = exp2(floor(log2(extent)));

    for (int k = 0; k < 3; ++k)
        if (fmax(fabs(b->low[k]), fabs(b->high[k])) > NEAR * extent)
            origin[k] = step * nearbyint((b->low[k] + b->high[k]) / 2 / step);
}

static double
edge_length(const double *a, const double *b)
{
    return sqrt(
        (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
        (a[2] - b[2]) * (a[2] - b[2]));
}

/* Whether the edge has another length between the points. */
static bool
is_changed(const otx_obj_places *p, const float *points, int32_t v, int32_t w)
{
    const float *a = points + 3 * (size_t)v, *b = points + 3 * (size_t)w;
    const double length =
        edge_length(p->places + 3 * (size_t)v, p->places + 3 * (size_t)w);
    const double now = edge_length(
        (const double[3]){(double)a[0], (double)a[1], (double)a[2]},
        (const double[3]){(double)b[0], (double)b[1], (double)b[2]});

    return fabs(now - length) > EDGE_CHANGE * length;
}

/* Faces with an edge that float does not hold.
 *
 *   first  the first of them */
static int64_t
count_changed(const otx_obj_places *p, const float *points, int32_t *first)
{
    int64_t count = 0;

    for (int32_t f = 0; f < p->face_count; ++f)
    {
        const int32_t begin = p->face_first[f], end = p->face_first[f + 1];
        bool changed = false;

        for (int32_t c = begin; c < end; ++c)
            changed |= is_changed(
                p, points, p->face_verts[c],
                p->face_verts[c + 1 < end ? c + 1 : begin]);
        if (changed && count++ == 0)
            *first = f;
    }
    return count;
}

void
otx_obj_origin_take(
    otx_run *run, const otx_obj_places *p, float *points, double origin[3])
{
    const box b = box_of(p);
    const double extent = extent_of(&b);
    const bool has_size = extent > 0.0 && isfinite(extent);
    otx_where where = OTX_NOWHERE;
    int64_t changed;

    where.file = p->path;
    origin[0] = origin[1] = origin[2] = 0.0;
    if (has_size && distance_of(&b) > NEAR * extent)
        choose(&b, extent, origin);
    for (int64_t i = 0; i < 3 * (int64_t)p->vert_count; ++i)
        points[i] = (float)(p->places[i] - origin[i % 3]);
    if (!has_size)
        return;
    changed = count_changed(p, points, &where.face);
    if (changed > 0)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "%" PRId64 " faces (first is face %d) are too small, beside all "
            "that is in the file, for the 24 bits that positions are held "
            "with; export distant parts as files of their own",
            changed, where.face);
    else if (distance_of(&b) > FAR * extent)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "the mesh lies %.3g times its size away from the origin; it is "
            "worked on relative to (%.15g, %.15g, %.15g) and written back in "
            "place, but programs that hold positions in 32 bits show it in "
            "steps there",
            distance_of(&b) / extent, origin[0], origin[1], origin[2]);
}
