/* constraint.c -- what the artist asks of the fields on a surface. */
#include "field/constraint.h"

#include "base/queue.h"

/* Largest factor on the texture's size, either way. */
static const double SCALE_MAX = 16.0;

static otx_status
refuse(
    otx_run *run, const otx_constraint_set *set, int32_t index,
    const char *what)
{
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "field",
        (otx_where){set->path, 0, set->items[index].face, -1},
        "constraint %d %s", (int)index + 1, what);
}

static bool
is_finite(otx_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static otx_status
check(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    int32_t index)
{
    const otx_constraint *item = &set->items[index];
    const otx_cage *cage = c->surface->cage;

    if (item->face >= cage->face_count)
        return refuse(run, set, index, "names a face that the cage lacks");
    if (item->face >= 0 && cage->face_hole && cage->face_hole[item->face])
        return refuse(run, set, index, "lies on a hole");
    if (item->face < 0 && (!is_finite(item->point) || !isfinite(item->radius) ||
                           item->radius < 0.0))
        return refuse(
            run, set, index, "needs a face, or a finite point and radius");
    if (item->has_direction && (!is_finite(item->direction) ||
                                !(otx_vec3_length(item->direction) > 0.0)))
        return refuse(
            run, set, index, "has a direction that is zero or not finite");
    /* Written so that NaN is refused too. */
    if (item->scale != 0.0 &&
        !(item->scale >= 1.0 / SCALE_MAX && item->scale <= SCALE_MAX))
        return refuse(run, set, index, "has a scale outside 1/16 .. 16");
    return OSDTEX_OK;
}

/* The face whose centre is nearest to a point. */
static int32_t
nearest_face(const otx_connection *c, otx_vec3 point)
{
    double best = INFINITY;
    int32_t face = -1;

    for (int32_t f = 0; f < c->level->face_count; ++f)
    {
        const double d = otx_vec3_length(otx_vec3_sub(c->centres[f], point));

        if (!c->level->face_hole[f] && d < best)
        {
            best = d;
            face = f;
        }
    }
    return face;
}

static bool
holds(
    const otx_connection *c, const otx_constraint *item, int32_t nearest,
    int32_t face)
{
    if (c->level->face_hole[face])
        return false;
    if (item->face >= 0)
        return c->level->face_cage[face] == item->face;
    return face == nearest ||
           otx_vec3_length(otx_vec3_sub(c->centres[face], item->point)) <=
               item->radius;
}

/* Pins the faces of one constraint; those on which its direction stands
 * upright are left out, unless all are. */
static otx_status
pin_item(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    int32_t index, otx_direction_pin *pins, int32_t *count)
{
    const otx_constraint *item = &set->items[index];
    const int32_t nearest = item->face < 0 ? nearest_face(c, item->point) : -1;
    const int32_t before = *count;

    for (int32_t f = 0; f < c->level->face_count; ++f)
        if (holds(c, item, nearest, f) &&
            otx_vec2_length(otx_connection_project(
                c, f, otx_vec3_unit(item->direction))) > 0.05)
            pins[(*count)++] = (otx_direction_pin){f, item->direction};
    if (*count == before)
        return refuse(
            run, set, index,
            "has a direction that stands upright on the surface; give one "
            "along it");
    return OSDTEX_OK;
}

otx_status
otx_constraint_pins(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    otx_direction_request *out)
{
    otx_direction_pin *pins;
    int32_t directions = 0, count = 0;

    if (!set)
        return OSDTEX_OK;
    for (int32_t i = 0; i < set->count; ++i)
    {
        OTX_TRY(check(run, set, c, i));
        directions += set->items[i].has_direction;
    }
    pins = OTX_NEW(
        run->arena, otx_direction_pin,
        (int64_t)directions * c->level->face_count);
    if (!pins)
        return otx_fail_memory(run, "field");
    for (int32_t i = 0; i < set->count; ++i)
        if (set->items[i].has_direction)
            OTX_TRY(pin_item(run, set, c, i, pins, &count));
    out->pins = pins;
    out->pin_count = count;
    out->guide = set->axis;
    out->guide_length = set->axis_length > 0.0
                            ? set->axis_length
                            : 0.05 * c->surface->cage->diagonal;
    if (set->symmetry > 0)
        out->symmetry = set->symmetry;
    return OSDTEX_OK;
}

otx_status
otx_constraint_scale(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    double *log_scale)
{
    const otx_level *level = c->level;
    otx_scale_lock *locks;
    double *values;
    int32_t scales = 0, count = 0;

    for (int32_t i = 0; set && i < set->count; ++i)
    {
        OTX_TRY(check(run, set, c, i));
        scales += set->items[i].scale > 0.0;
    }
    if (scales == 0)
        return OSDTEX_OK;
    locks = OTX_NEW(
        run->scratch, otx_scale_lock, (int64_t)scales * level->corner_count);
    values = OTX_ZNEW(run->scratch, double, level->vert_count);
    if (!locks || !values)
        return otx_fail_memory(run, "field");
    for (int32_t i = 0; i < set->count; ++i)
    {
        const otx_constraint *item = &set->items[i];
        const int32_t nearest =
            item->face < 0 ? nearest_face(c, item->point) : -1;

        for (int32_t f = 0; item->scale > 0.0 && f < level->face_count; ++f)
            for (int32_t k = level->face_first[f];
                 k < level->face_first[f + 1] && holds(c, item, nearest, f);
                 ++k)
                locks[count++] =
                    (otx_scale_lock){level->face_verts[k], -log(item->scale)};
    }
    OTX_TRY(otx_scale_smooth(
        run, c, locks, count, -log(SCALE_MAX), log(SCALE_MAX), 0.0, NULL,
        values));
    for (int32_t v = 0; v < level->vert_count; ++v)
        log_scale[v] += values[v];
    return OSDTEX_OK;
}

/* -- effect area --------------------------------------------------------- */

static bool
push_around(
    const otx_connection *c, otx_queue *queue, const uint8_t *effect,
    otx_queue_entry from, double radius)
{
    for (int32_t i = c->level->face_first[from.item];
         i < c->level->face_first[from.item + 1]; ++i)
    {
        const int32_t e = c->level->face_edges[i];
        const int32_t *faces = c->level->edge_faces + 2 * (size_t)e;
        const int32_t other = faces[faces[0] == from.item];
        double d;

        if (!c->inner[e] || effect[other])
            continue;
        d = from.key + otx_vec3_length(otx_vec3_sub(
                           c->centres[other], c->centres[from.item]));
        if (d <= radius && !otx_queue_push(queue, d, other))
            return false;
    }
    return true;
}

otx_status
otx_constraint_effect(
    otx_run *run, const otx_connection *c, const otx_constraint *constraint,
    double radius, uint8_t **out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_constraint_set set = {.count = 1, .items = constraint};
    uint8_t *effect = OTX_ZNEW(run->arena, uint8_t, c->level->face_count);
    otx_queue queue = otx_queue_make(run->scratch);
    otx_queue_entry entry;
    int32_t nearest;
    bool fine = effect != NULL;

    OTX_TRY(check(run, &set, c, 0));
    nearest = constraint->face < 0 ? nearest_face(c, constraint->point) : -1;
    for (int32_t f = 0; fine && f < c->level->face_count; ++f)
        if (holds(c, constraint, nearest, f))
            fine = otx_queue_push(&queue, 0.0, f);
    while (fine && otx_queue_pop(&queue, &entry))
    {
        if (effect[entry.item])
            continue;
        effect[entry.item] = 1;
        fine = push_around(c, &queue, effect, entry, radius);
    }
    otx_arena_release(run->scratch, mark);
    *out = effect;
    return fine ? OSDTEX_OK : otx_fail_memory(run, "field");
}
