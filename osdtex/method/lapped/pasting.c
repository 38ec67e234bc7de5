/* pasting.c -- pieces are laid down in rounds.
 *
 * Pieces of a round are apart from each other: they are laid out, cut and
 * pasted by several threads, and come out the same by one. */
#include "base/random.h"
#include "method/lapped/radial_cut.h"
#include "method/lapped/whole.h"

#include <stdlib.h>
#include <string.h>

enum
{
    STAGE_ORDER = 0x6c617001, /* of random numbers */
    STAGE_SAMPLE,
    STAGE_TURN,
    STAGE_CENTRE,
    STAGE_SHAPE
};

enum
{
    WAVES = 5,  /* around a splotch: 2 to WAVES + 1 bulges */
    BATCH = 8,  /* pieces of a round, at most */
    SCAN = 4096 /* faces that are looked through for them */
};

static const double TAU = 6.283185307179586;
static const double BULGE = 0.09; /* of the radius, each wave */
/* How the faces are gone through. */
typedef struct pass
{
    double near;   /* how near to the middle of an earlier paste a new one may
                    * begin, in radii */
    double size;   /* of features */
    int32_t tries; /* at a face; 0: until it is covered */
} pass;

/* First where no piece has reached, at last anywhere. */
static const pass SPLOTCHES[] = {
    {1.3, 1, 0}, {0.8, 1, 0}, {0, 1, 0}, {-1, 0, 0}};
static const pass CLUMPS[] = {{0.8, 1, 1}, {0, 1, 2}, {-1, 0, 0}};
/* What an alpha cuts out has nothing else beside it. */
static const pass CUT_OUT[] = {{0.8, 1, 1}, {0, 1, 40}, {-1, 0, 0}};
static const pass PACKING[] = {
    {0.8, 1, 1}, {0, 1, 1}, {0, 0.65, 1}, {-1, 0, 0}};
/* Of its samples, what is open where a feature may begin. */
static const double ROOM = 0.3;
/* From middle to middle of the pieces of a round, in radii. */
static const double APART = 2.6;

/* A piece of a round. */
typedef struct slot
{
    otx_arena *arena;
    otx_arena_mark empty;
    uint64_t number; /* of the try: what its random numbers are for */
    int64_t sample;
    otx_vec3 point;
    otx_lapped_seed seed;
    otx_radial outline;
    otx_lapped_paste paste; /* in `arena` */
    otx_radial cut;         /* and the one piece of a splotch */
    otx_lapped_piece piece;
    bool apart;
    int64_t fresh;
} slot;

typedef struct pasting
{
    otx_lapped *l;
    otx_lapped_space *spaces; /* [threads] */
    int32_t *order;           /* [order_count] faces as they are tried */
    int32_t order_count;
    float *near;    /* [leaf face_count] to the nearest middle, radii */
    int32_t *taken; /* [leaf face_count] the last try that has the face */
    uint8_t *tried; /* [leaf face_count] times, in this pass */
    int32_t *uses;  /* [features.count] in pastes */
    const pass *pass;
    double reach;   /* of charts, texels; 0: of their outline */
    double radius;  /* that `near` is in, texels */
    double spacing; /* of tries, texels */
    slot slots[BATCH];
    int32_t slot_count;
    uint64_t tries;
} pasting;

/* ---- order of seeds ---- */

/* How much the surface bends around a face. */
static double
difficulty(const otx_lapped *l, int32_t face)
{
    double sum = 0.0;

    for (int32_t k = 0; k < otx_level_face_size(l->leaf, face); ++k)
    {
        const int32_t other = otx_level_neighbour(l->leaf, face, k);

        if (other >= 0)
            sum += 1.0 - otx_vec3_dot(
                             l->connection.normals[face],
                             l->connection.normals[other]);
    }
    return sum;
}

typedef struct ranked
{
    double key;
    int32_t face;
} ranked;

static int
compare_ranked(const void *a, const void *b)
{
    const ranked *x = a, *y = b;

    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return (x->face > y->face) - (x->face < y->face);
}

/* All faces in the order in which they are tried: difficult ones first, where
 * later pastes may cover what comes out badly [Praun00, sec. 3.3], then by
 * chance. */
