/* chart_cut.c -- grow, flatten, judge, part what fails, again. */
#include "bake/chart_cut.h"

#include "bake/extent.h"
#include "bake/fvar_linear.h"
#include "flatten/chart.h"

#include <string.h>

static const char STAGE[] = "bake";

enum
{
    FIRST_CHARTS = 1, /* of all the surface, about */
    ROUNDS = 24,      /* of the flattening */
    RIM_TEST = 4000   /* edges of a rim that are held against each other */
};

/* RMS over a chart of the larger of stretch and its inverse, from which it is
 * parted. Of its leaves as they were flattened: how far "linear all" departs
 * from that within coarse faces of the cage no cut could mend. */
static const double STRETCH = 1.07;
/* How much borders prefer bends. */
static const double BEND = 2.0;

/* What the cutting works with. */
typedef struct cutter
{
    otx_run *run;
    const otx_surface *surface;
    const otx_level *cage;
    double most;
    otx_dual dual, leaves; /* of the cage, of the leaves */
    otx_cluster_space clusters;
    otx_chart_space charts;
    int32_t *slot; /* [cage vert_count] local vertex of the chart in work */
    otx_vec2 *flat;
    float *cage_uvs, *leaf_uvs;
    /* Results, and what is still to be flattened. */
    otx_cluster *done;
    int32_t done_count;
    double sum, area; /* of squared stretch */
} cutter;

/* ---- one chart ----------------------------------------------------------- */

/* The shape that an atlas gives a face. */
static void
take_block(cutter *c, int32_t face, const double *extents)
{
    const int32_t first = c->cage->face_first[face];
    const int32_t n = otx_level_face_size(c->cage, face);

    for (int32_t k = 0; k < n; ++k)
    {
        const otx_vec2 corner = otx_extent_corner(n, k);

        c->flat[first + k] = (otx_vec2){
            corner.x * extents[2 * (size_t)face],
            corner.y * extents[2 * (size_t)face + 1]};
    }
}

/*   distortion  of the leaves; INFINITY where one is flipped */
static otx_status
flatten(cutter *c, const otx_cluster *cluster, double *distortion)
{
    const otx_arena_mark mark = otx_arena_here(c->run->scratch);
    const double size = c->surface->mean_edge_length;
    const otx_chart_request request = {
        .surface = c->surface,
        .leaves = &c->leaves,
        .texels = size > 0.0 ? 1.0 / size : 1.0,
        .rounds = ROUNDS};
    otx_chart chart;
    int32_t count;
    const int32_t *leaves =
        otx_cluster_leaves(c->run->scratch, c->surface, cluster, &count);
    otx_status status = leaves ? otx_chart_build(
                                     &request, leaves, count, &c->charts,
                                     c->run->scratch, c->run->scratch, &chart)
                               : OSDTEX_ERROR_MEMORY;

    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(c->run, STAGE);
    OTX_TRY(status);
    *distortion = chart.distortion;
    for (int32_t v = 0; v < chart.vert_count; ++v)
        if (chart.verts[v] < c->cage->vert_count)
            c->slot[chart.verts[v]] = v;
    for (int32_t i = 0; i < cluster->face_count; ++i)
        for (int32_t k = c->cage->face_first[cluster->faces[i]];
             k < c->cage->face_first[cluster->faces[i] + 1]; ++k)
            c->flat[k] = otx_vec2_scale(
                1.0 / request.texels,
                chart.flat[c->slot[c->cage->face_verts[k]]]);
    otx_arena_release(c->run->scratch, mark);
    return OSDTEX_OK;
}

/* ---- judgement ------------------------------------------------------------
 */

/* Singular values of the map from a triangle of the surface to the plane;
 * false where it is flipped. */
static bool
singular(const otx_vec3 p[3], const otx_vec2 q[3], double s[2])
{
    const otx_vec3 a = otx_vec3_sub(p[1], p[0]), b = otx_vec3_sub(p[2], p[0]);
    const otx_vec2 u = otx_vec2_sub(q[1], q[0]), v = otx_vec2_sub(q[2], q[0]);
    const double length = otx_vec3_length(a);
    const double along = length > 0.0 ? otx_vec3_dot(a, b) / length : 0.0;
    const double across =
        otx_vec3_length(otx_vec3_cross(a, b)) / (length > 0.0 ? length : 1.0);
    const otx_vec2 x = otx_vec2_scale(1.0 / length, u);
    const otx_vec2 y =
        otx_vec2_scale(1.0 / across, otx_vec2_sub(v, otx_vec2_scale(along, x)));
    const double trace = otx_vec2_dot(x, x) + otx_vec2_dot(y, y);
    const double det = otx_vec2_cross(x, y);
    const double root = sqrt(fmax(trace * trace / 4.0 - det * det, 0.0));

    s[0] = sqrt(trace / 2.0 + root);
    s[1] = det / s[0];
    return det > 0.0 && isfinite(s[0]);
}

