/* strips.c -- the courses on a surface, one by one. */
#include "method/material/strips.h"

#include "base/csr.h"
#include "base/pqueue.h"
#include "mapping/seam.h"

#include <stdlib.h>

/* Coordinates closer than this to the same, or to whole courses, are so. */
static const double SAME = 1e-4;

/* -- faces --------------------------------------------------------------- */

static bool
is_used(const otx_strips *s, int32_t face)
{
    return !s->m->laid.open[face] && !s->leaf.level->face_hole[face];
}

/* Least squares over the sides; zero where there is none. */
static otx_vec2
rise_of(const otx_strips *s, int32_t face)
{
    const otx_level *leaf = s->leaf.level;
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    double xx = 0.0, xy = 0.0, yy = 0.0, det;
    otx_vec2 b = {0, 0};

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec2 d = s->leaf.sides[first + k];
        const double t = s->m->laid.cells[first + (k + 1) % size].y -
                         s->m->laid.cells[first + k].y;

        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        b = otx_vec2_add(b, otx_vec2_scale(t, d));
    }
    det = xx * yy - xy * xy;
    if (!(det > 1e-12 * (xx + yy) * (xx + yy)))
        return (otx_vec2){0, 0};
    return (otx_vec2){(yy * b.x - xy * b.y) / det, (xx * b.y - xy * b.x) / det};
}

static void
measure_face(otx_strips *s, int32_t face)
{
    const otx_level *leaf = s->leaf.level;
    double sum = 0.0;

    s->of[face] = -1;
    s->sense[face] = 1;
    s->rise[face] = is_used(s, face) ? rise_of(s, face) : (otx_vec2){0, 0};
    for (int32_t i = leaf->face_first[face]; i < leaf->face_first[face + 1];
         ++i)
        sum += s->m->laid.cells[i].y;
    s->course[face] = (int32_t)floor(sum / otx_level_face_size(leaf, face));
    if (!(otx_vec2_length(s->rise[face]) > 0.0))
        s->m->laid.open[face] = !leaf->face_hole[face];
}

/* -- edges --------------------------------------------------------------- */

static int8_t
relate(const otx_strips *s, int32_t edge)
{
    const otx_level *leaf = s->leaf.level;
    const int32_t *f = leaf->edge_faces + 2 * (size_t)edge;
    int32_t corners[2][2], away;
    double d[2];
    int sense;

    if (!s->leaf.inner[edge] || !is_used(s, f[0]) || !is_used(s, f[1]))
        return 0;
    sense =
        otx_vec2_dot(
            otx_vec2_mul(otx_vec2_polar(s->leaf.turns[edge]), s->rise[f[0]]),
            s->rise[f[1]]) < 0.0
            ? -1
            : 1;
    for (int i = 0; i < 2; ++i)
        otx_seam_corners(leaf, edge, f[i], corners[i]);
    for (int k = 0; k < 2; ++k)
        d[k] = s->m->laid.cells[corners[1][k]].y -
               sense * s->m->laid.cells[corners[0][k]].y;
    if (fabs(d[0] - d[1]) > SAME || fabs(d[0] - round(d[0])) > SAME)
        return 0;
    /* The course that the first face's is in the other's coordinates. */
    away = s->course[f[1]] - (int32_t)round(d[0]) -
           (sense > 0 ? s->course[f[0]] : -s->course[f[0]] - 1);
    return (int8_t)(away == 0 ? sense : abs(away) == 1 ? 2 * sense : 0);
}

/* -- strips -------------------------------------------------------------- */

static void
flood(otx_strips *s, int32_t seed, int32_t *queue)
{
    const otx_level *leaf = s->leaf.level;
    int32_t head = 0, tail = 0;

    queue[tail++] = seed;
    s->of[seed] = s->count;
    while (head < tail)
    {
        const int32_t face = queue[head++];

        for (int32_t i = leaf->face_first[face]; i < leaf->face_first[face + 1];
             ++i)
        {
            const int32_t e = leaf->face_edges[i];
            const int32_t *f = leaf->edge_faces + 2 * (size_t)e;
            const int32_t other = f[f[0] == face];

            if (abs(s->edges[e]) != 1 || s->of[other] >= 0)
                continue;
            s->of[other] = s->count;
            s->sense[other] = (int8_t)(s->sense[face] * s->edges[e]);
            queue[tail++] = other;
        }
    }
    s->strips[s->count++] = (otx_course_strip){.faces = tail};
}

