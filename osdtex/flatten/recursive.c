/* recursive.c -- patches laid out below their control polygons.
 *
 * The paper places a vertex on an edge by barycentric coordinates in the whole
 * control polygon, gets slightly different places from the two sides, and
 * averages. Here it is placed by the edge's ends alone: with m seen along the
 * mean normal of the three, z = (m - a) / (b - a) as complex numbers, and in
 * texture space t_m = t_a + z (t_b - t_a). Both sides get the same place, and
 * a neighbour laid against the edge meets it at every vertex. */
#include "flatten/recursive.h"

#include "flatten/chart_check.h"
#include "flatten/descent.h"
#include "flatten/polygon.h"

#include <assert.h>

/* -- one patch ----------------------------------------------------------- */

/* The leaves below one face, flattened by themselves. */
typedef struct piece
{
    const otx_chart_request *request;
    int32_t level, face;
    int32_t first, end; /* leaf faces */
    int32_t vert_count;
    int32_t *verts;   /* [vert_count] leaf vertices */
    int32_t *corners; /* local, from leaf->face_first[first] on */
    otx_vec2 *flat;   /* [vert_count] texels */
    double *value;    /* [vert_count] position values; NULL for the core */
    const int32_t *slot;
    otx_vec2 *polygon; /* room for the corners of any face below, ... */
    double *weights;   /* ... and for their coordinates */
} piece;

static otx_vec3
point_of(const piece *p, int32_t vert)
{
    return otx_vec3_scale(
        p->request->texels, otx_vec3_load(p->request->surface->points, vert));
}

/* x and y of a plane that is seen from the tip of its normal. */
static void
plane_axes(otx_vec3 normal, otx_vec3 *x, otx_vec3 *y)
{
    const otx_vec3 helper =
        fabs(normal.x) < 0.6 ? (otx_vec3){1, 0, 0} : (otx_vec3){0, 1, 0};

    *x = otx_vec3_unit(otx_vec3_cross(helper, normal));
    *y = otx_vec3_cross(normal, *x);
}

/* See the head of the file. Case 2 of the paper. */
static void
place_edge(void *context, int32_t born, int32_t a, int32_t b)
{
    const piece *p = context;
    const float *normals = p->request->surface->normals;
    const otx_vec3 normal = otx_vec3_unit(otx_vec3_add(
        otx_vec3_load(normals, born),
        otx_vec3_add(otx_vec3_load(normals, a), otx_vec3_load(normals, b))));
    const otx_vec3 edge = otx_vec3_sub(point_of(p, b), point_of(p, a));
    const otx_vec3 way = otx_vec3_sub(point_of(p, born), point_of(p, a));
    const otx_vec2 from = p->flat[p->slot[a]], to = p->flat[p->slot[b]];
    otx_vec3 x, y;
    otx_vec2 e, m, z = {0.5, 0.0};
    double length_sq;

    plane_axes(normal, &x, &y);
    e = (otx_vec2){otx_vec3_dot(edge, x), otx_vec3_dot(edge, y)};
    m = (otx_vec2){otx_vec3_dot(way, x), otx_vec3_dot(way, y)};
    length_sq = otx_vec2_dot(e, e);
    /* An edge that stands upright on the plane has no direction in it. */
    if (length_sq > 1e-6 * otx_vec3_dot(edge, edge))
        z = otx_vec2_scale(
            1.0 / length_sq, otx_vec2_mul(m, (otx_vec2){e.x, -e.y}));
    p->flat[p->slot[born]] =
        otx_vec2_add(from, otx_vec2_mul(z, otx_vec2_sub(to, from)));
}

/* Twice the vector area of a polygon. */
static otx_vec3
vector_area(const piece *p, const int32_t *corners, int32_t count)
{
    const otx_vec3 origin = point_of(p, corners[0]);
    otx_vec3 sum = {0, 0, 0};

    for (int32_t k = 1; k + 1 < count; ++k)
        sum = otx_vec3_add(
            sum, otx_vec3_cross(
                     otx_vec3_sub(point_of(p, corners[k]), origin),
                     otx_vec3_sub(point_of(p, corners[k + 1]), origin)));
    return sum;
}

