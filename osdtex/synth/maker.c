/* maker.c -- the two halves of a round. */
#include "synth/maker.h"

#include "synth/nearest.h"
#include "synth/vote.h"

/* Rounds of the coarsest level in which usage is annealed, of those it has when
 * it begins by chance. */
#define ANNEALED (0.7 * OTX_MAKER_ROUNDS_COARSEST)

int64_t
otx_maker_texels(const otx_maker *m, int32_t level)
{
    int64_t sum = 0;

    for (int32_t k = 0; k < m->count; ++k)
        sum += (int64_t)m->stacks[k].levels[level].width *
               m->stacks[k].levels[level].height;
    return sum;
}

/* Of the first random step, in texels of the exemplar. Propagation does at the
 * finest level. */
static double
reach_at(const otx_maker *m, int32_t level)
{
    const otx_pattern *p = m->pattern;
    const double whole = p->width > p->height ? p->width : p->height;

    if (level == m->level_count - 1)
        return whole;
    if (level == 0)
        return 0.0;
    if (m->options->given)
        return level == 1 ? 6.0 : level == 2 ? 24.0 : 64.0;
    return level == 1 ? 24.0 : 64.0;
}

/* Falls to 0 over 7 tenths of the coarsest level's rounds. */
static double
usage_at(const otx_maker *m, int32_t level, int32_t round)
{
    const double left = 1.0 - round / ANNEALED;

    return level == m->level_count - 1 && left > 0.0 ? m->options->usage * left
                                                     : 0.0;
}

static otx_status
say(otx_maker *m, int32_t level)
{
    m->done += (double)otx_maker_texels(m, level);
    return otx_progress(
        m->run, m->options->stage, m->done < m->all ? m->done / m->all : 1.0);
}

otx_status
otx_maker_search(otx_maker *m, int32_t level, int32_t round, int32_t passes)
{
    const otx_synth_options *o = m->options;
    const double usage = usage_at(m, level, round);
    otx_nearest_pass pass = {
        .seed = o->seed,
        .reach = reach_at(m, level),
        .turn = o->turn,
        .tolerance = o->tolerance,
        .symmetry = o->symmetry,
        .barred_apart = (float)o->apart,
        .usage = usage > 0.0 ? m->usage : NULL};

    for (int32_t i = 0; i < passes; ++i)
    {
        pass.refresh = i == 0;
        pass.stirred = i < 2;
        pass.hint = i == 0 && round == 0;
        pass.number = m->passes++;
        if (pass.usage)
            otx_occurrence_count(
                (const otx_canvas *const *)m->canvases, m->count, usage,
                m->usage);
        OTX_TRY(otx_nearest_search(
            m->run, m->canvases, m->charts, m->count, &pass));
        if (level == 0)
            OTX_TRY(
                otx_collar_exchange(m->run, m->canvases, m->collars, m->count));
        OTX_TRY(say(m, level));
    }
    return OSDTEX_OK;
}

otx_status
otx_maker_vote(otx_maker *m, int32_t level, bool even)
{
    OTX_TRY(otx_vote_trust(m->run, m->canvases, m->count, even));
    OTX_TRY(otx_collar_exchange(m->run, m->canvases, m->collars, m->count));
    OTX_TRY(otx_vote_cast(m->run, m->canvases, m->count));
    if (level > 0 && m->options->histogram > 0.0)
        OTX_TRY(otx_vote_match_histogram(
            m->run, m->canvases, m->count, m->options->histogram));
    return OSDTEX_OK;
}
