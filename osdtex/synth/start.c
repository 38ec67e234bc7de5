/* start.c -- what the coarsest level begins with.
 *
 * Which bricks go where is settled in the first rounds of the coarsest level,
 * and from one start many a stone comes out fused. The level is small, so
 * several are tried: the given one, and others by chance, in which what is to
 * be made weighs little beside what is frozen until it has taken its shape
 * [Wexler07, sec. 3.2]. Least mean distance wins, chart by chart. */
#include "synth/start.h"

#include "base/random.h"
#include "synth/nearest.h"

#include <string.h>

#define HOLE_FIRST 0.05f /* weight of what is to be made */
#define HOLE_LAST 0.45f

enum
{
    STAGE_SCATTER = 0x7fff0000, /* of random numbers; no pass has it */
    ROUNDS = 16,
    PASSES = 2
};

/* What a start is begun from, and the best one so far. */
typedef struct trial
{
    otx_synth_match *given, *best;
    otx_quad *colors;
    double cost; /* of the best */
} trial;

/* Matches by chance on what is FREE. */
static void
scatter(otx_maker *m, int32_t k, uint32_t start)
{
    otx_canvas *c = m->canvases[k];

    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            if (c->kinds[at] == OTX_SYNTH_FREE)
                c->matches[at] = otx_nearest_random(
                    m->pattern, c->field ? c->field + 2 * at : NULL,
                    m->options->tolerance,
                    otx_random_bits(
                        m->options->seed, STAGE_SCATTER + start,
                        ((uint64_t)(uint32_t)k << 40) ^ (uint64_t)at));
        }
    otx_canvas_wrap(c);
}

static size_t
texels_of(const otx_canvas *c)
{
    return (size_t)c->stride * (size_t)(c->height + 2 * OTX_CANVAS_RIM);
}

static otx_status
keep(otx_maker *m, trial *trials)
{
    otx_arena *arena = m->run->scratch;

    for (int32_t k = 0; k < m->count; ++k)
    {
        const otx_canvas *c = m->canvases[k];
        const size_t n = texels_of(c);
        trial *t = &trials[k];

        t->given = OTX_NEW(arena, otx_synth_match, n);
        t->best = OTX_NEW(arena, otx_synth_match, n);
        t->colors = OTX_NEW(arena, otx_quad, n * (size_t)c->quads);
        t->cost = INFINITY;
        OTX_TRY(otx_run_ok(m->run));
        memcpy(t->given, c->matches, n * sizeof *t->given);
        memcpy(t->colors, c->colors, n * (size_t)c->quads * sizeof *t->colors);
    }
    return OSDTEX_OK;
}

static void
restore(otx_maker *m, const trial *trials)
{
    for (int32_t k = 0; k < m->count; ++k)
    {
        otx_canvas *c = m->canvases[k];
        const size_t n = texels_of(c);

        memcpy(c->matches, trials[k].given, n * sizeof *c->matches);
        memcpy(
            c->colors, trials[k].colors,
            n * (size_t)c->quads * sizeof *c->colors);
    }
}

static double
cost_of(const otx_canvas *c)
{
    double sum = 0.0;

    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            if (c->uses[at] == OTX_CANVAS_SEEK)
                sum += sqrt(c->costs[at]);
        }
    return sum;
}

static void
compare(otx_maker *m, trial *trials)
{
    for (int32_t k = 0; k < m->count; ++k)
    {
        const otx_canvas *c = m->canvases[k];
        const double cost = cost_of(c);

        if (!(cost < trials[k].cost))
            continue;
        trials[k].cost = cost;
        memcpy(trials[k].best, c->matches, texels_of(c) * sizeof *c->matches);
    }
}

/* The weight of what is to be made: low for the first half of the rounds. */
static float
hole_at(int32_t round)
{
    return round < ROUNDS / 2
               ? HOLE_FIRST + (HOLE_LAST - HOLE_FIRST) * (float)round /
                                  (float)(ROUNDS / 2 - 1)
               : 1.0f;
}

static otx_status
try_start(otx_maker *m, int32_t level, uint32_t start, trial *trials)
{
    const bool given = start == 0 && m->options->given;

    restore(m, trials);
    for (int32_t k = 0; k < m->count && !given; ++k)
        scatter(m, k, start);
    if (!given)
        OTX_TRY(otx_maker_vote(m, level, true));
    for (int32_t round = 0; round < ROUNDS; ++round)
    {
        for (int32_t k = 0; k < m->count && !given; ++k)
            otx_canvas_weigh(m->canvases[k], hole_at(round));
        OTX_TRY(otx_maker_search(m, level, round, PASSES));
        OTX_TRY(otx_maker_vote(m, level, false));
    }
    compare(m, trials);
    return OSDTEX_OK;
}

static otx_status
choose(otx_maker *m, int32_t level)
{
    trial *trials = OTX_ZNEW(m->run->scratch, trial, m->count);

    OTX_TRY(otx_run_ok(m->run));
    OTX_TRY(keep(m, trials));
    for (int32_t start = 0; start < m->options->starts; ++start)
        OTX_TRY(try_start(m, level, (uint32_t)start, trials));
    for (int32_t k = 0; k < m->count; ++k)
        memcpy(
            m->canvases[k]->matches, trials[k].best,
            texels_of(m->canvases[k]) * sizeof *trials[k].best);
    return otx_maker_vote(m, level, true);
}

otx_status
otx_start_make(otx_maker *m, int32_t level)
{
    const otx_arena_mark mark = otx_arena_here(m->run->scratch);
    otx_status status = OSDTEX_OK;

    if (m->options->starts > 1)
        status = choose(m, level);
    else if (!m->options->given)
    {
        for (int32_t k = 0; k < m->count; ++k)
            scatter(m, k, 0);
        status = otx_maker_vote(m, level, true);
    }
    otx_arena_release(m->run->scratch, mark);
    return status;
}