static otx_status
order_faces(pasting *p)
{
    const otx_lapped *l = p->l;
    const double mild = 0.15;
    ranked *list = OTX_NEW(l->run->scratch, ranked, l->leaf->face_count);

    p->order = OTX_NEW(l->run->scratch, int32_t, l->leaf->face_count);
    OTX_TRY(otx_run_ok(l->run));
    for (int32_t f = 0; f < l->leaf->face_count; ++f)
    {
        const double chance =
            otx_random_unit(l->run->seed, STAGE_ORDER, (uint64_t)f);

        if (!l->leaf->face_hole[f])
            list[p->order_count++] =
                (ranked){difficulty(l, f) > mild ? chance - 1.0 : chance, f};
    }
    qsort(list, (size_t)p->order_count, sizeof *list, compare_ranked);
    for (int32_t i = 0; i < p->order_count; ++i)
        p->order[i] = list[i].face;
    return OSDTEX_OK;
}

/* ---- a piece, where and what ---- */

/* A shape that bulges, or a circle [Praun00, sec. 3.1]. */
static otx_radial
make_outline(const otx_lapped *l, uint64_t number)
{
    const uint64_t seed = otx_random_bits(l->run->seed, STAGE_SHAPE, number);
    const bool bulges = l->settings.outline == OTX_LAPPED_OUTLINE_SPLOTCH;
    otx_radial o = {.feather = (float)l->settings.feather};

    for (int32_t i = 0; i < OTX_RADIAL_ANGLES; ++i)
    {
        double r = 1.0;

        for (uint64_t w = 0; bulges && w < WAVES; ++w)
            r += BULGE * sin((double)(w + 2) * TAU * i / OTX_RADIAL_ANGLES +
                             TAU * otx_random_unit(seed, STAGE_SHAPE, w));
        o.radius[i] = (float)(l->settings.radius * r);
    }
    otx_radial_bound(&o);
    return o;
}

/* One of the samples of a face that are not covered. */
static int32_t
open_sample(const otx_lapped *l, int32_t face, uint64_t number)
{
    const uint8_t *covered = l->samples.covered + l->samples.first[face];
    int32_t wanted =
        (int32_t)(otx_random_unit(l->run->seed, STAGE_SAMPLE, number) *
                  l->samples.open[face]);

    for (int32_t i = 0;; ++i)
        if (!covered[i] && wanted-- == 0)
            return i;
}

/* Where along an axis a piece that reaches so far is taken from. */
static double
place_on_axis(double random, double side, bool wraps, double reach)
{
    const double least = wraps ? 0.0 : fmin(reach, 0.5 * side);

    return least + random * (side - 2.0 * least);
}

/* Any place of the exemplar. */
static otx_vec2
choose_centre(const otx_lapped *l, uint64_t number, double reach)
{
    const otx_exemplar *e = l->exemplar;
    const double x = otx_random_unit(l->run->seed, STAGE_CENTRE, 2 * number);
    const double y =
        otx_random_unit(l->run->seed, STAGE_CENTRE, 2 * number + 1);

    return (otx_vec2){
        place_on_axis(x, e->match.width, e->wrap_x, reach),
        place_on_axis(y, e->match.height, e->wrap_y, reach)};
}

static void
fill_slot(pasting *p, int32_t face, slot *s)
{
    const otx_lapped *l = p->l;
    const int32_t sample = open_sample(l, face, p->tries);
    const double turn = otx_random_unit(l->run->seed, STAGE_TURN, p->tries);

    s->number = p->tries;
    s->sample = l->samples.first[face] + sample;
    s->seed = (otx_lapped_seed){
        face, otx_samples_at(&l->samples, face, sample),
        otx_vec2_polar(TAU * turn)};
    s->point = otx_lapped_point(l, &s->seed.place);
}

/* ---- a round ---- */

/* Whether the slot at the end of the list is apart from those before it. */
static bool
is_apart(const pasting *p)
{
    const slot *s = &p->slots[p->slot_count];
    const double texels = otx_lapped_texels(p->l, s->seed.face);
    const double apart =
        fmax(APART * p->radius, 2.0 * p->reach * p->pass->size);

    for (int32_t i = 0; i < p->slot_count; ++i)
        if (otx_vec3_length(otx_vec3_sub(s->point, p->slots[i].point)) *
                texels <
            apart)
            return false;
    return true;
}

static bool
has_room(const otx_lapped *l, int32_t face)
{
    return l->features.by_alpha ||
           l->samples.open[face] > ROOM * otx_samples_count(&l->samples, face);
}

