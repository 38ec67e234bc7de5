/* first_direction.c -- the direction of the user's first patch, for a field. */
#include "method/hierarchical/first_direction.h"

#include <string.h>

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
    if (set && set->field.directions)
        return true;
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
    OTX_TRY(otx_run_ok(run));
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
