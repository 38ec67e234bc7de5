/* first.c -- the patch that the user begins with.
 *
 * What he says of it he says of a face of the cage: where in the picture its
 * middle lies, and which way its first edge runs. A patch may be larger than
 * that face or smaller; it is the face that he sees. */
#include "method/hierarchical/hierarchical.h"

#include <string.h>

static bool
is_on_face(const otx_mapper *m, int32_t leaf)
{
    return m->leaves.level->face_cage[leaf] == m->request->first_face;
}

int32_t
otx_first_node(const otx_mapper *m)
{
    const otx_level *leaf = m->leaves.level;

    if (m->request->first_face < 0)
        return -1;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (is_on_face(m, f))
            return m->leaf_node[f];
    return -1;
}

bool
otx_first_is(const otx_mapper *m, const otx_node *node)
{
    if (m->request->first_face < 0 || m->patch_count > 0)
        return false;
    for (int32_t i = 0; i < node->leaf_count; ++i)
        if (is_on_face(m, node->leaves[i]))
            return true;
    return false;
}

bool
otx_first_holds(const otx_mapper *m, int32_t leaf)
{
    return m->request->first_face >= 0 && is_on_face(m, leaf) &&
           m->face_patch[leaf] == 0;
}

otx_vec2
otx_first_middle(const otx_mapper *m, const otx_chart *chart)
{
    otx_vec2 sum = {0, 0};
    int32_t corners = 0;

    for (int32_t i = 0; i < chart->core_count; ++i)
    {
        if (!is_on_face(m, chart->faces[i]))
            continue;
        for (int32_t c = chart->first[i]; c < chart->first[i + 1]; ++c)
            sum = otx_vec2_add(sum, chart->flat[chart->corners[c]]);
        corners += chart->first[i + 1] - chart->first[i];
    }
    return otx_vec2_scale(1.0 / corners, sum);
}

double
otx_first_heading(const otx_mapper *m, const otx_chart *chart)
{
    const otx_level *cage = &m->surface->levels[0];
    const int32_t *ends =
        cage->face_verts + cage->face_first[m->request->first_face];
    int32_t found[2] = {-1, -1};
    otx_vec2 edge;

    for (int32_t v = chart->vert_count - 1; v >= 0; --v)
        for (int k = 0; k < 2; ++k)
            if (chart->verts[v] == ends[k])
                found[k] = v;
    if (found[0] < 0 || found[1] < 0)
        return 0.0;
    edge = otx_vec2_sub(chart->flat[found[1]], chart->flat[found[0]]);
    return atan2(edge.y, edge.x);
}

/* -- the direction that spreads ------------------------------------------ */

/* The first edge of a face of the cage, unit and along the face, turned by
 * `angle` about its normal. False where it has none. */
static bool
turned_edge(
    const otx_surface *surface, int32_t face, double angle, otx_vec3 *out)
{
    const otx_level *cage = &surface->levels[0];
    const int32_t *verts = cage->face_verts + cage->face_first[face];
    const otx_vec3 a = otx_vec3_load(surface->points, verts[0]);
    const otx_vec3 edge =
        otx_vec3_sub(otx_vec3_load(surface->points, verts[1]), a);
    otx_vec3 normal = {0, 0, 0}, side;

    for (int32_t k = 1; k + 1 < otx_level_face_size(cage, face); ++k)
        normal = otx_vec3_add(
            normal,
            otx_vec3_cross(
                otx_vec3_sub(otx_vec3_load(surface->points, verts[k]), a),
                otx_vec3_sub(otx_vec3_load(surface->points, verts[k + 1]), a)));
    side = otx_vec3_cross(normal, edge);
    if (!(otx_vec3_length(side) > 0.0))
        return false;
    side = otx_vec3_unit(side);
    *out = otx_vec3_add(
        otx_vec3_scale(cos(angle), otx_vec3_unit(otx_vec3_cross(side, normal))),
        otx_vec3_scale(sin(angle), side));
    return true;
}

static bool
has_direction(const otx_constraint_set *set, int32_t face)
{
    for (int32_t i = 0; set && i < set->count; ++i)
        if (set->items[i].has_direction && set->items[i].face == face)
            return true;
    return false;
}

/* Whether a face of the cage shows exemplar k, as far as its first leaf does.
 */
static bool
shows(
    const otx_surface *surface, const otx_map_request *request, int32_t face,
    int32_t k)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    int32_t f = 0;

    while (f < leaf->face_count && leaf->face_cage[f] != face)
        ++f;
    return f < leaf->face_count && !leaf->face_hole[f] &&
           (request->demand ? request->demand[f] : 0) == k;
}

otx_status
otx_first_constrain(
    otx_run *run, const otx_surface *surface, const otx_map_request *request,
    int32_t k, double angle, const otx_constraint_set **out)
{
    const otx_constraint_set *from = request->constraints;
    const int32_t face = request->first_face, count = from ? from->count : 0;
    otx_constraint_set *set;
    otx_constraint *items, first = {.face = face, .has_direction = true};

    *out = from;
    if (face < 0 || has_direction(from, face) ||
        !shows(surface, request, face, k) ||
        !turned_edge(
            surface, face, angle - request->first_angle, &first.direction))
        return OSDTEX_OK;
    set = OTX_ZNEW(run->arena, otx_constraint_set, 1);
    items = OTX_NEW(run->arena, otx_constraint, (int64_t)count + 1);
    if (!set || !items)
        return otx_fail_memory(run, "field");
    if (from)
        *set = *from;
    if (count > 0)
        memcpy(items, from->items, (size_t)count * sizeof *items);
    items[count] = first;
    set->items = items;
    set->count = count + 1;
    *out = set;
    return OSDTEX_OK;
}
