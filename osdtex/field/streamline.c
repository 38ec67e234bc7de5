/* streamline.c -- evenly spaced lines along a direction field, to be drawn. */
#include "field/streamline.h"

#include "base/random.h"

#include <string.h>

/* Of the spacing: how near another line may come, how far a line is from its
 * own recent past, the shortest line that is worth drawing. */
static const double NEAR = 0.55;
static const double RECENT = 1.5;
static const double SHORTEST = 1.5;

/* Lines of a smaller angle between them are of one family: cosine. */
static const double ALIKE = 0.7;

enum
{
    SEEDS_PER_SPACING = 4, /* candidates in a square of the spacing */
    PIECES_MAX = 64 << 20
};

/* A point of a line, kept to hold others at a distance. */
typedef struct sample
{
    otx_vec3 at, direction, normal;
    double along;
    int32_t line;
    int32_t next; /* of the same slot, -1 none */
} sample;

typedef struct tracer
{
    otx_run *run;
    const otx_direction *field;
    const otx_connection *c;
    double spacing, width;
    int32_t *slots; /* [slot_mask + 1] first sample, -1 none */
    uint32_t slot_mask;
    sample *samples;
    int32_t sample_count, sample_capacity;
    otx_streamline_piece *pieces;
    int32_t piece_count, piece_capacity;
    int32_t line;
    double sense; /* -1: going back from the seed */
} tracer;

/* Where a line is: on a face, with a direction in its frame. */
typedef struct walker
{
    int32_t face;
    otx_vec2 at; /* in the frame, from the centre */
    otx_vec2 direction;
    double along;
    int32_t entry; /* corner of the half-edge it came in by, -1 none */
} walker;

/* -- growing arrays ------------------------------------------------------ */

static void *
grown(otx_run *run, void *from, int32_t count, size_t bytes, int32_t *capacity)
{
    const int32_t wanted = *capacity > 0 ? 2 * *capacity : 1024;
    void *to = wanted > PIECES_MAX
                   ? NULL
                   : otx_arena_alloc(run->scratch, (size_t)wanted, bytes);

    if (to && count > 0)
        memcpy(to, from, (size_t)count * bytes);
    *capacity = to ? wanted : *capacity;
    return to;
}

static bool
add_piece(tracer *t, const otx_streamline_piece *piece)
{
    if (t->piece_count == t->piece_capacity)
    {
        void *more = grown(
            t->run, t->pieces, t->piece_count, sizeof *t->pieces,
            &t->piece_capacity);

        if (!more)
            return false;
        t->pieces = more;
    }
    t->pieces[t->piece_count++] = *piece;
    return true;
}

/* -- distances to other lines -------------------------------------------- */

static uint32_t
slot_at(const tracer *t, int64_t x, int64_t y, int64_t z)
{
    return (uint32_t)otx_random_mix(
               otx_random_mix(otx_random_mix((uint64_t)x) ^ (uint64_t)y) ^
               (uint64_t)z) &
           t->slot_mask;
}

static int64_t
cell_of(const tracer *t, double x)
{
    return (int64_t)floor(x / t->spacing);
}

static bool
add_sample(tracer *t, sample s)
{
    const uint32_t slot =
        slot_at(t, cell_of(t, s.at.x), cell_of(t, s.at.y), cell_of(t, s.at.z));

    if (t->sample_count == t->sample_capacity)
    {
        void *more = grown(
            t->run, t->samples, t->sample_count, sizeof *t->samples,
            &t->sample_capacity);

        if (!more)
            return false;
        t->samples = more;
    }
    s.next = t->slots[slot];
    t->slots[slot] = t->sample_count;
    t->samples[t->sample_count++] = s;
    return true;
}

/* Whether a kept sample is too near to `s` and on its side of the surface. */
static bool
disturbs(const tracer *t, const sample *kept, const sample *s, double distance)
{
    if (otx_vec3_length(otx_vec3_sub(kept->at, s->at)) > distance ||
        otx_vec3_dot(kept->normal, s->normal) < 0.0 ||
        fabs(otx_vec3_dot(kept->direction, s->direction)) < ALIKE)
        return false;
    return kept->line != s->line ||
           fabs(kept->along - s->along) > RECENT * t->spacing;
}

/* `distance` is at most the spacing, which is the size of a cell. */
static bool
is_free(const tracer *t, const sample *s, double distance)
{
    const int64_t x = cell_of(t, s->at.x);
    const int64_t y = cell_of(t, s->at.y);
    const int64_t z = cell_of(t, s->at.z);

    for (int64_t k = 0; k < 27; ++k)
        for (int32_t i = t->slots[slot_at(
                 t, x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1)];
             i >= 0; i = t->samples[i].next)
            if (disturbs(t, &t->samples[i], s, distance))
                return false;
    return true;
}

/* -- walking ------------------------------------------------------------- */

static otx_vec3
place(const tracer *t, int32_t face, otx_vec2 at)
{
    return otx_vec3_add(
        t->c->centres[face], otx_connection_lift(t->c, face, at));
}

