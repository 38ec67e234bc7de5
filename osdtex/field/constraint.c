/* constraint.c -- what the artist asks of the fields on a surface. */
#include "field/constraint.h"

#include "base/pqueue.h"
#include "field/attract.h"
#include "field/nested.h"

/* Largest factor on the texture's size, either way. */
static const double SCALE_MAX = 16.0;

/* A unit direction whose part along a face is shorter says nothing there. */
static const double UPRIGHT = 0.05;

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

otx_status
otx_constraint_check(
    otx_run *run, const otx_constraint_set *set, const otx_cage *cage,
    int32_t index)
{
    const otx_constraint *item = &set->items[index];

    if (item->face >= cage->face_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field",
            (otx_where){set->path, 0, item->face, -1},
            "constraint %d names a face that the cage lacks, which has %d",
            (int)index + 1, (int)cage->face_count);
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
    if (item->has_material && !(item->material >= 0.0 && item->material <= 1.0))
        return refuse(run, set, index, "has a material outside 0 .. 1");
    if (!(item->reach >= 0.0) || isinf(item->reach) || item->edit < 0 ||
        item->redo < 0)
        return refuse(
            run, set, index,
            "has a reach, an edit or a redo that is negative or not finite");
    return OSDTEX_OK;
}

static otx_status
check(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    int32_t index)
{
    return otx_constraint_check(run, set, c->surface->cage, index);
}

otx_status
otx_constraint_check_table(
    otx_run *run, const otx_constraint_set *set, int32_t face_count)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    uint8_t *seen;
    int32_t count = 0;

    if (!set->is_table)
        return OSDTEX_OK;
    seen = OTX_ZNEW(run->scratch, uint8_t, face_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < set->count; ++i)
    {
        const int32_t face = set->items[i].face;

        if (face < face_count && !seen[face])
        {
            seen[face] = 1;
            ++count;
        }
    }
    otx_arena_release(run->scratch, mark);
    if (count == face_count && set->count == face_count)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "field", otx_where_file(set->path),
        "the table has %d lines, but the mesh has %d faces, and each needs "
        "one; a field that is written at the level of the mesh has them",
        (int)set->count, (int)face_count);
}

/* Constraints are given in the scene, surfaces are kept relative to an
 * origin. */
