/* settle.c -- periodic coordinates once their whole cells are known. */
#include "method/material/settle.h"

#include "base/pqueue.h"
#include "math/sparse.h"

#include <stdlib.h>

/* Weight of the edges of a face that is a defect: its strain is not to be
 * spread. */
static const double SOFT = 0.1;

/* Holds the free constant of a component; relative to the weights. */
static const double GROUND = 1e-7;

enum
{
    CANCEL_ROUNDS = 4
};

/* -- charges ------------------------------------------------------------- */

/* Whole cells that the steps around a face sum to. */
static int
charge_of(const otx_phase_solver *s, int32_t face, int axis)
{
    const otx_level *level = s->c->level;
    double sum = 0.0;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        sum += otx_phase_face_step(s, face, i, axis);
    return (int)lround(sum);
}

/* How a step along an edge counts in a face. */
static int
orientation(const otx_phase_solver *s, int32_t face, int32_t edge)
{
    return s->c->level->edge_faces[2 * (size_t)edge] == face
               ? 1
               : -s->phase->match[edge];
}

static bool
touches_singular(const otx_phase_solver *s, int32_t face)
{
    const otx_level *level = s->c->level;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        if (s->singular[level->face_verts[i]])
            return true;
    return false;
}

/* -- nearest opposite ---------------------------------------------------- */

/* A way along which a charge leaves its face. */
typedef struct escape
{
    double length;
    int32_t from, to; /* faces; to: -1 over a border */
    int32_t exit;     /* that border's edge */
    int charge;
} escape;

typedef struct search
{
    otx_phase_solver *s;
    int axis;
    int8_t *charge; /* [face_count]; of a face beside a singularity: 0 */
    uint8_t *sink;  /* [face_count] 1: beside a singularity */
    /* Of the search that runs: */
    double *length;
    int32_t *came; /* edge */
    int8_t *carried;
    int32_t *touched;
    int32_t touched_count;
    otx_pqueue queue;
} search;

static int32_t
across(const otx_connection *c, int32_t edge, int32_t face)
{
    const int32_t *faces = c->level->edge_faces + 2 * (size_t)edge;

    return faces[faces[0] == face];
}

static bool
visit(search *q, int32_t face, double length, int32_t edge, int carried)
{
    if (!(length < q->length[face]))
        return true;
    if (q->length[face] == INFINITY)
        q->touched[q->touched_count++] = face;
    q->length[face] = length;
    q->came[face] = edge;
    q->carried[face] = (int8_t)carried;
    return otx_pqueue_push(&q->queue, length, face);
}

static void
forget(search *q)
{
    for (int32_t i = 0; i < q->touched_count; ++i)
        q->length[q->touched[i]] = INFINITY;
    q->touched_count = 0;
    q->queue.count = 0;
}

/* Whether a charge that has come as far as `face` may end there. */
static bool
ends(const search *q, int32_t face, escape *out)
{
    const otx_level *level = q->s->c->level;

    if (face != out->from &&
        (q->sink[face] || q->charge[face] * q->carried[face] < 0))
    {
        out->to = face;
        return true;
    }
    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        if (!q->s->c->inner[level->face_edges[i]])
        {
            out->to = face;
            out->exit = level->face_edges[i];
            return true;
        }
    return false;
}

/* The nearest end within reach for a charge; false when memory is out. */
static bool
find_escape(search *q, int32_t face, escape *out)
{
    const otx_connection *c = q->s->c;
    otx_pqueue_entry entry;
    bool fine;

    forget(q);
    *out = (escape){INFINITY, face, -1, -1, q->charge[face]};
    fine = visit(q, face, 0.0, -1, q->charge[face]);
    while (fine && otx_pqueue_pop(&q->queue, &entry))
    {
        const int32_t at = entry.item;

        if (entry.key > q->length[at])
            continue;
        if (ends(q, at, out))
        {
            out->length = entry.key;
            return true;
        }
        for (int32_t i = c->level->face_first[at];
             fine && i < c->level->face_first[at + 1]; ++i)
        {
            const int32_t edge = c->level->face_edges[i];
            const int32_t next = across(c, edge, at);
            const double length =
                entry.key +
                otx_vec3_length(otx_vec3_sub(c->centres[next], c->centres[at]));

            if (length <= q->s->request->cancel)
                fine = visit(
                    q, next, length, edge,
                    -q->carried[at] * orientation(q->s, at, edge) *
                        orientation(q->s, next, edge));
        }
    }
    return fine;
}