/* Chooses the pieces of a round from the faces after the first `begin`; moves
 * that beyond those that are done with. */
static void
choose_seeds(pasting *p, int32_t *begin)
{
    const otx_lapped *l = p->l;
    bool all_done = true;

    p->slot_count = 0;
    for (int32_t i = *begin, seen = 0;
         i < p->order_count && seen < SCAN && p->slot_count < BATCH; ++i)
    {
        const int32_t face = p->order[i];
        const bool done =
            l->samples.open[face] == 0 ||
            (double)p->near[face] < p->pass->near ||
            (p->pass->tries > 0 &&
             (p->tried[face] >= p->pass->tries || !has_room(l, face)));

        all_done = all_done && done;
        *begin += all_done;
        if (done)
            continue;
        ++seen;
        fill_slot(p, face, &p->slots[p->slot_count]);
        if (is_apart(p))
        {
            ++p->slot_count;
            ++p->tries;
        }
    }
}

static otx_status
unfold(void *context, int64_t index, otx_worker *worker)
{
    pasting *p = context;
    slot *s = &p->slots[index];
    const otx_lapped_room room = {&p->spaces[worker->index], s->arena, worker};
    double reach;

    s->outline = make_outline(p->l, s->number);
    reach = p->reach > 0.0 ? p->reach * p->pass->size : (double)s->outline.most;
    OTX_TRY(otx_lapped_unfold(p->l, &room, &s->seed, reach, &s->paste.chart));
    return otx_lapped_trim(s->arena, reach, &s->paste.chart);
}

/* The pieces of a round have no face in common; those that have are tried
 * again, since faces of theirs are still open. */
static void
part_slots(pasting *p)
{
    for (int32_t i = 0; i < p->slot_count; ++i)
    {
        slot *s = &p->slots[i];
        const otx_lapped_chart *c = &s->paste.chart;

        s->apart = true;
        for (int32_t k = 0; k < c->face_count; ++k)
            s->apart =
                s->apart && p->taken[c->faces[k]] < (int32_t)p->slots[0].number;
        for (int32_t k = 0; s->apart && k < c->face_count; ++k)
            p->taken[c->faces[k]] = (int32_t)s->number;
    }
}

/* A splotch is cut where it differs least from what lies there. */
static otx_status
lay_splotch(const pasting *p, const otx_lapped_room *room, slot *s)
{
    const otx_lapped *l = p->l;

    s->cut = s->outline;
    s->piece = (otx_lapped_piece){{0, 0}, &s->cut, OTX_LAPPED_BENEATH};
    s->paste.size = 1.0;
    s->paste.pieces = &s->piece;
    s->paste.piece_count = 1;
    s->paste.centre = choose_centre(l, s->number, (double)s->outline.most);
    if (l->settings.mode != OTX_LAPPED_PAPER)
        OTX_TRY(otx_lapped_cut(l, s->arena, &s->outline, &s->paste, &s->cut));
    OTX_TRY(otx_lapped_trim(s->arena, (double)s->cut.most, &s->paste.chart));
    return otx_lapped_rim(l, room, &s->cut, &s->paste.chart);
}

/* Features are whole in their chart: its border cuts none. */
static otx_status
lay_features(const pasting *p, slot *s)
{
    const otx_lapped_try attempt = {
        s->number, p->pass->size,
        s->point.y * otx_lapped_texels(p->l, s->seed.face), p->uses};
    otx_lapped_chart *c = &s->paste.chart;

    OTX_TRY(otx_lapped_choose_features(p->l, s->arena, &attempt, &s->paste));
    c->rim = OTX_NEW(s->arena, float, c->vert_count);
    if (!c->rim)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t v = 0; v < c->vert_count; ++v)
        c->rim[v] = 1.0f;
    return OSDTEX_OK;
}

static otx_status
lay(void *context, int64_t index, otx_worker *worker)
{
    pasting *p = context;
    slot *s = &p->slots[index];
    const otx_lapped_room room = {&p->spaces[worker->index], s->arena, worker};

    if (!s->apart)
        return OSDTEX_OK;
    s->fresh = 0;
    if (p->reach > 0.0)
        OTX_TRY(lay_features(p, s));
    else
        OTX_TRY(lay_splotch(p, &room, s));
    if (s->paste.piece_count == 0)
        return OSDTEX_OK;
    s->fresh = otx_lapped_mark(p->l, &s->paste, &p->l->samples);
    /* Its own seed, whatever comes of rounding. */
    s->fresh += otx_samples_set(&p->l->samples, s->seed.face, s->sample);
    return OSDTEX_OK;
}