/* Adds area and badness of a leaf face, triangle by triangle. Where the surface
 * has no area there is nothing to stretch. False: flipped. */
static bool
judge_leaf(const cutter *c, int32_t leaf, double *sum, double *area)
{
    const otx_level *level = otx_surface_leaf(c->surface);
    const int32_t first = level->face_first[leaf];
    const int32_t n = otx_level_face_size(level, leaf);

    for (int32_t k = 1; k + 1 < n; ++k)
    {
        const int32_t corners[3] = {first, first + k, first + k + 1};
        otx_vec3 p[3];
        otx_vec2 q[3];
        double s[2], own;

        for (int i = 0; i < 3; ++i)
        {
            const float *uv = c->leaf_uvs + 2 * (size_t)corners[i];

            p[i] = otx_vec3_load(
                c->surface->points, level->face_verts[corners[i]]);
            q[i] = (otx_vec2){uv[0], uv[1]};
        }
        own = 0.5 * otx_vec3_length(otx_vec3_cross(
                        otx_vec3_sub(p[1], p[0]), otx_vec3_sub(p[2], p[0])));
        if (!(own > 1e-6 * c->leaves.areas[leaf]))
            continue;
        if (!singular(p, q, s))
            return false;
        *sum += own * pow(fmax(s[0], 1.0 / s[1]), 2.0);
        *area += own;
    }
    return true;
}

static bool
is_flat(const cutter *c, const otx_cluster *cluster, double *sum, double *area)
{
    const otx_arena_mark mark = otx_arena_here(c->run->scratch);
    int32_t count;
    const int32_t *leaves =
        otx_cluster_leaves(c->run->scratch, c->surface, cluster, &count);
    bool flat = leaves != NULL;

    *sum = *area = 0.0;
    for (int32_t i = 0; flat && i < count; ++i)
        flat = judge_leaf(c, leaves[i], sum, area);
    otx_arena_release(c->run->scratch, mark);
    if (!flat)
        *sum = INFINITY;
    return flat;
}

static bool
cross(otx_vec2 a, otx_vec2 b, otx_vec2 c, otx_vec2 d)
{
    const otx_vec2 ab = otx_vec2_sub(b, a), cd = otx_vec2_sub(d, c);
    const double c1 = otx_vec2_cross(ab, otx_vec2_sub(c, a));
    const double d1 = otx_vec2_cross(ab, otx_vec2_sub(d, a));
    const double a1 = otx_vec2_cross(cd, otx_vec2_sub(a, c));
    const double b1 = otx_vec2_cross(cd, otx_vec2_sub(b, c));

    return c1 * d1 < 0.0 && a1 * b1 < 0.0;
}

/* Rim edges of a chart as pairs of points, in `scratch`; -1 without memory. */
static int32_t
list_rim(
    const cutter *c, const otx_cluster *cluster, const int32_t *owner,
    otx_vec2 **out)
{
    int32_t most = 0, count = 0;

    for (int32_t i = 0; i < cluster->face_count; ++i)
        most += otx_level_face_size(c->cage, cluster->faces[i]);
    *out = OTX_NEW(c->run->scratch, otx_vec2, 2 * (size_t)most);
    for (int32_t i = 0; *out && i < cluster->face_count; ++i)
    {
        const int32_t f = cluster->faces[i];
        const int32_t n = otx_level_face_size(c->cage, f);

        for (int32_t k = 0; k < n; ++k)
        {
            const int32_t g = otx_level_neighbour(c->cage, f, k);
            const int32_t first = c->cage->face_first[f];

            if (g >= 0 && owner[g] == owner[f])
                continue;
            (*out)[2 * count] = c->flat[first + k];
            (*out)[2 * count + 1] = c->flat[first + (k + 1) % n];
            ++count;
        }
    }
    return *out ? count : -1;
}