/* -- contacts ------------------------------------------------------------ */

static otx_strip_contact
contact_of(const otx_strips *s, int32_t edge)
{
    const otx_level *leaf = s->leaf.level;
    const int32_t *f = leaf->edge_faces + 2 * (size_t)edge;
    const double length = otx_seam_edge_length(s->m->job->surface, edge);
    const bool swap = s->of[f[0]] > s->of[f[1]];
    const int32_t faces[2] = {f[swap], f[!swap]};
    const int agree =
        (s->edges[edge] > 0 ? 1 : -1) * s->sense[f[0]] * s->sense[f[1]];
    int32_t corners[2][2];
    double across = 0.0, lag = 0.0;
    otx_strip_contact out = {
        .a = s->of[faces[0]],
        .b = s->of[faces[1]],
        .edge = edge,
        .agree = agree * length};

    for (int i = 0; i < 2; ++i)
        otx_seam_corners(leaf, edge, faces[i], corners[i]);
    for (int k = 0; k < 2; ++k)
    {
        across += 0.5 * otx_strips_across(s, faces[0], corners[0][k]);
        lag += 0.5 * (s->along[corners[1][k]] - s->along[corners[0][k]]);
    }
    if (agree < 0)
        return out;
    out.above = across > 0.5 ? length : -length;
    out.lag = otx_vec2_scale(
        length, otx_vec2_polar(2.0 * OTX_PI * lag / s->m->courses.period));
    return out;
}

static int
compare_contacts(const void *p, const void *q)
{
    const otx_strip_contact *a = p, *b = q;

    return a->a != b->a   ? (a->a > b->a) - (a->a < b->a)
           : a->b != b->b ? (a->b > b->b) - (a->b < b->b)
                          : (a->edge > b->edge) - (a->edge < b->edge);
}

otx_status
otx_strips_touch(otx_strips *s)
{
    const otx_level *leaf = s->leaf.level;
    otx_strip_contact *list = s->contacts;
    int32_t count = 0, n = 0;

    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *f = leaf->edge_faces + 2 * (size_t)e;

        if (abs(s->edges[e]) == 2 && s->of[f[0]] != s->of[f[1]])
            list[count++] = contact_of(s, e);
    }
    qsort(list, (size_t)count, sizeof *list, compare_contacts);
    for (int32_t i = 0; i < count; ++i)
    {
        otx_strip_contact *to = &list[n > 0 ? n - 1 : 0];

        if (n == 0 || to->a != list[i].a || to->b != list[i].b)
        {
            list[n++] = list[i];
            continue;
        }
        to->agree += list[i].agree;
        to->above += list[i].above;
        to->lag = otx_vec2_add(to->lag, list[i].lag);
    }
    s->contact_count = n;
    return OSDTEX_OK;
}

/* -- in turn ------------------------------------------------------------- */

typedef struct tour
{
    int32_t *first, *list; /* contacts of each strip */
    uint8_t *seen;
    otx_pqueue queue;
} tour;

static otx_status
prepare_tour(const otx_strips *s, tour *t)
{
    otx_arena *scratch = s->m->job->run->scratch;

    *t = (tour){
        OTX_ZNEW(scratch, int32_t, s->count + 2),
        OTX_NEW(scratch, int32_t, 2 * (int64_t)s->contact_count),
        OTX_ZNEW(scratch, uint8_t, s->count), otx_pqueue_make(scratch)};
    OTX_TRY(otx_run_ok(s->m->job->run));
    for (int32_t i = 0; i < s->contact_count; ++i)
    {
        otx_csr_count(t->first, s->contacts[i].a, 1);
        otx_csr_count(t->first, s->contacts[i].b, 1);
    }
    otx_csr_sum(t->first, s->count);
    for (int32_t i = 0; i < s->contact_count; ++i)
    {
        t->list[otx_csr_place(t->first, s->contacts[i].a)] = i;
        t->list[otx_csr_place(t->first, s->contacts[i].b)] = i;
    }
    return OSDTEX_OK;
}