/* ---- what is kept ---- */

static otx_status
next_paste(otx_lapped *l, otx_lapped_paste **out)
{
    if (l->paste_count == l->paste_capacity)
    {
        const int32_t to = 2 * l->paste_capacity + 64;
        otx_lapped_paste *wider = OTX_NEW(l->run->arena, otx_lapped_paste, to);

        if (!wider)
            return otx_fail_memory(l->run, "map");
        if (l->paste_count > 0)
            memcpy(wider, l->pastes, (size_t)l->paste_count * sizeof *wider);
        l->pastes = wider;
        l->paste_capacity = to;
    }
    *out = &l->pastes[l->paste_count++];
    return OSDTEX_OK;
}

/* Faces whose middle is nearer to that of a piece than to those before. */
static void
come_near(pasting *p, const otx_lapped_chart *c)
{
    for (int32_t i = 0; i < c->face_count; ++i)
    {
        const int32_t first = c->first[i], size = c->first[i + 1] - first;
        float *near = &p->near[c->faces[i]];
        otx_vec2 sum = {0, 0};

        for (int32_t k = 0; k < size; ++k)
            sum = otx_vec2_add(sum, c->flat[c->corners[first + k]]);
        *near =
            fminf(*near, (float)(otx_vec2_length(sum) / (size * p->radius)));
    }
    p->near[c->faces[0]] = 0.0f;
}

/* Outlines of features are there already; that of a splotch is its own. */
static otx_status
keep_pieces(pasting *p, const slot *s, otx_lapped_paste *paste)
{
    otx_arena *arena = p->l->run->arena;
    const int32_t count = s->paste.piece_count;
    otx_radial *cut = OTX_NEW(arena, otx_radial, 1);

    paste->pieces = OTX_NEW(arena, otx_lapped_piece, count);
    if (!cut || !paste->pieces)
        return otx_fail_memory(p->l->run, "map");
    paste->piece_count = count;
    memcpy(
        paste->pieces, s->paste.pieces, (size_t)count * sizeof *paste->pieces);
    for (int32_t i = 0; i < count; ++i)
        if (paste->pieces[i].cut == &s->cut)
        {
            *cut = s->cut;
            paste->pieces[i].cut = cut;
        }
        else
            ++p->uses[paste->pieces[i].cut - p->l->feature_cuts];
    return OSDTEX_OK;
}

/* Counts a try for the faces around its seed. */
static void
count_try(pasting *p, const slot *s)
{
    const otx_lapped_chart *c = &s->paste.chart;

    for (int32_t i = 0; i < c->face_count; ++i)
    {
        const int32_t face = c->faces[i];
        const otx_vec2 at = c->flat[c->corners[c->first[i]]];

        if (i == 0 || otx_vec2_length(at) < p->spacing)
            p->tried[face] += p->tried[face] < 255;
    }
}

static otx_status
keep_slot(pasting *p, const slot *s)
{
    otx_lapped *l = p->l;
    otx_lapped_paste *paste = NULL;

    count_try(p, s);
    if (s->paste.piece_count == 0)
        return OSDTEX_OK;
    OTX_TRY(next_paste(l, &paste));
    paste->centre = s->paste.centre;
    paste->size = s->paste.size;
    if (otx_lapped_keep(l->run->arena, &s->paste.chart, &paste->chart) !=
        OSDTEX_OK)
        return otx_fail_memory(l->run, "map");
    OTX_TRY(keep_pieces(p, s, paste));
    l->samples.left -= s->fresh;
    come_near(p, &paste->chart);
    return OSDTEX_OK;
}

static otx_status
run_round(pasting *p)
{
    otx_run *run = p->l->run;

    for (int32_t i = 0; i < p->slot_count; ++i)
        otx_arena_release(p->slots[i].arena, p->slots[i].empty);
    OTX_TRY(otx_loop_result(
        run, "map", otx_pool_for(run->pool, p->slot_count, unfold, p)));
    part_slots(p);
    OTX_TRY(otx_loop_result(
        run, "map", otx_pool_for(run->pool, p->slot_count, lay, p)));
    for (int32_t i = 0; i < p->slot_count; ++i)
        if (p->slots[i].apart)
            OTX_TRY(keep_slot(p, &p->slots[i]));
    return OSDTEX_OK;
}