/* In the middle of a face, seen along the face's mean normal. Case 3. */
static void
place_inside(void *context, int32_t born, const int32_t *corners, int32_t count)
{
    const piece *p = context;
    const otx_vec3 middle = point_of(p, born);
    otx_vec2 sum = {0, 0};
    otx_vec3 x, y;

    plane_axes(otx_vec3_unit(vector_area(p, corners, count)), &x, &y);
    for (int32_t k = 0; k < count; ++k)
    {
        const otx_vec3 d = otx_vec3_sub(point_of(p, corners[k]), middle);

        p->polygon[k] = (otx_vec2){otx_vec3_dot(d, x), otx_vec3_dot(d, y)};
    }
    otx_polygon_coordinates(p->polygon, count, (otx_vec2){0, 0}, p->weights);
    for (int32_t k = 0; k < count; ++k)
        sum = otx_vec2_add(
            sum, otx_vec2_scale(p->weights[k], p->flat[p->slot[corners[k]]]));
    p->flat[p->slot[born]] = sum;
}

/* Numbers the vertices below the face; leaves the numbers in vert_slot. */
static otx_status
number_piece(piece *p, otx_chart_space *space, otx_arena *scratch)
{
    const otx_level *leaf = p->request->leaves->level;
    int32_t first, count;

    otx_surface_leaves(
        p->request->surface, p->level, p->face, &p->first, &p->end);
    first = leaf->face_first[p->first];
    count = leaf->face_first[p->end] - first;
    p->verts = OTX_NEW(scratch, int32_t, count);
    p->corners = OTX_NEW(scratch, int32_t, count);
    p->slot = space->vert_slot;
    if (!p->verts || !p->corners)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t c = 0; c < count; ++c)
    {
        const int32_t v = leaf->face_verts[first + c];

        if (space->vert_slot[v] < 0)
        {
            space->vert_slot[v] = p->vert_count;
            p->verts[p->vert_count++] = v;
        }
        p->corners[c] = space->vert_slot[v];
    }
    p->flat = OTX_NEW(scratch, otx_vec2, p->vert_count);
    return p->flat ? OSDTEX_OK : OSDTEX_ERROR_MEMORY;
}

static otx_status
flatten_piece(piece *p, otx_arena *scratch)
{
    const otx_surface *surface = p->request->surface;
    const otx_level *level = &surface->levels[p->level];
    const int32_t *corners = level->face_verts + level->face_first[p->face];
    const int32_t count = otx_level_face_size(level, p->face);
    const otx_descent visitor = {place_edge, place_inside, p};
    otx_vec3 *points = OTX_NEW(scratch, otx_vec3, count);

    /* Faces further down are quads or triangles. */
    p->polygon = OTX_NEW(scratch, otx_vec2, count > 4 ? count : 4);
    p->weights = OTX_NEW(scratch, double, count > 4 ? count : 4);
    if (!points || !p->polygon || !p->weights)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t k = 0; k < count; ++k)
        points[k] = point_of(p, corners[k]);
    OTX_TRY(otx_polygon_layout(
        scratch, points, count, otx_vec3_unit(vector_area(p, corners, count)),
        p->polygon));
    for (int32_t k = 0; k < count; ++k)
        p->flat[p->slot[corners[k]]] = p->polygon[k];
    otx_descent_walk(surface, p->level, p->face, &visitor);
    return OSDTEX_OK;
}

/* v(q) = 1 - M_qa - M_qb of the edge (a, b): 0 there, 1 at other corners. */
static otx_status
value_piece(piece *p, int32_t edge, otx_arena *scratch)
{
    const otx_surface *surface = p->request->surface;
    const otx_level *level = &surface->levels[p->level];
    const int32_t *ends = level->edge_verts + 2 * (size_t)edge;

    p->value = OTX_NEW(scratch, double, p->vert_count);
    if (!p->value)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t c = level->face_first[p->face];
         c < level->face_first[p->face + 1]; ++c)
    {
        const int32_t v = level->face_verts[c];

        p->value[p->slot[v]] = v == ends[0] || v == ends[1] ? 0.0 : 1.0;
    }
    otx_descent_average(surface, p->level, p->face, p->slot, p->value);
    return OSDTEX_OK;
}

/*   edge  of the level, for position values; -1 none */
static otx_status
make_piece(
    const otx_chart_request *request, int32_t level, int32_t face, int32_t edge,
    otx_chart_space *space, otx_arena *scratch, piece *out)
{
    otx_status status;

    *out = (piece){.request = request, .level = level, .face = face};
    status = number_piece(out, space, scratch);
    if (status == OSDTEX_OK)
        status = flatten_piece(out, scratch);
    if (status == OSDTEX_OK && edge >= 0)
        status = value_piece(out, edge, scratch);
    for (int32_t i = 0; i < out->vert_count; ++i)
        space->vert_slot[out->verts[i]] = -1;
    return status;
}

/* -- core and collar ----------------------------------------------------- */