static void
push_contacts(const otx_strips *s, tour *t, int32_t strip)
{
    t->seen[strip] = 1;
    for (int32_t i = t->first[strip]; i < t->first[strip + 1]; ++i)
        otx_pqueue_push(
            &t->queue, -fabs(s->contacts[t->list[i]].agree), t->list[i]);
}

otx_status
otx_strips_visit(otx_strips *s, otx_strips_visitor *visitor)
{
    otx_run *run = s->m->job->run;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_pqueue seeds = otx_pqueue_make(run->scratch);
    otx_pqueue_entry seed, entry;
    otx_status status;
    tour t;

    OTX_TRY(prepare_tour(s, &t));
    for (int32_t i = 0; i < s->count; ++i)
        otx_pqueue_push(&seeds, -(double)s->strips[i].faces, i);
    while (otx_pqueue_pop(&seeds, &seed))
    {
        if (t.seen[seed.item])
            continue;
        visitor(s, seed.item, -1, NULL);
        push_contacts(s, &t, seed.item);
        while (otx_pqueue_pop(&t.queue, &entry))
        {
            const otx_strip_contact *c = &s->contacts[entry.item];
            const bool back = t.seen[c->b];
            const int32_t strip = back ? c->a : c->b;

            if (t.seen[strip])
                continue;
            visitor(s, strip, back ? c->b : c->a, c);
            push_contacts(s, &t, strip);
        }
    }
    status = otx_run_ok(run);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* -- the whole ----------------------------------------------------------- */

/* Marks a strip that is to be turned by a length of -1. */
static void
turn_strip(
    otx_strips *s, int32_t strip, int32_t from,
    const otx_strip_contact *contact)
{
    if (from < 0)
        s->strips[strip].length = 1.0;
    else
        s->strips[strip].length = contact->agree < 0.0 ? -s->strips[from].length
                                                       : s->strips[from].length;
}

static otx_status
allocate(otx_strips *s)
{
    otx_arena *scratch = s->m->job->run->scratch;
    const otx_level *leaf = s->leaf.level;

    s->of = OTX_NEW(scratch, int32_t, leaf->face_count);
    s->sense = OTX_NEW(scratch, int8_t, leaf->face_count);
    s->course = OTX_NEW(scratch, int32_t, leaf->face_count);
    s->rise = OTX_NEW(scratch, otx_vec2, leaf->face_count);
    s->edges = OTX_NEW(scratch, int8_t, leaf->edge_count);
    s->along = OTX_ZNEW(scratch, double, leaf->corner_count);
    s->strips = OTX_NEW(scratch, otx_course_strip, leaf->face_count);
    s->contacts = OTX_NEW(scratch, otx_strip_contact, leaf->edge_count);
    return s->of && s->sense && s->course && s->rise && s->edges && s->along &&
                   s->strips && s->contacts
               ? OSDTEX_OK
               : otx_fail_memory(s->m->job->run, "map");
}

otx_status
otx_strips_find(const otx_material *m, otx_strips *out)
{
    otx_strips *s = out;
    int32_t *queue;

    *s = (otx_strips){.m = m};
    OTX_TRY(otx_connection_build(
        m->job->run, m->job->surface, m->job->surface->level_count - 1,
        &s->leaf));
    OTX_TRY(allocate(s));
    queue = OTX_NEW(m->job->run->scratch, int32_t, s->leaf.level->face_count);
    OTX_TRY(otx_run_ok(m->job->run));
    for (int32_t f = 0; f < s->leaf.level->face_count; ++f)
        measure_face(s, f);
    for (int32_t e = 0; e < s->leaf.level->edge_count; ++e)
        s->edges[e] = relate(s, e);
    for (int32_t f = 0; f < s->leaf.level->face_count; ++f)
        if (is_used(s, f) && s->of[f] < 0)
            flood(s, f, queue);
    OTX_TRY(otx_strips_touch(s));
    OTX_TRY(otx_strips_visit(s, turn_strip));
    for (int32_t f = 0; f < s->leaf.level->face_count; ++f)
        if (s->of[f] >= 0 && s->strips[s->of[f]].length < 0.0)
            s->sense[f] = (int8_t)-s->sense[f];
    for (int32_t i = 0; i < s->count; ++i)
        s->strips[i].length = 0.0;
    return otx_strips_touch(s);
}
