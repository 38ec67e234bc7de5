/* limit.c -- frames and measures of the leaf level on the limit surface. */
#include "surface/limit.h"

#include "math/vec.h"

#include <float.h>
#include <math.h>

#define STAGE "refine"

enum
{
    RANGE = 16384 /* elements of one task; fixed, since sums follow it */
};

/* Sine between the tangents below which they span no plane in float. */
static const double parallel_sine = 1e-5;

typedef struct frames
{
    const otx_level *leaf;
    const float *points;
    float *tangents;
    float *normals;
    int32_t *failed; /* [ranges], vertices without a plane */
} frames;

static int64_t
range_count(int32_t count)
{
    return ((int64_t)count + RANGE - 1) / RANGE;
}

static int32_t
range_end(int64_t index, int32_t count)
{
    const int64_t end = (index + 1) * RANGE;

    return end < count ? (int32_t)end : count;
}

static void
store(float *to, otx_vec3 v)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

/* A unit vector across unit `n`, from the axis that it is farthest from. */
static otx_vec3
any_across(otx_vec3 n)
{
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    const otx_vec3 axis = x <= y && x <= z ? (otx_vec3){1.0, 0.0, 0.0}
                          : y <= z         ? (otx_vec3){0.0, 1.0, 0.0}
                                           : (otx_vec3){0.0, 0.0, 1.0};

    return otx_vec3_unit(otx_vec3_cross(n, axis));
}

/* Stores the frame with unit normal `n` whose tan1 is as near as can be to
 * `direction`. */
static void
store_frame(const frames *f, int32_t vertex, otx_vec3 n, otx_vec3 direction)
{
    float *tangents = f->tangents + 6 * (size_t)vertex;
    const double length = otx_vec3_length(direction);
    const otx_vec3 flat =
        otx_vec3_sub(direction, otx_vec3_scale(otx_vec3_dot(direction, n), n));
    const otx_vec3 tan1 = otx_vec3_length(flat) > parallel_sine * length
                              ? otx_vec3_unit(flat)
                              : any_across(n);

    store(f->normals + 3 * (size_t)vertex, n);
    store(tangents, tan1);
    store(tangents + 3, otx_vec3_cross(n, tan1));
}

/* Whether OpenSubdiv's tangents span a plane; else the normal is left zero. */
static bool
frame_from_tangents(const frames *f, int32_t vertex)
{
    const otx_vec3 tan1 = otx_vec3_load(f->tangents, 2 * vertex);
    const otx_vec3 tan2 = otx_vec3_load(f->tangents, 2 * vertex + 1);
    const otx_vec3 cross = otx_vec3_cross(tan1, tan2);
    const double length = otx_vec3_length(cross);

    /* Written so that NaN lands here too. */
    if (!(length >
          parallel_sine * otx_vec3_length(tan1) * otx_vec3_length(tan2)))
    {
        store(f->normals + 3 * (size_t)vertex, (otx_vec3){0.0, 0.0, 0.0});
        return false;
    }
    store_frame(f, vertex, otx_vec3_scale(1.0 / length, cross), tan1);
    return true;
}

static otx_status
frame_range(void *context, int64_t index, otx_worker *worker)
{
    const frames *f = context;
    const int32_t end = range_end(index, f->leaf->vert_count);
    int32_t failed = 0;

    (void)worker;
    for (int32_t v = (int32_t)(index * RANGE); v < end; ++v)
        failed += !frame_from_tangents(f, v);
    f->failed[index] = failed;
    return OSDTEX_OK;
}

/* Twice the area vector of a polygon: Newell's sum about its first corner. */
static otx_vec3
area2_vector(const otx_level *level, const float *points, int32_t face)
{
    const int32_t *verts = level->face_verts + level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    const otx_vec3 origin = otx_vec3_load(points, verts[0]);
    otx_vec3 sum = {0.0, 0.0, 0.0};
    otx_vec3 p = otx_vec3_sub(otx_vec3_load(points, verts[1]), origin);

    for (int32_t k = 2; k < size; ++k)
    {
        const otx_vec3 q =
            otx_vec3_sub(otx_vec3_load(points, verts[k]), origin);

        sum = otx_vec3_add(sum, otx_vec3_cross(p, q));
        p = q;
    }
    return sum;
}

bool
otx_limit_face_is_flat(const otx_level *leaf, const float *points, int32_t face)
{
    const int32_t *verts = leaf->face_verts + leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    double reach = 0.0, round = 0.0;

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec3 p = otx_vec3_load(points, verts[k]);
        const otx_vec3 q = otx_vec3_load(points, verts[(k + 1) % size]);

        reach = fmax(reach, fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))));
        round += otx_vec3_length(otx_vec3_sub(q, p));
    }
    return !(
        otx_vec3_length(area2_vector(leaf, points, face)) >
        (double)FLT_EPSILON * reach * round);
}

static bool
has_normal(const frames *f, int32_t vertex)
{
    const float *n = f->normals + 3 * (size_t)vertex;

    return n[0] != 0.0f || n[1] != 0.0f || n[2] != 0.0f;
}