static otx_vec3
place_of(const otx_connection *c, const otx_constraint *item)
{
    const double *origin = c->surface->cage->origin;

    return otx_vec3_sub(
        item->point, (otx_vec3){origin[0], origin[1], origin[2]});
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

/* The faces that a constraint may hold: those of [first, end) that hold_face
 * confirms. */
typedef struct grip
{
    const otx_constraint *item;
    int32_t first, end;
    int32_t nearest; /* to a point; -1 */
} grip;

static grip
take_hold(const otx_connection *c, const otx_constraint *item)
{
    const otx_level *levels = c->surface->levels;
    grip g = {item, item->face, item->face + 1, -1};

    if (item->face < 0)
        return (grip){
            item, 0, c->level->face_count, nearest_face(c, place_of(c, item))};
    /* Children are contiguous, and so are all descendants. */
    for (int32_t l = 0; l < c->level_index; ++l)
    {
        g.first = levels[l].face_child_first[g.first];
        g.end = levels[l].face_child_first[g.end];
    }
    return g;
}

static bool
holds(const otx_connection *c, const grip *g, int32_t face)
{
    if (c->level->face_hole[face])
        return false;
    if (g->item->face >= 0 || face == g->nearest)
        return true;
    return otx_vec3_length(otx_vec3_sub(
               c->centres[face], place_of(c, g->item))) <= g->item->radius;
}

static int32_t
count_held(const otx_connection *c, const grip *g)
{
    int32_t count = 0;

    for (int32_t f = g->first; f < g->end; ++f)
        count += holds(c, g, f);
    return count;
}

/* -- directions ---------------------------------------------------------- */

typedef struct pinning
{
    otx_run *run;
    const otx_constraint_set *set;
    const otx_connection *c;
    int32_t symmetry;
    const uint8_t *effect; /* [face_count] 1 looked at; NULL all */
    int32_t *owner; /* [face_count] constraint that holds a face, -1 none */
    otx_direction_pin *pins;
    int32_t count;
} pinning;

/* Says so where two constraints want different things of one face. */
static void
compare_pins(const pinning *p, int32_t index, int32_t face)
{
    const int32_t other = p->owner[face];
    otx_vec2 z[2];

    if (other < 0 || other == index)
        return;
    for (int k = 0; k < 2; ++k)
        z[k] = otx_direction_power(
            otx_connection_project(
                p->c, face,
                otx_vec3_unit(p->set->items[k ? index : other].direction)),
            p->symmetry);
    if (otx_vec2_dot(z[0], z[1]) <
        0.98 * otx_vec2_length(z[0]) * otx_vec2_length(z[1]))
        otx_note(
            p->run, OSDTEX_SEVERITY_WARNING, "field",
            (otx_where){p->set->path, 0, p->c->level->face_cage[face], -1},
            "constraint %d contradicts constraint %d; the later one holds",
            (int)index + 1, (int)other + 1);
}

/* Pins the faces of one constraint; those on which its direction stands
 * upright are left out, unless all are. */
static otx_status
pin_item(pinning *p, int32_t index)
{
    const otx_constraint *item = &p->set->items[index];
    const grip g = take_hold(p->c, item);
    const int32_t before = p->count;
    bool any = false;

    for (int32_t f = g.first; f < g.end; ++f)
    {
        if ((p->effect && !p->effect[f]) || !holds(p->c, &g, f))
            continue;
        any = true;
        if (!(otx_vec2_length(otx_connection_project(
                  p->c, f, otx_vec3_unit(item->direction))) > UPRIGHT))
            continue;
        compare_pins(p, index, f);
        p->owner[f] = index;
        p->pins[p->count++] = (otx_direction_pin){f, item->direction};
    }
    if (any && p->count == before)
        return refuse(
            p->run, p->set, index,
            "has a direction that stands upright on the surface; give one "
            "along it");
    return OSDTEX_OK;
}

/* Sums up, for each face of the level, the field of the leaves below it. */
static void
gather_field(const pinning *p, otx_vec2 *sums)
{
    const otx_surface *surface = p->c->surface;
    const int32_t last = surface->level_count - 1;

    for (int32_t f = 0; f < surface->levels[last].face_count; ++f)
    {
        const otx_vec3 d = p->set->field.directions[f];
        int32_t face = f;

        for (int32_t l = last; l > p->c->level_index; --l)
            face = surface->levels[l].face_parent[face];
        if (!(otx_vec3_length(d) > 0.0) || p->c->level->face_hole[face])
            continue;
        sums[face] = otx_vec2_add(
            sums[face],
            otx_direction_power(
                otx_connection_project(p->c, face, otx_vec3_unit(d)),
                p->symmetry));
    }
}

/* Pins the faces of which the field says something. */
static otx_status
pin_field(pinning *p)
{
    const int32_t faces = p->c->level->face_count;
    const otx_arena_mark mark = otx_arena_here(p->run->scratch);
    otx_vec2 *sums;

    if (!p->set->field.directions)
        return OSDTEX_OK;
    sums = OTX_ZNEW(p->run->scratch, otx_vec2, faces);
    OTX_TRY(otx_run_ok(p->run));
    gather_field(p, sums);
    for (int32_t f = 0; f < faces; ++f)
        if ((!p->effect || p->effect[f]) && otx_vec2_length(sums[f]) > UPRIGHT)
            p->pins[p->count++] = (otx_direction_pin){
                f,
                otx_connection_lift(
                    p->c, f,
                    otx_vec2_polar(atan2(sums[f].y, sums[f].x) / p->symmetry))};
    otx_arena_release(p->run->scratch, mark);
    return OSDTEX_OK;
}

static otx_status
pin_all(pinning *p)
{
    const int32_t faces = p->c->level->face_count;
    int64_t count = p->set->field.directions ? faces : 0;

    for (int32_t i = 0; i < p->set->count; ++i)
    {
        grip g;

        OTX_TRY(check(p->run, p->set, p->c, i));
        if (!p->set->items[i].has_direction)
            continue;
        g = take_hold(p->c, &p->set->items[i]);
        count += count_held(p->c, &g);
    }
    if (count > INT32_MAX)
        return otx_fail(
            p->run, OSDTEX_ERROR_LIMIT, "field", otx_where_file(p->set->path),
            "the constraints hold too many faces; give fewer points or smaller "
            "radii");
    p->pins = OTX_NEW(p->run->arena, otx_direction_pin, count);
    p->owner = OTX_NEW(p->run->arena, int32_t, faces);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < faces; ++f)
        p->owner[f] = -1;
    OTX_TRY(pin_field(p));
    for (int32_t i = 0; i < p->set->count; ++i)
        if (p->set->items[i].has_direction)
            OTX_TRY(pin_item(p, i));
    return OSDTEX_OK;
}

