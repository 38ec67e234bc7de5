/* piece.c -- patches laid out below their control polygons.
 *
 * The paper places a vertex on an edge by barycentric coordinates in the whole
 * control polygon, gets slightly different places from the two sides, and
 * averages. Here it is placed by the edge's ends alone: with m seen along the
 * mean normal of the three, z = (m - a) / (b - a) as complex numbers, and in
 * texture space t_m = t_a + z (t_b - t_a). Both sides get the same place, and
 * a neighbour laid against the edge meets it at every vertex. */
#include "flatten/piece.h"

#include "flatten/polygon.h"
#include "flatten/region.h"

#include <string.h>

static otx_vec3
point_of(const otx_piece *p, int32_t vert)
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
    const otx_piece *p = context;
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
vector_area(const otx_piece *p, const int32_t *corners, int32_t count)
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
    const otx_piece *p = context;
    const otx_vec3 middle = point_of(p, born);
    otx_vec2 sum = {0, 0};
    otx_vec3 x, y;

    plane_axes(otx_vec3_unit(vector_area(p, corners, count)), &x, &y);
    for (int32_t k = 0; k < count; ++k)
    {
        const otx_vec3 d = otx_vec3_sub(point_of(p, corners[k]), middle);

        p->seen[k] = (otx_vec2){otx_vec3_dot(d, x), otx_vec3_dot(d, y)};
    }
    otx_polygon_coordinates(p->seen, count, (otx_vec2){0, 0}, p->weights);
    for (int32_t k = 0; k < count; ++k)
        sum = otx_vec2_add(
            sum, otx_vec2_scale(p->weights[k], p->flat[p->slot[corners[k]]]));
    p->flat[p->slot[born]] = sum;
}

/* Numbers the vertices below the cluster; leaves the numbers in vert_slot. */
static otx_status
number_verts(otx_piece *p, otx_chart_space *space, otx_arena *scratch)
{
    const otx_level *leaf = p->request->leaves->level;
    int32_t count = 0;

    p->first = OTX_NEW(scratch, int32_t, p->leaf_count + 1);
    if (!p->first)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < p->leaf_count; ++i)
    {
        p->first[i] = count;
        count += otx_level_face_size(leaf, p->leaves[i]);
    }
    p->first[p->leaf_count] = count;
    p->verts = OTX_NEW(scratch, int32_t, count);
    p->corners = OTX_NEW(scratch, int32_t, count);
    p->slot = space->vert_slot;
    if (!p->verts || !p->corners)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < p->leaf_count; ++i)
        for (int32_t c = p->first[i]; c < p->first[i + 1]; ++c)
        {
            const int32_t v =
                leaf->face_verts
                    [leaf->face_first[p->leaves[i]] + c - p->first[i]];

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

/* Corners of a face, control vertices of a region. */
static otx_status
list_polygon(otx_piece *p, otx_arena *scratch)
{
    const otx_cluster *c = &p->cluster;
    const otx_level *level = &p->request->surface->levels[c->level];
    otx_outline border;

    if (c->face_count == 1)
    {
        const int32_t first = level->face_first[c->faces[0]];

        p->corner_count = otx_level_face_size(level, c->faces[0]);
        p->polygon = OTX_NEW(scratch, int32_t, p->corner_count);
        if (!p->polygon)
            return OSDTEX_ERROR_MEMORY;
        memcpy(
            p->polygon, level->face_verts + first,
            (size_t)p->corner_count * sizeof *p->polygon);
        return OSDTEX_OK;
    }
    OTX_TRY(otx_outline_trace(
        p->controls, c->node, otx_cluster_tree_level(p->controls->tree, c),
        scratch, &border));
    p->corner_count = border.control_count;
    p->polygon = OTX_NEW(scratch, int32_t, border.control_count);
    if (!p->polygon)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t k = 0; k < border.control_count; ++k)
        p->polygon[k] = border.verts[border.controls[k]];
    return OSDTEX_OK;
}

/* Visits all that is below the control vertices. */
static otx_status
walk(
    otx_piece *p, const otx_descent *visitor,
    void (*inside)(void *, int32_t, const int32_t *, int32_t),
    otx_arena *scratch)
{
    if (p->cluster.face_count > 1)
        return otx_region_walk(
            p->controls, p->cluster.node, p->slot, p->vert_count, visitor,
            inside, scratch);
    otx_descent_walk(
        p->request->surface, p->cluster.level, p->cluster.faces[0], visitor);
    return OSDTEX_OK;
}

/* More control vertices than any region below has, and corners than any face.
 */
static int32_t
corners_most(const otx_piece *p)
{
    const int32_t most =
        p->cluster.face_count > 1 ? p->vert_count : p->corner_count;

    return most > 4 ? most : 4;
}

static otx_status
flatten(otx_piece *p, otx_arena *scratch)
{
    const otx_descent visitor = {place_edge, place_inside, p};
    const int32_t count = p->corner_count;
    otx_vec3 *points = OTX_NEW(scratch, otx_vec3, count);
    otx_vec2 *polygon = OTX_NEW(scratch, otx_vec2, count);

    p->seen = OTX_NEW(scratch, otx_vec2, corners_most(p));
    p->weights = OTX_NEW(scratch, double, corners_most(p));
    if (!points || !polygon || !p->seen || !p->weights)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t k = 0; k < count; ++k)
        points[k] = point_of(p, p->polygon[k]);
    OTX_TRY(otx_polygon_layout(
        scratch, points, count,
        otx_vec3_unit(vector_area(p, p->polygon, count)), polygon));
    for (int32_t k = 0; k < count; ++k)
        p->flat[p->slot[p->polygon[k]]] = polygon[k];
    return walk(p, &visitor, place_inside, scratch);
}

