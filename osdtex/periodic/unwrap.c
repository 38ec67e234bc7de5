/* unwrap.c -- cells that are equal across edges, not only up to whole cells.
 */
#include "periodic/unwrap.h"

#include "base/pqueue.h"

/* -- distance ------------------------------------------------------------ */

static void
reach(
    const otx_connection *c, otx_pqueue *queue, double *distance, int32_t face)
{
    for (int32_t i = c->level->face_first[face];
         i < c->level->face_first[face + 1]; ++i)
    {
        const int32_t edge = c->level->face_edges[i];
        const int32_t *faces = c->level->edge_faces + 2 * (size_t)edge;
        const int32_t other = faces[faces[0] == face];
        double d;

        if (!c->inner[edge])
            continue;
        d = distance[face] +
            otx_vec3_length(otx_vec3_sub(c->centres[other], c->centres[face]));
        if (!(d < distance[other]))
            continue;
        distance[other] = d;
        otx_pqueue_push(queue, d, other);
    }
}

otx_status
otx_phase_distance(
    otx_run *run, const otx_connection *c, const uint8_t *marked, double **out)
{
    double *distance = OTX_NEW(run->arena, double, c->level->face_count);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_pqueue queue = otx_pqueue_make(run->scratch);
    otx_pqueue_entry entry;
    otx_status status;

    *out = distance;
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < c->level->face_count; ++f)
    {
        distance[f] = marked[f] ? 0.0 : INFINITY;
        if (marked[f])
            otx_pqueue_push(&queue, 0.0, f);
    }
    while (otx_pqueue_pop(&queue, &entry))
        if (entry.key <= distance[entry.item])
            reach(c, &queue, distance, entry.item);
    status = otx_run_ok(run);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* -- whole cells --------------------------------------------------------- */

typedef struct walk
{
    otx_phase *phase;
    const double *distance;
    int8_t *flip; /* [face_count] 0 not visited, else the face's sense */
    otx_pqueue queue;
} walk;

/* Of the visited neighbours the one farthest from a defect, and the edge to
 * it; -1 none. */
static int32_t
best_neighbour(const walk *w, int32_t face, int32_t *edge)
{
    const otx_connection *c = w->phase->connection;
    int32_t best = -1;

    for (int32_t i = c->level->face_first[face];
         i < c->level->face_first[face + 1]; ++i)
    {
        const int32_t e = c->level->face_edges[i];
        const int32_t *faces = c->level->edge_faces + 2 * (size_t)e;
        const int32_t other = faces[faces[0] == face];

        if (!c->inner[e] || w->flip[other] == 0 ||
            (best >= 0 && !(w->distance[other] > w->distance[best])))
            continue;
        best = other;
        *edge = e;
    }
    return best;
}

/* Gives `face` the sense and the whole cells of its neighbour `from`. */
static void
agree(walk *w, int32_t face, int32_t from, int32_t edge)
{
    const otx_connection *c = w->phase->connection;
    const otx_level *level = c->level;
    otx_vec2 *cells = w->phase->cells;
    const int32_t vertex = level->edge_verts[2 * (size_t)edge];
    const int sense = w->flip[from] * w->phase->match[edge];
    int32_t here = level->face_first[face], there = level->face_first[from];
    otx_vec2 shift;

    while (level->face_verts[here] != vertex)
        ++here;
    while (level->face_verts[there] != vertex)
        ++there;
    shift = otx_vec2_sub(cells[there], otx_vec2_scale(sense, cells[here]));
    shift = (otx_vec2){round(shift.x), round(shift.y)};
    w->flip[face] = (int8_t)sense;
    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        cells[i] = otx_vec2_add(otx_vec2_scale(sense, cells[i]), shift);
}

static void
push_neighbours(walk *w, int32_t face)
{
    const otx_connection *c = w->phase->connection;

    for (int32_t i = c->level->face_first[face];
         i < c->level->face_first[face + 1]; ++i)
    {
        const int32_t e = c->level->face_edges[i];
        const int32_t *faces = c->level->edge_faces + 2 * (size_t)e;
        const int32_t other = faces[faces[0] == face];

        if (c->inner[e] && w->flip[other] == 0)
            otx_pqueue_push(&w->queue, -w->distance[other], other);
    }
}

/* Visits a component, beginning at `face`. */
static void
visit_all(walk *w, int32_t face)
{
    otx_pqueue_entry entry = {0.0, face};

    do
    {
        int32_t edge = -1;
        int32_t from;

        if (w->flip[entry.item] != 0)
            continue;
        from = best_neighbour(w, entry.item, &edge);
        if (from >= 0)
            agree(w, entry.item, from, edge);
        else
            w->flip[entry.item] = 1;
        push_neighbours(w, entry.item);
    } while (otx_pqueue_pop(&w->queue, &entry));
}

otx_status
otx_phase_unwrap(otx_run *run, otx_phase *phase, const double *distance)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = phase->connection->level->face_count;
    walk w = {
        phase, distance, OTX_ZNEW(run->arena, int8_t, count),
        otx_pqueue_make(run->scratch)};
    otx_pqueue seeds = otx_pqueue_make(run->scratch);
    otx_pqueue_entry entry;
    otx_status status;

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < count; ++f)
        otx_pqueue_push(&seeds, -distance[f], f);
    while (otx_pqueue_pop(&seeds, &entry))
        if (w.flip[entry.item] == 0)
            visit_all(&w, entry.item);
    phase->sense = w.flip;
    status = otx_run_ok(run);
    otx_arena_release(run->scratch, mark);
    return status;
}
