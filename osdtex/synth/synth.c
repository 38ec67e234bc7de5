/* synth.c -- levels and rounds: search, exchange, vote. */
#include "synth/synth.h"

#include "synth/maker.h"
#include "synth/start.h"

#include <math.h>

/* Rounds of search and vote, by level from the finest. */
static const int32_t ROUNDS[] = {1, 2, 4, 8, 16, 16};

enum
{
    ROUNDS_CHOSEN = 8, /* there, of a start that has had its own */
    PASSES_FIRST = 4,
    PASSES = 2,
    FINE = 3 /* levels where little is found that the one above did not have */
};

static int32_t
rounds_at(const otx_maker *m, int32_t level)
{
    const otx_synth_options *o = m->options;
    const double effort = o->effort > 0.0 ? o->effort : 1.0;
    int32_t whole = ROUNDS[level];

    /* Charts that chose by themselves have to come to terms, where nothing
     * that was given stands between them. */
    if (level > 0 && level == m->level_count - 1)
        whole = o->rounds > 0               ? o->rounds
                : o->starts > 1 && o->given ? ROUNDS_CHOSEN
                                            : OTX_MAKER_ROUNDS_COARSEST;
    return (int32_t)ceil(effort * whole);
}

/* Of the first round. */
static int32_t
passes_at(const otx_maker *m, int32_t level)
{
    return level == 0 || (level < FINE && m->options->given) ? PASSES
                                                             : PASSES_FIRST;
}

static otx_status
rounds(otx_maker *m, int32_t level, int32_t count)
{
    for (int32_t round = 0; round < count; ++round)
    {
        OTX_TRY(otx_maker_search(
            m, level, round, round == 0 ? passes_at(m, level) : PASSES));
        /* Matches are what is handed out. */
        if (level > 0 || round + 1 < count)
            OTX_TRY(otx_maker_vote(m, level, false));
    }
    return OSDTEX_OK;
}

static otx_status
link_up(otx_maker *m, int32_t level)
{
    for (int32_t k = 0; k < m->count; ++k)
        m->canvases[k] = &m->stacks[k].levels[level];
    return otx_collar_link_up(
        m->run, m->charts, m->finest, m->canvases, m->count, m->collars);
}

static otx_status
make_level(otx_maker *m, int32_t level)
{
    OTX_TRY(link_up(m, level));
    if (level < m->level_count - 1)
    {
        for (int32_t k = 0; k < m->count; ++k)
            otx_canvas_descend(&m->stacks[k].levels[level + 1], m->canvases[k]);
        OTX_TRY(otx_maker_vote(m, level, false));
    }
    else
        OTX_TRY(otx_start_make(m, level));
    return rounds(m, level, rounds_at(m, level));
}

static void
hand_out(const otx_maker *m)
{
    for (int32_t k = 0; k < m->count; ++k)
    {
        const otx_canvas *c = m->finest[k];
        const otx_synth_chart *chart = &m->charts[k];

        for (int32_t y = 0; y < c->height; ++y)
            for (int32_t x = 0; x < c->width; ++x)
            {
                const int64_t to = (int64_t)y * c->width + x;
                const ptrdiff_t at = otx_canvas_index(c, x, y);

                if (c->kinds[at] == OTX_SYNTH_FREE ||
                    c->kinds[at] == OTX_SYNTH_COLLAR)
                    chart->matches[to] = c->matches[at];
                if (chart->costs)
                    chart->costs[to] = c->costs[at];
            }
    }
}

static otx_status
make(otx_maker *m)
{
    otx_run *run = m->run;
    const int32_t n = m->count;

    m->stacks = OTX_ZNEW(run->scratch, otx_canvas_stack, n);
    m->finest = OTX_NEW(run->scratch, otx_canvas *, n);
    m->canvases = OTX_NEW(run->scratch, otx_canvas *, n);
    m->collars = OTX_NEW(run->scratch, otx_collar, n);
    m->usage = OTX_NEW(run->scratch, otx_occurrence, 1);
    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < n; ++k)
    {
        OTX_TRY(otx_canvas_build(
            run, m->pattern, &m->charts[k], m->options, m->level_count,
            &m->stacks[k]));
        m->finest[k] = &m->stacks[k].levels[0];
    }
    for (int32_t l = 0; l < m->level_count; ++l)
        m->all +=
            (double)otx_maker_texels(m, l) * (PASSES * rounds_at(m, l) + 2);
    for (int32_t l = m->level_count - 1; l >= 0; --l)
        OTX_TRY(make_level(m, l));
    hand_out(m);
    return OSDTEX_OK;
}

otx_status
otx_synth_run(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *charts,
    int32_t chart_count, const otx_synth_options *options)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_maker m = {
        .run = run,
        .pattern = pattern,
        .charts = charts,
        .count = chart_count,
        .options = options,
        .level_count = options->levels < pattern->level_count
                           ? options->levels
                           : pattern->level_count};
    const otx_status status = chart_count > 0 ? make(&m) : OSDTEX_OK;

    otx_arena_release(run->scratch, mark);
    return status;
}