/* -- moving charges ------------------------------------------------------ */

static int
by_length(const void *a, const void *b)
{
    const escape *p = a, *q = b;

    return p->length < q->length   ? -1
           : p->length > q->length ? 1
           : p->from < q->from     ? -1
                                   : p->from > q->from;
}

/* Moves one unit along the way that was just found, back from its end. */
static void
move(search *q, const escape *e)
{
    const int sign = e->charge > 0 ? 1 : -1;
    int32_t face = e->to;

    if (e->exit >= 0)
        q->s->step[q->axis][e->exit] -=
            (q->carried[face] > 0 ? 1 : -1) * orientation(q->s, face, e->exit);
    else if (!q->sink[face])
        q->charge[face] =
            (int8_t)(q->charge[face] + (q->carried[face] > 0 ? 1 : -1));
    while (face != e->from)
    {
        const int32_t edge = q->came[face];
        const int32_t before = across(q->s->c, edge, face);

        q->s->step[q->axis][edge] -=
            (q->carried[before] > 0 ? 1 : -1) * orientation(q->s, before, edge);
        face = before;
    }
    q->charge[e->from] = (int8_t)(q->charge[e->from] - sign);
    ++q->s->phase->cancelled;
}

/* Finds all escapes, and takes the shortest first. */
static otx_status
cancel_round(search *q, escape *list, bool *moved)
{
    const int32_t faces = q->s->c->level->face_count;
    int32_t count = 0;

    *moved = false;
    for (int32_t f = 0; f < faces; ++f)
        if (q->charge[f] != 0)
        {
            if (!find_escape(q, f, &list[count]))
                return otx_fail_memory(q->s->run, "field");
            count += isfinite(list[count].length);
        }
    qsort(list, (size_t)count, sizeof *list, by_length);
    for (int32_t i = 0; i < count; ++i)
    {
        escape now;

        /* What was moved since may have taken the opposite away. */
        if (q->charge[list[i].from] != list[i].charge)
            continue;
        if (!find_escape(q, list[i].from, &now))
            return otx_fail_memory(q->s->run, "field");
        if (now.length > list[i].length)
            continue;
        move(q, &now);
        *moved = true;
    }
    return OSDTEX_OK;
}

static otx_status
cancel_axis(search *q)
{
    const int32_t faces = q->s->c->level->face_count;
    int32_t charged = 0;
    escape *list;
    bool moved = true;

    for (int32_t f = 0; f < faces; ++f)
    {
        q->length[f] = INFINITY;
        q->sink[f] = touches_singular(q->s, f);
        q->charge[f] = 0;
        if (!q->s->c->level->face_hole[f] && !q->sink[f])
            q->charge[f] = (int8_t)charge_of(q->s, f, q->axis);
        charged += q->charge[f] != 0;
    }
    list = OTX_NEW(q->s->run->scratch, escape, charged + 1);
    if (!list)
        return otx_fail_memory(q->s->run, "field");
    for (int round = 0; moved && round < CANCEL_ROUNDS; ++round)
        OTX_TRY(cancel_round(q, list, &moved));
    return OSDTEX_OK;
}