/* Gives the vertices without a plane the normal of the polygons around. */
static otx_status
frame_from_faces(otx_run *run, const frames *f, int32_t failed)
{
    const otx_level *leaf = f->leaf;
    int32_t *slots = OTX_NEW(run->scratch, int32_t, leaf->vert_count);
    otx_vec3 *sums = OTX_ZNEW(run->scratch, otx_vec3, failed);
    int32_t slot = 0;

    if (!slots || !sums)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        slots[v] = has_normal(f, v) ? -1 : slot++;
    for (int32_t face = 0; face < leaf->face_count; ++face)
    {
        const otx_vec3 area2 = area2_vector(leaf, f->points, face);

        for (int32_t i = leaf->face_first[face]; i < leaf->face_first[face + 1];
             ++i)
        {
            const int32_t s = slots[leaf->face_verts[i]];

            if (s >= 0)
                sums[s] = otx_vec3_add(sums[s], area2);
        }
    }
    for (int32_t v = 0; v < leaf->vert_count; ++v)
    {
        otx_vec3 n;

        if (slots[v] < 0)
            continue;
        n = otx_vec3_unit(sums[slots[v]]);
        if (!(otx_vec3_length(n) > 0.5))
            n = (otx_vec3){0.0, 0.0, 1.0};
        store_frame(f, v, n, otx_vec3_load(f->tangents, 2 * v));
    }
    return OSDTEX_OK;
}

otx_status
otx_limit_frames(
    otx_run *run, const otx_level *leaf, const float *points, float *tangents,
    float *normals)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int64_t ranges = range_count(leaf->vert_count);
    frames f = {
        leaf, points, tangents, normals,
        OTX_NEW(run->scratch, int32_t, ranges)};
    otx_status status = OSDTEX_ERROR_MEMORY;
    int32_t failed = 0;

    if (f.failed)
        status = otx_pool_for(run->pool, ranges, frame_range, &f);
    for (int64_t i = 0; status == OSDTEX_OK && i < ranges; ++i)
        failed += f.failed[i];
    if (status == OSDTEX_OK && failed > 0)
        status = frame_from_faces(run, &f, failed);
    otx_arena_release(run->scratch, mark);
    return status == OSDTEX_ERROR_MEMORY ? otx_fail_memory(run, STAGE) : status;
}

typedef struct measures
{
    const otx_level *leaf;
    const float *points;
    double *areas;   /* [face ranges] */
    double *lengths; /* [edge ranges] */
    int64_t face_ranges;
} measures;

static double
sum_areas(const measures *m, int64_t index)
{
    const int32_t end = range_end(index, m->leaf->face_count);
    double sum = 0.0;

    for (int32_t f = (int32_t)(index * RANGE); f < end; ++f)
    {
        if (!m->leaf->face_hole[f])
            sum += 0.5 * otx_vec3_length(area2_vector(m->leaf, m->points, f));
    }
    return sum;
}

static double
sum_lengths(const measures *m, int64_t index)
{
    const int32_t end = range_end(index, m->leaf->edge_count);
    double sum = 0.0;

    for (int32_t e = (int32_t)(index * RANGE); e < end; ++e)
    {
        const int32_t *verts = m->leaf->edge_verts + 2 * (size_t)e;

        sum += otx_vec3_length(otx_vec3_sub(
            otx_vec3_load(m->points, verts[0]),
            otx_vec3_load(m->points, verts[1])));
    }
    return sum;
}

static otx_status
measure_range(void *context, int64_t index, otx_worker *worker)
{
    const measures *m = context;

    (void)worker;
    if (index < m->face_ranges)
        m->areas[index] = sum_areas(m, index);
    else
        m->lengths[index - m->face_ranges] =
            sum_lengths(m, index - m->face_ranges);
    return OSDTEX_OK;
}

otx_status
otx_limit_measure(
    otx_run *run, const otx_level *leaf, const float *points, double *area,
    double *mean_edge_length)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int64_t face_ranges = range_count(leaf->face_count);
    const int64_t edge_ranges = range_count(leaf->edge_count);
    measures m = {
        leaf, points, OTX_NEW(run->scratch, double, face_ranges),
        OTX_NEW(run->scratch, double, edge_ranges), face_ranges};
    otx_status status = OSDTEX_ERROR_MEMORY;
    double length = 0.0;

    *area = 0.0;
    if (m.areas && m.lengths)
        status = otx_pool_for(
            run->pool, face_ranges + edge_ranges, measure_range, &m);
    for (int64_t i = 0; status == OSDTEX_OK && i < face_ranges; ++i)
        *area += m.areas[i];
    for (int64_t i = 0; status == OSDTEX_OK && i < edge_ranges; ++i)
        length += m.lengths[i];
    *mean_edge_length = length / leaf->edge_count;
    otx_arena_release(run->scratch, mark);
    return status == OSDTEX_ERROR_MEMORY ? otx_fail_memory(run, STAGE) : status;
}
