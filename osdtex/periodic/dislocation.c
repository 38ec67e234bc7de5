/* dislocation.c -- dislocations that meet their opposite and vanish. */
#include "periodic/dislocation.h"

#include "base/pqueue.h"

#include <stdlib.h>

enum
{
    CANCEL_ROUNDS = 4
};

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

static void
visit(search *q, int32_t face, double length, int32_t edge, int carried)
{
    if (!(length < q->length[face]))
        return;
    if (q->length[face] == INFINITY)
        q->touched[q->touched_count++] = face;
    q->length[face] = length;
    q->came[face] = edge;
    q->carried[face] = (int8_t)carried;
    otx_pqueue_push(&q->queue, length, face);
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

/* The nearest end within reach for a charge. */
static otx_status
find_escape(search *q, int32_t face, escape *out)
{
    const otx_connection *c = q->s->c;
    otx_pqueue_entry entry;

    forget(q);
    *out = (escape){INFINITY, face, -1, -1, q->charge[face]};
    visit(q, face, 0.0, -1, q->charge[face]);
    while (otx_pqueue_pop(&q->queue, &entry))
    {
        const int32_t at = entry.item;

        if (entry.key > q->length[at])
            continue;
        if (ends(q, at, out))
        {
            out->length = entry.key;
            break;
        }
        for (int32_t i = c->level->face_first[at];
             i < c->level->face_first[at + 1]; ++i)
        {
            const int32_t edge = c->level->face_edges[i];
            const int32_t next = across(c, edge, at);
            const double length =
                entry.key +
                otx_vec3_length(otx_vec3_sub(c->centres[next], c->centres[at]));

            if (length <= q->s->request->cancel)
                visit(
                    q, next, length, edge,
                    -q->carried[at] * otx_phase_orientation(q->s, at, edge) *
                        otx_phase_orientation(q->s, next, edge));
        }
    }
    return otx_run_ok(q->s->run);
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
            (q->carried[face] > 0 ? 1 : -1) *
            otx_phase_orientation(q->s, face, e->exit);
    else if (!q->sink[face])
        q->charge[face] =
            (int8_t)(q->charge[face] + (q->carried[face] > 0 ? 1 : -1));
    while (face != e->from)
    {
        const int32_t edge = q->came[face];
        const int32_t before = across(q->s->c, edge, face);

        q->s->step[q->axis][edge] -= (q->carried[before] > 0 ? 1 : -1) *
                                     otx_phase_orientation(q->s, before, edge);
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
            OTX_TRY(find_escape(q, f, &list[count]));
            count += isfinite(list[count].length);
        }
    qsort(list, (size_t)count, sizeof *list, by_length);
    for (int32_t i = 0; i < count; ++i)
    {
        escape now;

        /* What was moved since may have taken the opposite away. */
        if (q->charge[list[i].from] != list[i].charge)
            continue;
        OTX_TRY(find_escape(q, list[i].from, &now));
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
        q->sink[f] = otx_phase_touches_singular(q->s, f);
        q->charge[f] = 0;
        if (!q->s->c->level->face_hole[f] && !q->sink[f])
            q->charge[f] = (int8_t)otx_phase_charge(q->s, f, q->axis);
        charged += q->charge[f] != 0;
    }
    list = OTX_NEW(q->s->run->scratch, escape, charged + 1);
    OTX_TRY(otx_run_ok(q->s->run));
    for (int round = 0; moved && round < CANCEL_ROUNDS; ++round)
        OTX_TRY(cancel_round(q, list, &moved));
    return OSDTEX_OK;
}

otx_status
otx_dislocation_cancel(otx_phase_solver *s)
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

    OTX_TRY(otx_run_ok(s->run));
    for (q.axis = 0; q.axis < 2; ++q.axis)
        OTX_TRY(cancel_axis(&q));
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}