/* ---- all ---- */

static otx_status
begin_spaces(pasting *p)
{
    const otx_level *leaf = p->l->leaf;
    otx_arena *scratch = p->l->run->scratch;
    const int32_t threads = otx_pool_threads(p->l->run->pool);

    p->spaces = OTX_ZNEW(scratch, otx_lapped_space, threads);
    OTX_TRY(otx_run_ok(p->l->run));
    for (int32_t i = 0; i < threads; ++i)
    {
        otx_lapped_space *space = &p->spaces[i];

        space->face_slot = OTX_NEW(scratch, int32_t, leaf->face_count);
        space->vert_slot = OTX_NEW(scratch, int32_t, leaf->vert_count);
        OTX_TRY(otx_run_ok(p->l->run));
        memset(space->face_slot, -1, (size_t)leaf->face_count * 4);
        memset(space->vert_slot, -1, (size_t)leaf->vert_count * 4);
    }
    return OSDTEX_OK;
}

static void
destroy_arena(void *arena)
{
    otx_arena_destroy(arena);
}

static otx_status
begin_slots(pasting *p)
{
    otx_run *run = p->l->run;

    for (int32_t i = 0; i < BATCH; ++i)
    {
        otx_arena *arena = otx_arena_create(run->allocator);

        if (!arena || !otx_arena_defer(run->scratch, destroy_arena, arena))
        {
            otx_arena_destroy(arena);
            return otx_fail_memory(run, "map");
        }
        p->slots[i].arena = arena;
        p->slots[i].empty = otx_arena_here(arena);
    }
    return OSDTEX_OK;
}

static otx_status
begin(pasting *p)
{
    const int32_t n = p->l->leaf->face_count;

    OTX_TRY(begin_spaces(p));
    OTX_TRY(begin_slots(p));
    OTX_TRY(order_faces(p));
    p->near = OTX_NEW(p->l->run->scratch, float, n);
    p->taken = OTX_NEW(p->l->run->scratch, int32_t, n);
    p->tried = OTX_NEW(p->l->run->scratch, uint8_t, n);
    p->uses = OTX_ZNEW(p->l->run->scratch, int32_t, p->l->features.count + 1);
    OTX_TRY(otx_run_ok(p->l->run));
    memset(p->taken, -1, (size_t)n * sizeof *p->taken);
    return OSDTEX_OK;
}

static otx_status
run_pass(pasting *p)
{
    const double all = (double)p->l->samples.first[p->l->leaf->face_count];
    int32_t at = 0;

    memset(p->tried, 0, (size_t)p->l->leaf->face_count);
    while (at < p->order_count)
    {
        choose_seeds(p, &at);
        OTX_TRY(run_round(p));
        OTX_TRY(otx_progress(
            p->l->run, "paste", 1.0 - (double)p->l->samples.left / all));
    }
    return OSDTEX_OK;
}

/* Passes until one that has no size. */
static otx_status
run_passes(pasting *p, const pass *passes, double reach, double radius)
{
    p->reach = reach;
    p->radius = radius;
    for (int32_t f = 0; f < p->l->leaf->face_count; ++f)
        p->near[f] = INFINITY;
    for (p->pass = passes; p->pass->size > 0.0; ++p->pass)
        OTX_TRY(run_pass(p));
    return OSDTEX_OK;
}

otx_status
otx_lapped_paste_all(otx_lapped *l)
{
    pasting *p = OTX_ZNEW(l->run->scratch, pasting, 1);

    if (!p)
        return otx_fail_memory(l->run, "map");
    p->l = l;
    OTX_TRY(begin(p));
    if (otx_lapped_is_whole(l))
    {
        const double reach = otx_lapped_whole_reach(l);

        p->spacing = otx_lapped_whole_spacing(l);
        OTX_TRY(run_passes(
            p,
            l->features.by_alpha                     ? CUT_OUT
            : l->settings.mode == OTX_LAPPED_PACKING ? PACKING
                                                     : CLUMPS,
            reach, reach));
    }
    return run_passes(p, SPLOTCHES, 0.0, l->settings.radius);
}
