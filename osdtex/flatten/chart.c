/* chart.c -- collects core and collar, numbers their vertices, flattens. */
#include "flatten/chart.h"

#include "base/pqueue.h"
#include "flatten/arap.h"
#include "flatten/chart_check.h"
#include "flatten/stretch.h"

#include <assert.h>

otx_status
otx_chart_space_create(
    otx_run *run, otx_arena *arena, const otx_surface *surface,
    otx_chart_space *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    out->face_slot = OTX_NEW(arena, int32_t, leaf->face_count);
    out->vert_slot = OTX_NEW(arena, int32_t, leaf->vert_count);
    if (!out->face_slot || !out->vert_slot)
        return otx_fail_memory(run, "flatten");
    for (int32_t f = 0; f < leaf->face_count; ++f)
        out->face_slot[f] = -1;
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        out->vert_slot[v] = -1;
    return OSDTEX_OK;
}

/* The set of faces while it grows. */
typedef struct gathering
{
    const otx_chart_request *request;
    otx_chart_space *space;
    otx_chart *chart;
    otx_arena *arena;
    int32_t face_capacity;
    int32_t vert_capacity;
} gathering;

static bool
grow_faces(gathering *g)
{
    const int32_t capacity = g->face_capacity ? 2 * g->face_capacity : 256;
    int32_t *faces = OTX_NEW(g->arena, int32_t, capacity);
    float *reach = OTX_NEW(g->arena, float, capacity);

    if (!faces || !reach)
        return false;
    for (int32_t i = 0; i < g->chart->face_count; ++i)
    {
        faces[i] = g->chart->faces[i];
        reach[i] = g->chart->reach[i];
    }
    g->chart->faces = faces;
    g->chart->reach = reach;
    g->face_capacity = capacity;
    return true;
}

static bool
grow_verts(gathering *g)
{
    const int32_t capacity = g->vert_capacity ? 2 * g->vert_capacity : 256;
    int32_t *verts = OTX_NEW(g->arena, int32_t, capacity);

    if (!verts)
        return false;
    for (int32_t i = 0; i < g->chart->vert_count; ++i)
        verts[i] = g->chart->verts[i];
    g->chart->verts = verts;
    g->vert_capacity = capacity;
    return true;
}

static bool
add_face(gathering *g, int32_t face, double reach)
{
    const otx_level *leaf = g->request->leaves->level;
    otx_chart *chart = g->chart;
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);

    if (chart->face_count == g->face_capacity && !grow_faces(g))
        return false;
    g->space->face_slot[face] = chart->face_count;
    chart->reach[chart->face_count] = (float)reach;
    chart->faces[chart->face_count++] = face;
    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t v = leaf->face_verts[first + k];

        if (g->space->vert_slot[v] >= 0)
            continue;
        if (chart->vert_count == g->vert_capacity && !grow_verts(g))
            return false;
        g->space->vert_slot[v] = chart->vert_count;
        chart->verts[chart->vert_count++] = v;
    }
    return true;
}

/* Whether a disc stays a disc when `face` joins it: what the face shares with
 * it must be one run of edges, and not the whole outline of the face. Going
 * round the face, corners and edges alternate; a run shows as exactly two
 * changes between "in the set" and "not in the set". */
static bool
keeps_disc(const gathering *g, int32_t face)
{
    const otx_level *leaf = g->request->leaves->level;
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    int32_t changes = 0;
    bool any_edge = false;
    bool before = false;

    for (int32_t k = 0; k <= size; ++k)
    {
        const int32_t corner = k % size;
        const int32_t v = leaf->face_verts[first + corner];
        const int32_t other = otx_level_neighbour(leaf, face, corner);
        const bool vert_in = g->space->vert_slot[v] >= 0;
        const bool edge_in = other >= 0 && g->space->face_slot[other] >= 0;

        if (k > 0)
            changes += vert_in != before;
        if (k == size)
            break;
        changes += edge_in != vert_in;
        any_edge = any_edge || edge_in;
        before = edge_in;
    }
    return any_edge && changes == 2;
}

/* Offers the neighbours of a chart face to the queue. */
static void
push_neighbours(gathering *g, otx_pqueue *queue, int32_t face, double reach)
{
    const otx_chart_request *r = g->request;
    const otx_level *leaf = r->leaves->level;

    for (int32_t k = 0; k < otx_level_face_size(leaf, face); ++k)
    {
        const int32_t next = otx_level_neighbour(leaf, face, k);
        double step;

        if (next < 0 || g->space->face_slot[next] >= 0 || leaf->face_hole[next])
            continue;
        step = r->texels * otx_dual_step(r->leaves, face, next, r->bend);
        if (reach + step > r->collar)
            continue;
        otx_pqueue_push(queue, reach + step, next);
    }
}

/* Faces that would close the disc when their turn comes are dropped; a later
 * neighbour offers them again. */