/* What attracts the whole field. Edges and curvature have several ways: that
 * nearest to the field without them is taken. */
static otx_status
attract(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    otx_direction_request *q)
{
    const bool needs_near =
        (set->follow == OTX_FOLLOW_EDGES && q->symmetry != 4) ||
        (set->follow == OTX_FOLLOW_CURVATURE && q->symmetry == 1);
    otx_direction near;
    otx_vec2 *pull = NULL;

    if (needs_near)
        OTX_TRY(otx_nested_solve(run, c, q, &near));
    if (set->follow == OTX_FOLLOW_AXIS)
        OTX_TRY(otx_attract_axis(run, c, q->symmetry, set->axis, &pull));
    if (set->follow == OTX_FOLLOW_EDGES)
        OTX_TRY(otx_attract_edges(
            run, c, q->symmetry, needs_near ? &near : NULL, &pull));
    if (set->follow == OTX_FOLLOW_CURVATURE)
        OTX_TRY(otx_attract_curvature(
            run, c, q->symmetry, needs_near ? &near : NULL, &pull));
    q->pull = pull;
    q->pull_length = set->follow_length > 0.0
                         ? set->follow_length
                         : 0.05 * c->surface->cage->diagonal;
    return OSDTEX_OK;
}

otx_status
otx_constraint_hold(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    const uint8_t *effect, otx_direction_request *out)
{
    pinning p = {
        .run = run,
        .set = set,
        .c = c,
        .symmetry = out->symmetry,
        .effect = effect};

    OTX_TRY(pin_all(&p));
    out->pins = p.pins;
    out->pin_count = p.count;
    return OSDTEX_OK;
}

otx_status
otx_constraint_pins(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    otx_direction_request *out)
{
    if (!set)
        return OSDTEX_OK;
    if (set->symmetry > 0)
        out->symmetry = set->symmetry;
    if (set->follow == OTX_FOLLOW_AXIS &&
        (!is_finite(set->axis) || !(otx_vec3_length(set->axis) > 0.0)))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", otx_where_file(set->path),
            "the axis to follow is zero or not finite");
    OTX_TRY(otx_constraint_hold(run, set, c, NULL, out));
    return attract(run, set, c, out);
}

/* -- scale and material -------------------------------------------------- */

/* What a constraint locks of a scalar field; false: nothing. */
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

