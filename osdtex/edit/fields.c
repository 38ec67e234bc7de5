/* fields.c -- directions, sizes and places along an axis, edited in an area. */
#include "edit/fields.h"

#include "edit/area.h"
#include "field/attract.h"

#include <string.h>

/* Largest factor on the texture's size, either way. */
static const double SCALE_MAX = 16.0;

/* A unit direction whose part along a face is shorter says nothing there. */
static const double UPRIGHT = 0.05;

/* ---- the place --------------------------------------------------------- */

/* The area and all faces that have a vertex of it. */
static otx_status
take_subset(otx_run *run, const uint8_t *area, otx_edit_place *p)
{
    const otx_level *leaf = otx_surface_leaf(p->surface);
    uint8_t *verts = OTX_ZNEW(run->scratch, uint8_t, leaf->vert_count);
    uint8_t *taken = OTX_ZNEW(run->scratch, uint8_t, leaf->face_count);
    otx_subset *subset = OTX_NEW(run->arena, otx_subset, 1);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t c = leaf->face_first[f];
             area[f] && c < leaf->face_first[f + 1]; ++c)
            verts[leaf->face_verts[c]] = 1;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
            taken[f] |= verts[leaf->face_verts[c]];
    p->subset = subset;
    return otx_subset_take(run, p->surface, taken, subset);
}

otx_status
otx_edit_place_make(
    otx_run *run, const otx_surface *surface, const otx_constraint_set *set,
    int32_t edit, const uint8_t *area, otx_edit_place *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_level *level;

    *out = (otx_edit_place){.surface = surface, .set = set, .edit = edit};
    OTX_TRY(take_subset(run, area, out));
    level = otx_surface_leaf(&out->subset->surface);
    out->faces = OTX_NEW(run->arena, uint8_t, level->face_count);
    out->verts = OTX_NEW(run->arena, uint8_t, level->vert_count);
    OTX_TRY(otx_run_ok(run));
    memset(out->verts, 1, (size_t)level->vert_count);
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        out->faces[f] = area[out->subset->faces[f]];
        for (int32_t c = level->face_first[f];
             !out->faces[f] && c < level->face_first[f + 1]; ++c)
            out->verts[level->face_verts[c]] = 0;
    }
    otx_arena_release(run->scratch, mark);
    return otx_connection_build(
        run, &out->subset->surface, 0, &out->connection);
}

otx_edit_asks
otx_edit_asks_of(const otx_constraint_set *set, int32_t edit)
{
    otx_edit_asks asks = {0};

    for (int32_t i = 0; i < set->count; ++i)
    {
        const otx_constraint *item = &set->items[i];

        if (item->edit != edit)
            continue;
        asks.direction |= item->has_direction;
        asks.scale |= item->scale > 0.0;
        asks.material |= item->has_material;
        asks.exemplar |= item->exemplar > 0 || item->exemplar_name;
        asks.redo |= item->redo > 0;
        if (item->redo > asks.take)
            asks.take = item->redo;
    }
    return asks;
}

/* The faces of the area that a constraint holds. What an earlier one holds
 * elsewhere must not be taken for the nearest face here. */
static otx_status
hold(
    otx_run *run, const otx_edit_place *p, const otx_constraint *item,
    int32_t **faces, int32_t *count)
{
    const double *o = p->surface->cage->origin;
    const otx_vec3 at = otx_vec3_sub(item->point, (otx_vec3){o[0], o[1], o[2]});
    const double near =
        fmax(item->radius, 2.0 * p->subset->surface.mean_edge_length);
    int32_t all;

    OTX_TRY(otx_area_hold(run, &p->subset->surface, item, faces, &all));
    *count = 0;
    for (int32_t i = 0; i < all; ++i)
    {
        const int32_t f = (*faces)[i];
        const bool reached =
            item->face >= 0 || item->edit == p->edit ||
            otx_vec3_length(otx_vec3_sub(p->connection.centres[f], at)) <= near;

        if (p->faces[f] && reached)
            (*faces)[(*count)++] = f;
    }
    return OSDTEX_OK;
}

/* ---- directions -------------------------------------------------------- */

static otx_status
refuse_upright(otx_run *run, const otx_edit_place *p, int32_t index)
{
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "field",
        (otx_where){p->set->path, 0, p->set->items[index].face, -1},
        "constraint %d has a direction that stands upright on the surface; "
        "give one along it",
        (int)index + 1);
}