static bool
grow_collar(gathering *g, otx_arena *scratch)
{
    otx_pqueue queue = otx_pqueue_make(scratch);
    otx_pqueue_entry entry;

    for (int32_t i = 0; i < g->chart->core_count; ++i)
        push_neighbours(g, &queue, g->chart->faces[i], 0.0);
    while (otx_pqueue_pop(&queue, &entry))
    {
        if (g->space->face_slot[entry.item] >= 0 || !keeps_disc(g, entry.item))
            continue;
        if (!add_face(g, entry.item, entry.key))
            return false;
        push_neighbours(g, &queue, entry.item, entry.key);
    }
    return !otx_arena_failed(scratch);
}

/* Corner lists in local vertices. */
static bool
number_corners(gathering *g)
{
    const otx_level *leaf = g->request->leaves->level;
    otx_chart *chart = g->chart;
    int32_t total = 0;

    chart->first = OTX_NEW(g->arena, int32_t, chart->face_count + 1);
    if (!chart->first)
        return false;
    for (int32_t i = 0; i < chart->face_count; ++i)
    {
        chart->first[i] = total;
        total += otx_level_face_size(leaf, chart->faces[i]);
    }
    chart->first[chart->face_count] = total;
    chart->corners = OTX_NEW(g->arena, int32_t, total);
    if (!chart->corners)
        return false;
    for (int32_t i = 0; i < chart->face_count; ++i)
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            chart->corners[c] =
                g->space->vert_slot[leaf->face_verts
                                        [leaf->face_first[chart->faces[i]] + c -
                                         chart->first[i]]];
    return true;
}

static void
clear_space(const otx_chart *chart, otx_chart_space *space)
{
    for (int32_t i = 0; i < chart->face_count; ++i)
        space->face_slot[chart->faces[i]] = -1;
    for (int32_t i = 0; i < chart->vert_count; ++i)
        space->vert_slot[chart->verts[i]] = -1;
}

double
otx_chart_face_area(const otx_chart *chart, int32_t face)
{
    const int32_t first = chart->first[face], end = chart->first[face + 1];
    const otx_vec2 origin = chart->flat[chart->corners[first]];
    double area = 0.0;

    for (int32_t c = first + 1; c + 1 < end; ++c)
        area += otx_vec2_cross(
            otx_vec2_sub(chart->flat[chart->corners[c]], origin),
            otx_vec2_sub(chart->flat[chart->corners[c + 1]], origin));
    return 0.5 * area;
}

void
otx_chart_face_stretch(
    const otx_chart *chart, const otx_surface *surface, double texels,
    int32_t face, double sigma[2])
{
    const int32_t first = chart->first[face], end = chart->first[face + 1];
    double worst = -1.0;

    for (int32_t c = first + 1; c + 1 < end; ++c)
    {
        const int32_t v[3] = {
            chart->corners[first], chart->corners[c], chart->corners[c + 1]};
        const int32_t leaf[3] = {
            chart->verts[v[0]], chart->verts[v[1]], chart->verts[v[2]]};
        const double density = otx_surface_density(surface, leaf, 3);
        otx_vec3 p[3];
        otx_vec2 uv[3];
        double s[2], badness;

        for (int i = 0; i < 3; ++i)
        {
            p[i] = otx_vec3_scale(
                density * texels, otx_vec3_load(surface->points, leaf[i]));
            uv[i] = chart->flat[v[i]];
        }
        otx_stretch_singular(p, uv, s);
        badness = s[1] > 0.0 ? fmax(s[0], 1.0 / s[1]) : INFINITY;
        if (badness > worst)
        {
            worst = badness;
            sigma[0] = s[0];
            sigma[1] = s[1];
        }
    }
}

static void
judge_core(otx_chart *chart, const otx_chart_request *request)
{
    double sum = 0.0, area = 0.0;

    chart->worst = 1.0;
    for (int32_t f = 0; f < chart->core_count; ++f)
    {
        const double weight = request->leaves->areas[chart->faces[f]];
        double s[2], badness;

        if (!(weight > 0.0))
            continue;
        otx_chart_face_stretch(chart, request->surface, request->texels, f, s);
        badness = s[1] > 0.0 ? fmax(s[0], 1.0 / s[1]) : INFINITY;
        sum += weight * badness * badness;
        area += weight;
        chart->worst = fmax(chart->worst, badness);
    }
    chart->distortion = area > 0.0 ? sqrt(sum / area) : 1.0;
}

otx_status
otx_chart_build(
    const otx_chart_request *request, const int32_t *core, int32_t core_count,
    otx_chart_space *space, otx_arena *scratch, otx_arena *arena,
    otx_chart *out)
{
    gathering g = {
        .request = request, .space = space, .chart = out, .arena = arena};
    bool gathered = true;
    otx_status status = OSDTEX_ERROR_MEMORY;

    *out = (otx_chart){.core_count = core_count};
    for (int32_t i = 0; i < core_count && gathered; ++i)
        gathered = add_face(&g, core[i], 0.0);
    gathered = gathered && grow_collar(&g, scratch) && number_corners(&g);
    if (gathered)
        out->flat = OTX_NEW(arena, otx_vec2, out->vert_count);
    if (out->flat)
        status = otx_arap_flatten(out, request, space, scratch);
    clear_space(out, space);
    OTX_TRY(status);
    judge_core(out, request);
    assert(!otx_chart_check(out, request->surface));
    return OSDTEX_OK;
}
