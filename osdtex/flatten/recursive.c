/* recursive.c -- a piece and those beyond its sides, each flattened alone, as
 * one chart. */
#include "flatten/recursive.h"

#include "flatten/chart_check.h"
#include "flatten/piece.h"

#include <assert.h>

/* Room for all leaves of the pieces. */
static otx_status
allocate_chart(
    const otx_piece *pieces, int32_t count, otx_arena *arena, otx_chart *chart)
{
    int64_t faces = 0, verts = 0, corners = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        if (pieces[i].corner_count < 3)
            continue;
        faces += pieces[i].leaf_count;
        verts += pieces[i].vert_count;
        corners += pieces[i].first[pieces[i].leaf_count];
    }
    chart->faces = OTX_NEW(arena, int32_t, faces);
    chart->first = OTX_NEW(arena, int32_t, faces + 1);
    chart->corners = OTX_NEW(arena, int32_t, corners);
    chart->verts = OTX_NEW(arena, int32_t, verts);
    chart->flat = OTX_NEW(arena, otx_vec2, verts);
    chart->reach = OTX_NEW(arena, float, faces);
    chart->vert_reach = OTX_NEW(arena, float, verts);
    if (!chart->faces || !chart->first || !chart->corners || !chart->verts ||
        !chart->flat || !chart->reach || !chart->vert_reach)
        return OSDTEX_ERROR_MEMORY;
    chart->first[0] = 0;
    return OSDTEX_OK;
}

static int32_t
add_vert(otx_chart *chart, int32_t vert, otx_vec2 at, double reach)
{
    const int32_t slot = chart->vert_count++;

    chart->verts[slot] = vert;
    chart->flat[slot] = at;
    chart->vert_reach[slot] = (float)reach;
    return slot;
}

/* Puts the core's vertices first, in order, and all its faces. */
static void
add_core(otx_chart *chart, const otx_piece *p)
{
    for (int32_t i = 0; i < p->vert_count; ++i)
        add_vert(chart, p->verts[i], p->flat[i], 0.0);
    for (int32_t f = 0; f < p->leaf_count; ++f)
    {
        const int32_t i = chart->face_count++;

        chart->faces[i] = p->leaves[f];
        chart->reach[i] = 0.0f;
        chart->first[i + 1] = p->first[f + 1];
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            chart->corners[c] = p->corners[c];
    }
    chart->core_count = chart->face_count;
}

/* Moves the piece so that its copy of the edge lies on the core's. */
static void
lay_against(otx_piece *p, const otx_vec2 target[2], const otx_vec2 own[2])
{
    const otx_vec2 from = otx_vec2_sub(own[1], own[0]);
    const otx_vec2 to = otx_vec2_sub(target[1], target[0]);
    const otx_vec2 product = otx_vec2_mul(to, (otx_vec2){from.x, -from.y});
    const double length = otx_vec2_length(product);
    const otx_vec2 turn = length > 0.0 ? otx_vec2_scale(1.0 / length, product)
                                       : (otx_vec2){1.0, 0.0};
    const otx_vec2 shift = otx_vec2_sub(
        otx_vec2_lerp(target[0], target[1], 0.5),
        otx_vec2_mul(turn, otx_vec2_lerp(own[0], own[1], 0.5)));

    for (int32_t i = 0; i < p->vert_count; ++i)
        p->flat[i] = otx_vec2_add(otx_vec2_mul(turn, p->flat[i]), shift);
}

/* The chart vertex of a piece's vertex: the core's on the common edge (value
 * exactly 0, being made of halves of 0), its own elsewhere. */
static int32_t
chart_vert(
    otx_chart *chart, const otx_chart_space *space, const otx_piece *p,
    int32_t local, double size, int32_t *map)
{
    const int32_t core = space->vert_slot[p->verts[local]];

    if (map[local] < 0)
        map[local] = p->value[local] == 0.0 && core >= 0
                         ? core
                         : add_vert(
                               chart, p->verts[local], p->flat[local],
                               p->value[local] * size);
    return map[local];
}

/* Adds the faces of a neighbour that reach into the collar. */
static otx_status
add_collar(
    otx_chart *chart, otx_chart_space *space, const otx_piece *p, double size,
    double collar, otx_arena *scratch)
{
    int32_t *map = OTX_NEW(scratch, int32_t, p->vert_count);

    if (!map)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < p->vert_count; ++i)
        map[i] = -1;
    for (int32_t l = 0; l < p->leaf_count; ++l)
    {
        const int32_t f = p->leaves[l];
        const int32_t first = p->first[l], end = p->first[l + 1];
        const int32_t i = chart->face_count;
        double nearest = INFINITY, sum = 0.0;
        int32_t n = chart->first[i];

        for (int32_t c = first; c < end; ++c)
        {
            nearest = fmin(nearest, size * p->value[p->corners[c]]);
            sum += size * p->value[p->corners[c]];
        }
        if (nearest >= collar || space->face_slot[f] >= 0)
            continue;
        space->face_slot[f] = i;
        chart->faces[i] = f;
        chart->reach[i] = (float)(sum / (end - first));
        for (int32_t c = first; c < end; ++c)
            chart->corners[n++] =
                chart_vert(chart, space, p, p->corners[c], size, map);
        chart->first[i + 1] = n;
        ++chart->face_count;
    }
    return OSDTEX_OK;
}

