/* area.c -- where an edit takes effect. */
#include "edit/area.h"

#include "surface/subset.h"

#include <string.h>

static otx_vec3
centre(const otx_surface *surface, const otx_level *leaf, int32_t face)
{
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    otx_vec3 sum = {0, 0, 0};

    for (int32_t c = first; c < first + size; ++c)
        sum = otx_vec3_add(
            sum, otx_vec3_load(surface->points, leaf->face_verts[c]));
    return otx_vec3_scale(1.0 / size, sum);
}

/* Faces around a point, in one pass: those within its radius, and the nearest
 * where there are none. */
static int32_t
hold_point(
    const otx_surface *surface, const otx_constraint *item, int32_t *faces)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const double *o = surface->cage->origin;
    const otx_vec3 at = otx_vec3_sub(item->point, (otx_vec3){o[0], o[1], o[2]});
    double best = INFINITY;
    int32_t nearest = -1, count = 0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const double d =
            otx_vec3_length(otx_vec3_sub(centre(surface, leaf, f), at));

        if (leaf->face_hole[f])
            continue;
        if (d < best)
        {
            best = d;
            nearest = f;
        }
        if (d <= item->radius)
            faces[count++] = f;
    }
    if (count == 0 && nearest >= 0)
        faces[count++] = nearest;
    return count;
}

otx_status
otx_area_hold(
    otx_run *run, const otx_surface *surface, const otx_constraint *item,
    int32_t **faces, int32_t *count)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    *faces = OTX_NEW(run->scratch, int32_t, leaf->face_count);
    OTX_TRY(otx_run_ok(run));
    *count = 0;
    if (item->face < 0)
    {
        *count = hold_point(surface, item, *faces);
        return OSDTEX_OK;
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (leaf->face_cage[f] == item->face && !leaf->face_hole[f])
            (*faces)[(*count)++] = f;
    return OSDTEX_OK;
}

/* Marks what one constraint reaches. */
static otx_status
mark_item(
    otx_run *run, const otx_surface *surface, const otx_constraint *item,
    double reach, uint8_t *area)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = otx_surface_leaf(surface)->face_count;
    uint8_t *mine = OTX_ZNEW(run->scratch, uint8_t, count);
    int32_t *faces, held;

    OTX_TRY(otx_area_hold(run, surface, item, &faces, &held));
    for (int32_t i = 0; i < held; ++i)
        mine[faces[i]] = 1;
    OTX_TRY(otx_subset_widen(
        run, surface, item->reach > 0.0 ? item->reach : reach, 1, mine));
    for (int32_t f = 0; f < count; ++f)
        area[f] |= mine[f];
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_area_find(
    otx_run *run, const otx_surface *surface, const otx_constraint_set *set,
    int32_t edit, double reach, uint8_t *area)
{
    for (int32_t i = 0; i < set->count; ++i)
    {
        if (set->items[i].edit != edit)
            continue;
        OTX_TRY(otx_constraint_check(run, set, surface->cage, i));
        OTX_TRY(mark_item(run, surface, &set->items[i], reach, area));
    }
    return OSDTEX_OK;
}