/* -- position values ----------------------------------------------------- */

static void
average_edge(void *context, int32_t born, int32_t a, int32_t b)
{
    const otx_piece *p = context;

    p->value[p->slot[born]] =
        0.5 * (p->value[p->slot[a]] + p->value[p->slot[b]]);
}

static void
average_face(void *context, int32_t born, const int32_t *corners, int32_t count)
{
    const otx_piece *p = context;
    double sum = 0.0;

    for (int32_t k = 0; k < count; ++k)
        sum += p->value[p->slot[corners[k]]];
    p->value[p->slot[born]] = sum / count;
}

/* By the inverse of the distances to the control vertices. */
static void
average_inside(
    void *context, int32_t born, const int32_t *corners, int32_t count)
{
    const otx_piece *p = context;
    double sum = 0.0, weights = 0.0;

    for (int32_t k = 0; k < count; ++k)
    {
        const double weight =
            1.0 / fmax(
                      otx_vec3_length(otx_vec3_sub(
                          point_of(p, corners[k]), point_of(p, born))),
                      1e-9);

        sum += weight * p->value[p->slot[corners[k]]];
        weights += weight;
    }
    p->value[p->slot[born]] = sum / weights;
}

/* v(q) = 1 - M_qa - M_qb of the side (a, b): 0 there, 1 at other corners. */
static otx_status
find_values(otx_piece *p, const otx_side *side, otx_arena *scratch)
{
    const otx_descent visitor = {average_edge, average_face, p};

    p->value = OTX_NEW(scratch, double, p->vert_count);
    if (!p->value)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t k = 0; k < p->corner_count; ++k)
    {
        const int32_t v = p->polygon[k];

        p->value[p->slot[v]] =
            v == side->ends[0] || v == side->ends[1] ? 0.0 : 1.0;
    }
    return walk(p, &visitor, average_inside, scratch);
}

otx_status
otx_piece_make(
    const otx_chart_request *request, const otx_controls *controls,
    const otx_cluster *cluster, const otx_side *side, otx_chart_space *space,
    otx_arena *scratch, otx_piece *out)
{
    otx_status status;

    *out = (otx_piece){
        .request = request, .controls = controls, .cluster = *cluster};
    OTX_TRY(list_polygon(out, scratch));
    if (out->corner_count < 3)
        return OSDTEX_OK;
    out->leaves = otx_cluster_leaves(
        scratch, request->surface, cluster, &out->leaf_count);
    if (!out->leaves)
        return OSDTEX_ERROR_MEMORY;
    status = number_verts(out, space, scratch);
    if (status == OSDTEX_OK)
        status = flatten(out, scratch);
    if (status == OSDTEX_OK && side)
        status = find_values(out, side, scratch);
    for (int32_t i = 0; i < out->vert_count; ++i)
        space->vert_slot[out->verts[i]] = -1;
    return status;
}

/* -- sides --------------------------------------------------------------- */

static otx_status
face_sides(
    const otx_piece *p, otx_arena *scratch, otx_side **out, int32_t *count)
{
    const otx_cluster *c = &p->cluster;
    const otx_level *level = &p->request->surface->levels[c->level];
    otx_side *sides = OTX_NEW(scratch, otx_side, p->corner_count);

    *out = sides;
    for (int32_t k = 0; sides && k < p->corner_count; ++k)
    {
        const int32_t next = otx_level_neighbour(level, c->faces[0], k);
        const int32_t edge =
            level->face_edges[level->face_first[c->faces[0]] + k];
        otx_side *s = &sides[*count];

        if (next < 0 || level->face_hole[next])
            continue;
        s->ends[0] = level->edge_verts[2 * (size_t)edge];
        s->ends[1] = level->edge_verts[2 * (size_t)edge + 1];
        s->face = next;
        s->beyond = (otx_cluster){c->level, 1, &s->face, 0.0, -1};
        ++*count;
    }
    return sides ? OSDTEX_OK : OSDTEX_ERROR_MEMORY;
}

otx_status
otx_piece_sides(
    const otx_piece *p, otx_arena *scratch, otx_side **out, int32_t *count)
{
    const otx_controls *controls = p->controls;
    int32_t level;
    otx_outline border;

    *count = 0;
    if (p->cluster.face_count == 1)
        return face_sides(p, scratch, out, count);
    level = otx_cluster_tree_level(controls->tree, &p->cluster);
    OTX_TRY(
        otx_outline_trace(controls, p->cluster.node, level, scratch, &border));
    *out = OTX_NEW(scratch, otx_side, border.control_count);
    if (!*out)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t k = 0; k < border.control_count; ++k)
    {
        const int32_t next = otx_controls_cluster(
            controls, border.outside[border.controls[k]], level);

        if (next < 0)
            continue;
        (*out)[(*count)++] = (otx_side){
            {p->polygon[k], p->polygon[(k + 1) % p->corner_count]},
            -1,
            otx_cluster_tree_node(controls->tree, next)};
    }
    return OSDTEX_OK;
}