/* Lays a neighbour against a side of the core and adds it. The core's vertices
 * have their chart numbers in vert_slot. */
static otx_status
join(
    otx_chart *chart, otx_chart_space *space, const otx_piece *core,
    const otx_side *side, otx_piece *p, double size, otx_arena *scratch)
{
    const otx_chart_request *request = core->request;
    const int32_t *ends = side->ends;
    otx_vec2 own[2] = {{0, 0}, {0, 0}}, target[2];

    for (int32_t i = 0; i < p->vert_count; ++i)
        for (int j = 0; j < 2; ++j)
            if (p->verts[i] == ends[j])
                own[j] = p->flat[i];
    for (int j = 0; j < 2; ++j)
        target[j] = chart->flat[space->vert_slot[ends[j]]];
    lay_against(p, target, own);
    return add_collar(chart, space, p, size, request->collar, scratch);
}

static void
judge(otx_chart *chart, const otx_chart_request *request)
{
    double surface = 0.0, plane = 0.0;

    chart->worst = 1.0;
    for (int32_t f = 0; f < chart->core_count; ++f)
    {
        double s[2];

        if (!(request->leaves->areas[chart->faces[f]] > 0.0))
            continue;
        surface += request->leaves->areas[chart->faces[f]];
        plane += otx_chart_face_area(chart, f);
        otx_chart_face_stretch(chart, request->surface, request->texels, f, s);
        chart->worst =
            fmax(chart->worst, s[1] > 0.0 ? fmax(s[0], 1.0 / s[1]) : INFINITY);
    }
    surface *= request->texels * request->texels;
    chart->distortion = 1.0;
    if (surface > 0.0)
        chart->distortion +=
            plane > 0.0 ? fabs(surface / plane - 1.0) : INFINITY;
    if (chart->worst == (double)INFINITY)
        chart->distortion = INFINITY;
}

/* Size of the patch, texels: what a position value of 1 stands for. */
static double
patch_size(const otx_chart_request *request, const otx_piece *p)
{
    double area = 0.0;

    for (int32_t i = 0; i < p->leaf_count; ++i)
        area += request->leaves->areas[p->leaves[i]];
    return request->texels * sqrt(area);
}

static otx_status
assemble(
    const otx_piece *core, otx_piece *pieces, const otx_side *sides,
    int32_t count, otx_chart_space *space, otx_arena *scratch, otx_chart *out)
{
    const double size = patch_size(core->request, core);
    otx_status status = OSDTEX_OK;

    add_core(out, core);
    for (int32_t i = 0; i < core->vert_count; ++i)
        space->vert_slot[core->verts[i]] = i;
    for (int32_t i = 0; i < count && status == OSDTEX_OK; ++i)
        if (pieces[i].corner_count >= 3)
            status =
                join(out, space, core, &sides[i], &pieces[i], size, scratch);
    for (int32_t i = 0; i < core->vert_count; ++i)
        space->vert_slot[core->verts[i]] = -1;
    for (int32_t i = 0; i < out->face_count; ++i)
        space->face_slot[out->faces[i]] = -1;
    return status;
}

otx_status
otx_recursive_build(
    const otx_chart_request *request, const otx_controls *controls,
    const otx_cluster *cluster, otx_chart_space *space, otx_arena *scratch,
    otx_arena *arena, otx_chart *out)
{
    otx_piece core, *pieces;
    otx_side *sides;
    int32_t count;

    *out = (otx_chart){.distortion = INFINITY, .worst = INFINITY};
    OTX_TRY(otx_piece_make(
        request, controls, cluster, NULL, space, scratch, &core));
    if (core.corner_count < 3)
        return OSDTEX_OK;
    OTX_TRY(otx_piece_sides(&core, scratch, &sides, &count));
    pieces = OTX_NEW(scratch, otx_piece, count + 1);
    if (!pieces)
        return OSDTEX_ERROR_MEMORY;
    pieces[0] = core;
    for (int32_t k = 0; k < count; ++k)
        OTX_TRY(otx_piece_make(
            request, controls, &sides[k].beyond, &sides[k], space, scratch,
            &pieces[k + 1]));
    OTX_TRY(allocate_chart(pieces, count + 1, arena, out));
    OTX_TRY(
        assemble(&pieces[0], pieces + 1, sides, count, space, scratch, out));
    judge(out, request);
    assert(!otx_chart_check(out, request->surface));
    return OSDTEX_OK;
}