otx_status
otx_settle_cancel(otx_phase_solver *s)
{
    otx_arena *scratch = s->run->scratch;
    const otx_arena_mark mark = otx_arena_here(scratch);
    const int32_t faces = s->c->level->face_count;
    search q = {
        .s = s,
        .charge = OTX_NEW(scratch, int8_t, faces),
        .sink = OTX_NEW(scratch, uint8_t, faces),
        .length = OTX_NEW(scratch, double, faces),
        .came = OTX_NEW(scratch, int32_t, faces),
        .carried = OTX_NEW(scratch, int8_t, faces),
        .touched = OTX_NEW(scratch, int32_t, faces),
        .queue = otx_pqueue_make(scratch)};

    if (!q.charge || !q.sink || !q.length || !q.came || !q.carried ||
        !q.touched)
        return otx_fail_memory(s->run, "field");
    for (q.axis = 0; q.axis < 2; ++q.axis)
        OTX_TRY(cancel_axis(&q));
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

/* -- least squares ------------------------------------------------------- */

/* An edge between two vertices, whose turns count by `sense`. */
typedef struct spring
{
    int32_t v[2];
    int sense[2];
    double weight;
} spring;

static bool
is_defect(const otx_phase_solver *s, int32_t face)
{
    return touches_singular(s, face) || charge_of(s, face, 0) != 0 ||
           charge_of(s, face, 1) != 0;
}

static spring
spring_of(const otx_phase_solver *s, const uint8_t *soft, int32_t edge)
{
    const int32_t *faces = s->c->level->edge_faces + 2 * (size_t)edge;
    spring out;
    int32_t at[2];

    otx_phase_edge_corners(s->c, edge, at);
    for (int k = 0; k < 2; ++k)
    {
        out.v[k] = s->c->level->face_verts[at[k]];
        out.sense[k] = s->sense[at[k]];
    }
    out.weight = otx_phase_edge_weight(s->c, edge);
    if (soft[faces[0]] || (faces[1] >= 0 && soft[faces[1]]))
        out.weight *= SOFT;
    return out;
}

/* Both coordinates have the same matrix. */
static otx_status
factor(const otx_phase_solver *s, const uint8_t *soft, otx_sparse **out)
{
    const otx_level *level = s->c->level;
    const int64_t edges = level->edge_count;
    otx_arena *scratch = s->run->scratch;
    otx_sparse_entry *entries =
        OTX_NEW(scratch, otx_sparse_entry, 3 * edges + level->vert_count);
    otx_vec3 *places = OTX_NEW(scratch, otx_vec3, level->vert_count);
    int64_t count = 0;

    if (!entries || !places)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t e = 0; e < edges; ++e)
    {
        const spring p = spring_of(s, soft, e);
        const bool down = p.v[1] > p.v[0];

        for (int k = 0; k < 2; ++k)
            entries[count++] =
                (otx_sparse_entry){p.v[k], p.v[k], p.weight, 0.0};
        entries[count++] = (otx_sparse_entry){
            p.v[down], p.v[!down], -p.weight * p.sense[0] * p.sense[1], 0.0};
    }
    for (int32_t v = 0; v < level->vert_count; ++v)
    {
        entries[count++] = (otx_sparse_entry){v, v, GROUND, 0.0};
        places[v] = otx_vec3_load(s->c->surface->points, v);
    }
    return otx_sparse_factor(
        scratch, OTX_SPARSE_REAL, level->vert_count, places, entries, count,
        out);
}

static otx_status
solve_turns(
    otx_phase_solver *s, const uint8_t *soft, otx_sparse *lhs, double *x,
    int axis)
{
    const otx_level *level = s->c->level;
    double *turn = s->turn[axis], *step = s->step[axis];

    for (int32_t v = 0; v < level->vert_count; ++v)
        x[v] = GROUND * turn[v];
    /* Steps become whole cells while the turns change. */
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const spring p = spring_of(s, soft, e);

        step[e] = round(
            step[e] - (p.sense[1] * turn[p.v[1]] - p.sense[0] * turn[p.v[0]]));
        for (int k = 0; k < 2; ++k)
            x[p.v[k]] += (k == 0 ? -1.0 : 1.0) * p.sense[k] * p.weight *
                         (s->wish[axis][e] - step[e]);
    }
    OTX_TRY(otx_sparse_solve(lhs, x, turn));
    for (int32_t e = 0; e < level->edge_count; ++e)
    {
        const spring p = spring_of(s, soft, e);

        step[e] += p.sense[1] * turn[p.v[1]] - p.sense[0] * turn[p.v[0]];
    }
    return OSDTEX_OK;
}

static otx_status
settle(otx_phase_solver *s)
{
    const otx_level *level = s->c->level;
    uint8_t *soft = OTX_ZNEW(s->run->scratch, uint8_t, level->face_count);
    double *x = OTX_NEW(s->run->scratch, double, level->vert_count);
    otx_sparse *lhs;

    if (!soft || !x)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t f = 0; f < level->face_count; ++f)
        soft[f] = !level->face_hole[f] && is_defect(s, f);
    OTX_TRY(factor(s, soft, &lhs));
    for (int axis = 0; axis < 2; ++axis)
        OTX_TRY(solve_turns(s, soft, lhs, x, axis));
    return OSDTEX_OK;
}

otx_status
otx_settle_solve(otx_phase_solver *s)
{
    const otx_arena_mark mark = otx_arena_here(s->run->scratch);
    const otx_status status = settle(s);

    otx_arena_release(s->run->scratch, mark);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(s->run, "field");
    if (status != OSDTEX_OK)
        return otx_fail(
            s->run, status, "field", OTX_NOWHERE,
            "the periodic coordinates cannot be settled: the surface has "
            "positions that are not finite");
    return OSDTEX_OK;
}