/* Whether the rim crosses itself, or the chart is larger than allowed. */
static bool
is_clear(const cutter *c, const otx_cluster *cluster, const int32_t *owner)
{
    const otx_arena_mark mark = otx_arena_here(c->run->scratch);
    otx_vec2 *rim, low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    const int32_t count = list_rim(c, cluster, owner, &rim);
    bool clear = count >= 0 && count <= RIM_TEST;

    for (int32_t i = 0; clear && i < count; ++i)
    {
        low = (otx_vec2){fmin(low.x, rim[2 * i].x), fmin(low.y, rim[2 * i].y)};
        high =
            (otx_vec2){fmax(high.x, rim[2 * i].x), fmax(high.y, rim[2 * i].y)};
        for (int32_t k = 0; clear && k < i; ++k)
            clear =
                !cross(rim[2 * i], rim[2 * i + 1], rim[2 * k], rim[2 * k + 1]);
    }
    otx_arena_release(c->run->scratch, mark);
    return clear && otx_vec2_length(otx_vec2_sub(high, low)) <= c->most;
}

/* ---- rounds ---------------------------------------------------------------
 */

static otx_status
flatten_all(
    cutter *c, const otx_cluster_list *work, int32_t *owner,
    double *distortions)
{
    for (int32_t i = 0; i < work->count; ++i)
    {
        const otx_cluster *cluster = &work->clusters[i];

        OTX_TRY(otx_progress(c->run, STAGE, 0.0));
        for (int32_t k = 0; k < cluster->face_count; ++k)
            owner[cluster->faces[k]] = i;
        OTX_TRY(flatten(c, cluster, &distortions[i]));
    }
    for (int32_t k = 0; k < c->cage->corner_count; ++k)
    {
        c->cage_uvs[2 * (size_t)k] = (float)c->flat[k].x;
        c->cage_uvs[2 * (size_t)k + 1] = (float)c->flat[k].y;
    }
    return otx_fvar_linear(c->run, c->surface, c->cage_uvs, c->leaf_uvs);
}

/* A single face that folds takes its block. */
static void
keep(
    cutter *c, const otx_cluster *cluster, double sum, double area,
    const double *extents)
{
    c->done[c->done_count++] = *cluster;
    if (!isfinite(sum))
    {
        take_block(c, cluster->faces[0], extents);
        return;
    }
    c->sum += sum;
    c->area += area;
}

/* Keeps what is flat, and parts the rest into `next`. What is kept has no owner
 * any more: numbers of later rounds begin anew. */
static otx_status
sift(
    cutter *c, const otx_cluster_list *work, int32_t *owner,
    const double *distortions, const double *extents, otx_cluster_list *next)
{
    const otx_growing growing = {&c->dual, BEND, &c->clusters};

    next->count = 0;
    for (int32_t i = 0; i < work->count; ++i)
    {
        const otx_cluster *cluster = &work->clusters[i];
        otx_cluster_list parts;
        double sum, area;

        const bool flat = is_flat(c, cluster, &sum, &area);

        if ((flat && distortions[i] <= STRETCH &&
             is_clear(c, cluster, owner)) ||
            cluster->face_count == 1)
        {
            keep(c, cluster, sum, area, extents);
            for (int32_t k = 0; k < cluster->face_count; ++k)
                owner[cluster->faces[k]] = -1;
            continue;
        }
        OTX_TRY(otx_cluster_grow(
            c->run, &growing, cluster, 0.5 * cluster->area, 2, &parts));
        memcpy(
            next->clusters + next->count, parts.clusters,
            (size_t)parts.count * sizeof *parts.clusters);
        next->count += parts.count;
    }
    return OSDTEX_OK;
}

static otx_status
begin(cutter *c, otx_cluster_list *work)
{
    const otx_growing growing = {&c->dual, BEND, &c->clusters};
    int32_t *all = OTX_NEW(c->run->arena, int32_t, c->cage->face_count);
    otx_cluster region = {.faces = all, .node = -1};
    otx_cluster_list grown;

    OTX_TRY(otx_run_ok(c->run));
    for (int32_t f = 0; f < c->cage->face_count; ++f)
        if (!(c->cage->face_hole && c->cage->face_hole[f]))
        {
            all[region.face_count++] = f;
            region.area += c->dual.areas[f];
        }
    work->count = 0;
    if (region.face_count == 0)
        return OSDTEX_OK;
    OTX_TRY(otx_cluster_grow(
        c->run, &growing, &region, region.area / FIRST_CHARTS, 1, &grown));
    memcpy(
        work->clusters, grown.clusters,
        (size_t)grown.count * sizeof *grown.clusters);
    work->count = grown.count;
    return OSDTEX_OK;
}