static sample
sample_of(const tracer *t, const walker *w)
{
    return (sample){
        .at = place(t, w->face, w->at),
        .direction = otx_connection_lift(t->c, w->face, w->direction),
        .normal = t->c->normals[w->face],
        .along = t->sense * w->along,
        .line = t->line};
}

/* Corner of a face in its frame, from the centre. */
static otx_vec2
corner_at(const tracer *t, int32_t face, int32_t corner)
{
    return otx_connection_project(
        t->c, face,
        otx_vec3_sub(
            otx_vec3_load(
                t->c->surface->points, t->c->level->face_verts[corner]),
            t->c->centres[face]));
}

/* The half-edge by which a walker leaves its face: its corner, how far along
 * it, and at which distance; -1 when there is none, as in folded faces. */
static int32_t
find_exit(const tracer *t, const walker *w, double *share, double *distance)
{
    const otx_level *level = t->c->level;
    const int32_t first = level->face_first[w->face];
    int32_t best = -1;

    *distance = INFINITY;
    for (int32_t i = first; i < level->face_first[w->face + 1]; ++i)
    {
        const otx_vec2 a = otx_vec2_sub(corner_at(t, w->face, i), w->at);
        const otx_vec2 side = t->c->sides[i];
        const double across = otx_vec2_cross(w->direction, side);
        double s, d;

        /* Leaving is crossing from left to right of a counter-clockwise
         * side. */
        if (i == w->entry || !(across > 0.0))
            continue;
        s = -otx_vec2_cross(w->direction, a) / across;
        d = otx_vec2_cross(a, side) / across;
        if (s < -1e-9 || s > 1.0 + 1e-9 || d < -1e-6 * t->spacing ||
            d >= *distance)
            continue;
        *distance = fmax(d, 0.0);
        *share = fmin(fmax(s, 0.0), 1.0);
        best = i;
    }
    return best;
}

/* The direction of the field on a face, or against it, that is nearest to
 * `d`. */
static otx_vec2
nearest_direction(const tracer *t, int32_t face, otx_vec2 d)
{
    const double s = t->field->symmetry;
    const double base =
        otx_direction_angle(t->field, face) + (t->sense < 0.0 ? OTX_PI : 0.0);
    const double turns = round((atan2(d.y, d.x) - base) * s / (2.0 * OTX_PI));

    return otx_vec2_polar(base + turns * 2.0 * OTX_PI / s);
}

/* Puts a walker across the half-edge `corner`; false at a boundary. */
static bool
cross_edge(const tracer *t, walker *w, int32_t corner, double share)
{
    const otx_level *level = t->c->level;
    const int32_t edge = level->face_edges[corner];
    const int32_t *faces = level->edge_faces + 2 * (size_t)edge;
    const bool ahead = faces[0] == w->face;
    const double turn = ahead ? t->c->turns[edge] : -t->c->turns[edge];

    if (!t->c->inner[edge])
        return false;
    w->face = faces[ahead];
    w->entry = otx_connection_corner(t->c, edge, w->face);
    w->at = otx_vec2_add(
        corner_at(t, w->face, w->entry),
        otx_vec2_scale(1.0 - share, t->c->sides[w->entry]));
    w->direction = nearest_direction(
        t, w->face, otx_vec2_mul(otx_vec2_polar(turn), w->direction));
    return true;
}

/* The pieces that a line has on a face, also for the faces that they touch. */
static bool
keep_piece(tracer *t, const walker *from, const walker *to)
{
    const otx_level *level = t->c->level;
    otx_streamline_piece piece = {
        from->face,
        {place(t, from->face, from->at), place(t, from->face, to->at)},
        {t->sense * from->along, t->sense * to->along}};

    if (!add_piece(t, &piece))
        return false;
    for (int32_t i = level->face_first[from->face];
         i < level->face_first[from->face + 1]; ++i)
    {
        const int32_t edge = level->face_edges[i];
        const int32_t *faces = level->edge_faces + 2 * (size_t)edge;
        const otx_vec2 side = t->c->sides[i];
        const double length = otx_vec2_length(side);
        const otx_vec2 corner = corner_at(t, from->face, i);
        const double a =
            otx_vec2_cross(side, otx_vec2_sub(from->at, corner)) / length;
        const double b =
            otx_vec2_cross(side, otx_vec2_sub(to->at, corner)) / length;

        piece.face = faces[faces[0] == from->face];
        if (t->c->inner[edge] && fmin(a, b) < t->width && !add_piece(t, &piece))
            return false;
    }
    return true;
}

/* Walks from `start` until the line comes near another, ends at a boundary or
 * is very long. Samples are kept as it goes. */