/* The pins of one constraint; later ones come after earlier ones, and hold. */
static otx_status
pin_item(
    otx_run *run, const otx_edit_place *p, int32_t index,
    otx_direction_pin *pins, int32_t *count)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_constraint *item = &p->set->items[index];
    const int32_t before = *count;
    int32_t *faces, held;

    OTX_TRY(otx_constraint_check(run, p->set, p->surface->cage, index));
    OTX_TRY(hold(run, p, item, &faces, &held));
    for (int32_t i = 0; pins && i < held; ++i)
        if (otx_vec2_length(otx_connection_project(
                &p->connection, faces[i], otx_vec3_unit(item->direction))) >
            UPRIGHT)
            pins[(*count)++] = (otx_direction_pin){faces[i], item->direction};
    if (!pins)
        *count += held;
    otx_arena_release(run->scratch, mark);
    if (pins && held > 0 && *count == before && item->edit == p->edit)
        return refuse_upright(run, p, index);
    return OSDTEX_OK;
}

static otx_status
pin_all(otx_run *run, const otx_edit_place *p, otx_direction_request *out)
{
    otx_direction_pin *pins = NULL;
    int32_t count = 0;

    for (int pass = 0; pass < 2; ++pass)
    {
        if (pass == 1)
        {
            pins = OTX_NEW(run->scratch, otx_direction_pin, count);
            OTX_TRY(otx_run_ok(run));
            count = 0;
        }
        for (int32_t i = 0; i < p->set->count; ++i)
            if (p->set->items[i].has_direction &&
                p->set->items[i].edit <= p->edit)
                OTX_TRY(pin_item(run, p, i, pins, &count));
    }
    out->pins = pins;
    out->pin_count = count;
    return OSDTEX_OK;
}

/* What attracts the whole field attracts it in the area too. */
static otx_status
pull_all(
    otx_run *run, const otx_edit_place *p, const otx_direction *near,
    otx_direction_request *q)
{
    const otx_constraint_set *set = p->set;
    otx_vec2 *pull = NULL;

    if (set->follow == OTX_FOLLOW_AXIS)
        OTX_TRY(otx_attract_axis(
            run, &p->connection, q->symmetry, set->axis, &pull));
    if (set->follow == OTX_FOLLOW_EDGES)
        OTX_TRY(otx_attract_edges(
            run, &p->connection, q->symmetry, q->symmetry == 4 ? NULL : near,
            &pull));
    if (set->follow == OTX_FOLLOW_CURVATURE)
        OTX_TRY(otx_attract_curvature(
            run, &p->connection, q->symmetry, q->symmetry == 1 ? near : NULL,
            &pull));
    q->pull = pull;
    q->pull_length = set->follow_length > 0.0
                         ? set->follow_length
                         : 0.05 * p->surface->cage->diagonal;
    return OSDTEX_OK;
}