static otx_status
prepare(cutter *c)
{
    otx_run *run = c->run;
    const otx_level *leaf = otx_surface_leaf(c->surface);

    OTX_TRY(otx_dual_build(run, c->surface, 0, &c->dual));
    OTX_TRY(otx_dual_build(
        run, c->surface, c->surface->level_count - 1, &c->leaves));
    OTX_TRY(otx_cluster_space_create(run, c->cage, &c->clusters));
    OTX_TRY(otx_chart_space_create(run, run->arena, c->surface, &c->charts));
    c->slot = OTX_NEW(run->arena, int32_t, c->cage->vert_count);
    c->flat = OTX_ZNEW(run->arena, otx_vec2, c->cage->corner_count);
    c->cage_uvs =
        OTX_ZNEW(run->arena, float, 2 * (size_t)c->cage->corner_count);
    c->leaf_uvs = OTX_NEW(run->arena, float, 2 * (size_t)leaf->corner_count);
    c->done = OTX_NEW(run->arena, otx_cluster, c->cage->face_count);
    return otx_run_ok(run);
}

static otx_status
list(cutter *c, otx_arena *arena, otx_chart_cut *out)
{
    int32_t *first = OTX_NEW(arena, int32_t, c->done_count + 1);
    int32_t *faces = OTX_NEW(arena, int32_t, c->cage->face_count);
    otx_vec2 *flat = OTX_NEW(arena, otx_vec2, c->cage->corner_count);
    int32_t count = 0;

    if (!first || !faces || !flat)
        return otx_fail_memory(c->run, STAGE);
    for (int32_t i = 0; i < c->done_count; ++i)
    {
        first[i] = count;
        memcpy(
            faces + count, c->done[i].faces,
            (size_t)c->done[i].face_count * sizeof *faces);
        count += c->done[i].face_count;
    }
    first[c->done_count] = count;
    memcpy(flat, c->flat, (size_t)c->cage->corner_count * sizeof *flat);
    *out = (otx_chart_cut){
        c->done_count, first, faces, flat,
        c->area > 0.0 ? sqrt(c->sum / c->area) : 1.0};
    return OSDTEX_OK;
}

static otx_status
cut(cutter *c, otx_arena *arena, otx_chart_cut *out)
{
    const size_t faces = (size_t)c->surface->cage->face_count;
    double *extents = OTX_NEW(c->run->arena, double, 2 * faces);
    double *distortions = OTX_NEW(c->run->arena, double, faces);
    int32_t *owner = OTX_NEW(c->run->arena, int32_t, faces);
    otx_cluster_list work = {0, OTX_NEW(c->run->arena, otx_cluster, faces)};
    otx_cluster_list next = {0, OTX_NEW(c->run->arena, otx_cluster, faces)};

    OTX_TRY(otx_run_ok(c->run));
    OTX_TRY(prepare(c));
    OTX_TRY(otx_extent_measure(c->run, c->surface, extents));
    OTX_TRY(begin(c, &work));
    for (size_t f = 0; f < faces; ++f)
        owner[f] = -1; /* and holes keep that */
    while (work.count > 0)
    {
        const otx_cluster_list swap = work;

        OTX_TRY(flatten_all(c, &work, owner, distortions));
        OTX_TRY(sift(c, &work, owner, distortions, extents, &next));
        work = next;
        next = swap;
    }
    return list(c, arena, out);
}

otx_status
otx_chart_cut_make(
    otx_run *run, const otx_surface *surface, double most, otx_chart_cut *out)
{
    otx_run aside = *run;
    cutter c = {
        .run = &aside,
        .surface = surface,
        .cage = &surface->levels[0],
        .most = most};
    otx_status status;

    *out = (otx_chart_cut){0};
    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, STAGE);
    status = cut(&c, run->arena, out);
    otx_arena_destroy(aside.arena);
    return status;
}