static otx_status
walk(tracer *t, walker start)
{
    const double most = 4000.0 * t->spacing;
    walker w = start;
    double sampled = 0.0;

    while (w.along < most)
    {
        const walker from = w;
        double share = 0.0, distance;
        const int32_t corner = find_exit(t, &w, &share, &distance);
        const double step =
            fmin(distance, fmax(0.25 * t->spacing, sampled - w.along));
        const bool leaves = corner >= 0 && step >= distance;

        if (corner < 0)
            return OSDTEX_OK;
        w.at = otx_vec2_add(w.at, otx_vec2_scale(step, w.direction));
        w.along += step;
        if (!leaves)
            w.entry = -1;

        const sample s = sample_of(t, &w);

        if (!is_free(t, &s, NEAR * t->spacing))
            return OSDTEX_OK;
        if (step > 0.0 && !keep_piece(t, &from, &w))
            return otx_fail_memory(t->run, "field");
        if (w.along >= sampled)
        {
            if (!add_sample(t, s))
                return otx_fail_memory(t->run, "field");
            sampled = w.along + 0.25 * t->spacing;
        }
        if (leaves && !cross_edge(t, &w, corner, share))
            return OSDTEX_OK;
    }
    return OSDTEX_OK;
}

/* -- seeds --------------------------------------------------------------- */

/* A line through a point in both ways; taken back when it is too short. */
static otx_status
try_line(tracer *t, int32_t face, otx_vec2 at, otx_vec2 direction)
{
    const int32_t pieces = t->piece_count, samples = t->sample_count;
    walker w = {face, at, direction, 0.0, -1};
    const sample s = sample_of(t, &w);
    double length = 0.0;

    if (!is_free(t, &s, t->spacing))
        return OSDTEX_OK;
    t->sense = 1.0;
    OTX_TRY(walk(t, w));
    w.direction = otx_vec2_scale(-1.0, direction);
    t->sense = -1.0;
    OTX_TRY(walk(t, w));
    for (int32_t i = samples; i < t->sample_count; ++i)
        length = fmax(length, fabs(t->samples[i].along));
    ++t->line;
    if (length >= SHORTEST * t->spacing)
        return OSDTEX_OK;
    while (t->sample_count > samples)
    {
        const sample *last = &t->samples[--t->sample_count];

        t->slots[slot_at(
            t, cell_of(t, last->at.x), cell_of(t, last->at.y),
            cell_of(t, last->at.z))] = last->next;
    }
    t->piece_count = pieces;
    return OSDTEX_OK;
}

/* A point of a face: corners weighted by random numbers. */
static otx_vec2
seed_at(const tracer *t, int32_t face, int32_t number)
{
    const otx_level *level = t->c->level;
    otx_vec2 sum = {0, 0};
    double total = 0.0;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
    {
        const double weight =
            0.01 -
            log(1.0 - otx_random_unit((uint64_t)i, 17, (uint64_t)number));

        sum = otx_vec2_add(sum, otx_vec2_scale(weight, corner_at(t, face, i)));
        total += weight;
    }
    return otx_vec2_scale(1.0 / total, sum);
}

static otx_status
seed_face(tracer *t, int32_t face)
{
    const double wanted =
        SEEDS_PER_SPACING * t->c->areas[face] / (t->spacing * t->spacing);
    const double chance = otx_random_unit(0, 18, (uint64_t)face);
    const int32_t count = (int32_t)fmin(floor(wanted + chance), 1000.0);
    const otx_vec2 d = otx_vec2_polar(otx_direction_angle(t->field, face));

    for (int32_t k = 0; k < count; ++k)
    {
        const otx_vec2 at = seed_at(t, face, k);

        OTX_TRY(try_line(t, face, at, d));
        if (t->field->symmetry == 4)
            OTX_TRY(try_line(t, face, at, (otx_vec2){-d.y, d.x}));
    }
    return OSDTEX_OK;
}

static otx_status
trace(tracer *t)
{
    const otx_level *level = t->c->level;

    for (int32_t f = 0; f < level->face_count; ++f)
    {
        if (f % 4096 == 0)
            OTX_TRY(
                otx_progress(t->run, "lines", (double)f / level->face_count));
        if (!level->face_hole[f])
            OTX_TRY(seed_face(t, f));
    }
    return OSDTEX_OK;
}

otx_status
otx_streamline_trace(
    otx_run *run, const otx_direction *field, double spacing, double width,
    otx_streamline_set *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    tracer t = {
        .run = run,
        .field = field,
        .c = field->connection,
        .spacing = spacing,
        .width = width,
        .slot_mask = (1u << 18) - 1};

    *out = (otx_streamline_set){0};
    if (!(spacing > 0.0) || !(width > 0.0) || !isfinite(spacing) ||
        !isfinite(width))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "spacing and width of lines are positive");
    t.slots = OTX_NEW(run->scratch, int32_t, t.slot_mask + 1);
    OTX_TRY(otx_run_ok(run));
    memset(t.slots, 0xff, ((size_t)t.slot_mask + 1) * sizeof *t.slots);
    OTX_TRY(trace(&t));
    out->pieces = OTX_NEW(run->arena, otx_streamline_piece, t.piece_count);
    OTX_TRY(otx_run_ok(run));
    if (t.piece_count > 0)
        memcpy(
            out->pieces, t.pieces, (size_t)t.piece_count * sizeof *out->pieces);
    out->count = t.piece_count;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}