/* Locks of all vertices of the faces that are held. */
static otx_status
lock_values(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    otx_constraint_kind kind, otx_scale_lock **out, int32_t *count)
{
    const otx_level *level = c->level;
    int64_t capacity = 0;
    double v;

    *count = 0;
    for (int32_t i = 0; i < set->count; ++i)
    {
        OTX_TRY(check(run, set, c, i));
        if (value_of(&set->items[i], kind, &v))
        {
            const grip g = take_hold(c, &set->items[i]);

            for (int32_t f = g.first; f < g.end; ++f)
                if (holds(c, &g, f))
                    capacity += otx_level_face_size(level, f);
        }
    }
    if (capacity > INT32_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, "field", otx_where_file(set->path),
            "the constraints hold too many vertices; give fewer points or "
            "smaller radii");
    *out = OTX_NEW(run->scratch, otx_scale_lock, capacity);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < set->count; ++i)
    {
        if (!value_of(&set->items[i], kind, &v))
            continue;

        const grip g = take_hold(c, &set->items[i]);

        for (int32_t f = g.first; f < g.end; ++f)
            for (int32_t k = level->face_first[f];
                 holds(c, &g, f) && k < level->face_first[f + 1]; ++k)
                (*out)[(*count)++] = (otx_scale_lock){level->face_verts[k], v};
    }
    return OSDTEX_OK;
}

/* Those of the field, whose vertices are numbered as all levels' are. */
static void
take_scales(
    const otx_constraint_set *set, const otx_connection *c,
    const uint8_t *effect, double *values)
{
    for (int32_t v = 0; v < c->level->vert_count; ++v)
        if (!effect || effect[v])
            values[v] = set->field.log_scale[v];
}

otx_status
otx_constraint_interpolate(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    otx_constraint_kind kind, const uint8_t *effect, double *values)
{
    const double most = kind == OTX_CONSTRAINT_SCALE ? log(SCALE_MAX) : 1.0;
    const double least = kind == OTX_CONSTRAINT_SCALE ? -most : 0.0;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_scale_lock *locks;
    int32_t count;

    if (kind == OTX_CONSTRAINT_SCALE && set->field.log_scale)
    {
        take_scales(set, c, effect, values);
        return OSDTEX_OK;
    }
    OTX_TRY(lock_values(run, set, c, kind, &locks, &count));
    if (count > 0)
        OTX_TRY(otx_scale_smooth(
            run, c, locks, count, least, most, 0.0, effect, values));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_constraint_scale(
    otx_run *run, const otx_constraint_set *set, const otx_connection *c,
    double *log_scale)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = c->level->vert_count;
    double *values;

    if (!set)
        return OSDTEX_OK;
    values = OTX_ZNEW(run->scratch, double, count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_constraint_interpolate(
        run, set, c, OTX_CONSTRAINT_SCALE, NULL, values));
    for (int32_t v = 0; v < count; ++v)
        log_scale[v] += values[v];
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* -- effect area --------------------------------------------------------- */

static void
push_around(
    const otx_connection *c, otx_pqueue *queue, const uint8_t *effect,
    otx_pqueue_entry from, double radius)
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
        if (d <= radius)
            otx_pqueue_push(queue, d, other);
    }
}

otx_status
otx_constraint_effect(
    otx_run *run, const otx_connection *c, const otx_constraint *constraint,
    double radius, uint8_t **out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_constraint_set set = {.count = 1, .items = constraint};
    uint8_t *effect = OTX_ZNEW(run->arena, uint8_t, c->level->face_count);
    otx_pqueue queue = otx_pqueue_make(run->scratch);
    otx_pqueue_entry entry;
    otx_status status;
    grip g;

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(check(run, &set, c, 0));
    g = take_hold(c, constraint);
    for (int32_t f = g.first; f < g.end; ++f)
        if (holds(c, &g, f))
            otx_pqueue_push(&queue, 0.0, f);
    while (otx_pqueue_pop(&queue, &entry))
    {
        if (effect[entry.item])
            continue;
        effect[entry.item] = 1;
        push_around(c, &queue, effect, entry, radius);
    }
    status = otx_run_ok(run);
    otx_arena_release(run->scratch, mark);
    *out = effect;
    return status;
}