/* Room for all leaves of the pieces. */
static otx_status
allocate_chart(
    const piece *pieces, int32_t count, otx_arena *arena, otx_chart *chart)
{
    const otx_level *leaf = pieces[0].request->leaves->level;
    int64_t faces = 0, verts = 0, corners = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        faces += pieces[i].end - pieces[i].first;
        verts += pieces[i].vert_count;
        corners +=
            leaf->face_first[pieces[i].end] - leaf->face_first[pieces[i].first];
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
add_core(otx_chart *chart, const piece *p)
{
    const otx_level *leaf = p->request->leaves->level;
    const int32_t start = leaf->face_first[p->first];

    for (int32_t i = 0; i < p->vert_count; ++i)
        add_vert(chart, p->verts[i], p->flat[i], 0.0);
    for (int32_t f = p->first; f < p->end; ++f)
    {
        const int32_t i = chart->face_count++;

        chart->faces[i] = f;
        chart->reach[i] = 0.0f;
        chart->first[i + 1] = leaf->face_first[f + 1] - start;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            chart->corners[c] = p->corners[c];
    }
    chart->core_count = chart->face_count;
}

/* Moves the piece so that its copy of the edge lies on the core's. */
static void
lay_against(piece *p, const otx_vec2 target[2], const otx_vec2 own[2])
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
    otx_chart *chart, const otx_chart_space *space, const piece *p,
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
    otx_chart *chart, otx_chart_space *space, const piece *p, double size,
    double collar, otx_arena *scratch)
{
    const otx_level *leaf = p->request->leaves->level;
    const int32_t start = leaf->face_first[p->first];
    int32_t *map = OTX_NEW(scratch, int32_t, p->vert_count);

    if (!map)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < p->vert_count; ++i)
        map[i] = -1;
    for (int32_t f = p->first; f < p->end; ++f)
    {
        const int32_t first = leaf->face_first[f] - start;
        const int32_t end = leaf->face_first[f + 1] - start;
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

/* Lays a neighbour against the core's edge k and adds it. The core's vertices
 * have their chart numbers in vert_slot. */
static otx_status
join(
    otx_chart *chart, otx_chart_space *space, const piece *core, int32_t edge,
    piece *p, double size, otx_arena *scratch)
{
    const otx_chart_request *request = core->request;
    const int32_t *ends =
        request->surface->levels[core->level].edge_verts + 2 * (size_t)edge;
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
patch_size(const otx_chart_request *request, const piece *p)
{
    double area = 0.0;

    for (int32_t f = p->first; f < p->end; ++f)
        area += request->leaves->areas[f];
    return request->texels * sqrt(area);
}

static otx_status
assemble(
    const piece *core, piece *pieces, const int32_t *edges, int32_t count,
    otx_chart_space *space, otx_arena *scratch, otx_chart *out)
{
    const double size = patch_size(core->request, core);
    otx_status status = OSDTEX_OK;

    add_core(out, core);
    for (int32_t i = 0; i < core->vert_count; ++i)
        space->vert_slot[core->verts[i]] = i;
    for (int32_t i = 0; i < count && status == OSDTEX_OK; ++i)
        status = join(out, space, core, edges[i], &pieces[i], size, scratch);
    for (int32_t i = 0; i < core->vert_count; ++i)
        space->vert_slot[core->verts[i]] = -1;
    for (int32_t i = 0; i < out->face_count; ++i)
        space->face_slot[out->faces[i]] = -1;
    return status;
}

otx_status
otx_recursive_build(
    const otx_chart_request *request, int32_t level, int32_t face,
    otx_chart_space *space, otx_arena *scratch, otx_arena *arena,
    otx_chart *out)
{
    const otx_level *here = &request->surface->levels[level];
    const int32_t sides = otx_level_face_size(here, face);
    piece *pieces = OTX_NEW(scratch, piece, sides + 1);
    int32_t *edges = OTX_NEW(scratch, int32_t, sides);
    int32_t count = 0;

    *out = (otx_chart){0};
    if (!pieces || !edges)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(make_piece(request, level, face, -1, space, scratch, &pieces[0]));
    for (int32_t k = 0; k < sides; ++k)
    {
        const int32_t next = otx_level_neighbour(here, face, k);

        if (next < 0 || here->face_hole[next])
            continue;
        edges[count] = here->face_edges[here->face_first[face] + k];
        OTX_TRY(make_piece(
            request, level, next, edges[count], space, scratch,
            &pieces[count + 1]));
        ++count;
    }
    OTX_TRY(allocate_chart(pieces, count + 1, arena, out));
    OTX_TRY(
        assemble(&pieces[0], pieces + 1, edges, count, space, scratch, out));
    judge(out, request);
    assert(!otx_chart_check(out, request->surface));
    return OSDTEX_OK;
}