/* The guide on the subset, as a field that can be edited. */
static otx_status
read_guide(
    otx_run *run, const otx_edit_place *p, const otx_guide *guide,
    otx_direction *out)
{
    const int32_t count = otx_surface_leaf(&p->subset->surface)->face_count;

    *out = (otx_direction){
        &p->connection, guide->symmetry, OTX_NEW(run->arena, otx_vec2, count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < count; ++f)
        out->powers[f] = otx_direction_unit(
            otx_direction_power(
                otx_connection_project(
                    &p->connection, f, guide->directions[p->subset->faces[f]]),
                guide->symmetry),
            (otx_vec2){1, 0});
    return OSDTEX_OK;
}

otx_status
otx_edit_guide(
    otx_run *run, const otx_edit_place *p, const otx_guide *from,
    const otx_guide **out)
{
    const size_t faces = (size_t)otx_surface_leaf(p->surface)->face_count;
    const int32_t count = otx_surface_leaf(&p->subset->surface)->face_count;
    otx_vec3 *directions = OTX_NEW(run->arena, otx_vec3, faces);
    otx_guide *guide = OTX_NEW(run->arena, otx_guide, 1);
    otx_direction_request request = {.symmetry = from->symmetry};
    otx_direction field;

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(read_guide(run, p, from, &field));
    OTX_TRY(pull_all(run, p, &field, &request));
    OTX_TRY(pin_all(run, p, &request));
    OTX_TRY(otx_direction_edit(run, &request, p->faces, &field));
    memcpy(directions, from->directions, faces * sizeof *directions);
    for (int32_t f = 0; f < count; ++f)
        if (p->faces[f])
            directions[p->subset->faces[f]] = otx_direction_vector(&field, f);
    *guide = *from;
    guide->directions = directions;
    *out = guide;
    return OSDTEX_OK;
}

/* ---- values at vertices ------------------------------------------------ */

static bool
value_of(const otx_constraint *item, otx_constraint_kind kind, double *out)
{
    if (kind == OTX_CONSTRAINT_MATERIAL)
    {
        *out = item->material;
        return item->has_material;
    }
    *out = item->scale > 0.0 ? -log(item->scale) : 0.0;
    return item->scale > 0.0;
}

/* Locks of the vertices of the faces that one constraint holds. */
static otx_status
lock_item(
    otx_run *run, const otx_edit_place *p, int32_t index, double value,
    otx_scale_lock *locks, int32_t *count)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_level *level = otx_surface_leaf(&p->subset->surface);
    int32_t *faces, held;

    OTX_TRY(otx_constraint_check(run, p->set, p->surface->cage, index));
    OTX_TRY(hold(run, p, &p->set->items[index], &faces, &held));
    for (int32_t i = 0; i < held; ++i)
        for (int32_t c = level->face_first[faces[i]];
             c < level->face_first[faces[i] + 1]; ++c)
        {
            if (!p->verts[level->face_verts[c]])
                continue;
            if (locks)
                locks[*count] = (otx_scale_lock){level->face_verts[c], value};
            ++*count;
        }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* Solves again for `values` ([subset vert_count]) inside of the area. */
static otx_status
solve_values(
    otx_run *run, const otx_edit_place *p, otx_constraint_kind kind,
    double *values)
{
    const double most = kind == OTX_CONSTRAINT_SCALE ? log(SCALE_MAX) : 1.0;
    const double least = kind == OTX_CONSTRAINT_SCALE ? -most : 0.0;
    otx_scale_lock *locks = NULL;
    int32_t count = 0;
    double value;

    for (int pass = 0; pass < 2; ++pass)
    {
        if (pass == 1)
        {
            locks = OTX_NEW(run->scratch, otx_scale_lock, count);
            OTX_TRY(otx_run_ok(run));
            count = 0;
        }
        for (int32_t i = 0; i < p->set->count; ++i)
            if (p->set->items[i].edit <= p->edit &&
                value_of(&p->set->items[i], kind, &value))
                OTX_TRY(lock_item(run, p, i, value, locks, &count));
    }
    return otx_scale_smooth(
        run, &p->connection, locks, count, least, most, 0.0, p->verts, values);
}

/* The values of the subset, solved for and put back as floats.
 *
 *   from  [leaf vert_count] NULL: `nothing` throughout */
static otx_status
edit_values(
    otx_run *run, const otx_edit_place *p, otx_constraint_kind kind,
    const float *from, float nothing, const float **out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t all = otx_surface_leaf(p->surface)->vert_count;
    const int32_t count = otx_surface_leaf(&p->subset->surface)->vert_count;
    const bool is_scale = kind == OTX_CONSTRAINT_SCALE;
    float *made = OTX_NEW(run->arena, float, all);
    double *values = OTX_NEW(run->scratch, double, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < all; ++v)
        made[v] = from ? from[v] : nothing;
    for (int32_t v = 0; v < count; ++v)
    {
        const double was = made[p->subset->verts[v]];

        values[v] = is_scale ? log(was) : was;
    }
    OTX_TRY(solve_values(run, p, kind, values));
    for (int32_t v = 0; v < count; ++v)
        if (p->verts[v])
            made[p->subset->verts[v]] =
                (float)(is_scale ? exp(values[v]) : values[v]);
    otx_arena_release(run->scratch, mark);
    *out = made;
    return OSDTEX_OK;
}

otx_status
otx_edit_density(otx_run *run, const otx_edit_place *p, const float **out)
{
    return edit_values(
        run, p, OTX_CONSTRAINT_SCALE, p->surface->density, 1.0f, out);
}

otx_status
otx_edit_along(
    otx_run *run, const otx_edit_place *p, const float *from, const float **out)
{
    return edit_values(run, p, OTX_CONSTRAINT_MATERIAL, from, 0.0f, out);
}
