/* vote.c -- the colours that windows agree on.
 *
 * Every other one is asked, as the black fields of a board lie: what those
 * between them say differs little. Where the map is coherent, all windows over
 * a texel lead to the same place: votes for one place are gathered before it is
 * looked up, which is one lookup a texel. */
#include "synth/vote.h"

#include "base/sort.h"
#include "synth/window_cost.h"

#define SIGMA 2.0f   /* texels, of votes by distance from the middle */
#define NEAR 0.0625f /* texels between two places that are looked up as one */
#define CHANGE 0.1f  /* of a channel in Lab units, that is worth a search */

enum
{
    SAMPLES = 8192 /* that a percentile is taken from */
};

typedef struct vote_job
{
    otx_canvas *const *canvases;
    const int32_t *chart_of, *first; /* [strips] */
    float scale;                     /* of trust; 0: even */
} vote_job;

static otx_status
percentile(
    otx_run *run, otx_canvas *const *canvases, int32_t count, double *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    double *values = OTX_NEW(run->scratch, double, SAMPLES);
    int64_t texels = 0, seen = 0, stride;
    size_t n = 0;

    if (!values)
        return otx_fail_memory(run, "synth");
    for (int32_t k = 0; k < count; ++k)
        texels += (int64_t)canvases[k]->width * canvases[k]->height;
    stride = texels / SAMPLES + 1;
    for (int32_t k = 0; k < count; ++k)
        for (int32_t y = 0; y < canvases[k]->height; ++y)
            for (int32_t x = 0; x < canvases[k]->width; ++x)
            {
                const ptrdiff_t at = otx_canvas_index(canvases[k], x, y);

                if (canvases[k]->uses[at] == OTX_CANVAS_SEEK &&
                    seen++ % stride == 0 && n < SAMPLES)
                    values[n++] = canvases[k]->costs[at];
            }
    otx_sort_doubles(values, n);
    *out = n > 0 ? values[(3 * n) / 4] : 0.0;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* No window is without any say: where all are bad, they are weighed, too. */
static void
trust_canvas(otx_canvas *c, float scale)
{
    const float side = (float)(2 * c->radius + 1);

    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            const float depth = scale * c->costs[at];

            if (c->uses[at] == OTX_CANVAS_SEEK)
                c->trust[at] = expf(depth < 30.0f ? -depth : -30.0f) *
                               (c->masses[at] / (side * side));
        }
    otx_canvas_wrap(c);
}

static otx_status
trust_one(void *context, int64_t index, otx_worker *worker)
{
    const vote_job *job = context;

    (void)worker;
    trust_canvas(job->canvases[index], job->scale);
    return OSDTEX_OK;
}

otx_status
otx_vote_trust(
    otx_run *run, otx_canvas *const *canvases, int32_t count, bool even)
{
    vote_job job = {.canvases = canvases};
    double spread = 0.0;

    OTX_TRY(percentile(run, canvases, count, &spread));
    job.scale = even ? 0.0f : 0.5f / (float)(spread + 1e-6);
    return otx_pool_for(run->pool, count, trust_one, &job);
}

/* Votes for a texel, those for one place together. */
typedef struct tally
{
    otx_quad sum[2];
    float weight;
    float x, y, pending; /* a place, and the votes for it; 0 none */
} tally;

static inline void
count_pending(const otx_canvas *c, int32_t quads, tally *t)
{
    otx_quad value[2];

    if (!(t->pending > 0.0f))
        return;
    otx_pattern_at(&c->pattern->levels[c->level], quads, t->x, t->y, value);
    for (int32_t q = 0; q < quads; ++q)
        t->sum[q] += value[q] * t->pending;
    t->weight += t->pending;
    t->pending = 0.0f;
}

static inline void
vote_for(
    const otx_canvas *c, int32_t quads, float x, float y, float weight,
    tally *t)
{
    if (fabsf(x - t->x) > NEAR || fabsf(y - t->y) > NEAR)
    {
        count_pending(c, quads, t);
        t->x = x;
        t->y = y;
    }
    t->pending += weight;
}

static inline void
gather_votes(
    const otx_canvas *c, int32_t quads, ptrdiff_t at, const float *bell,
    tally *t)
{
    const int32_t r = c->radius;

    for (int32_t j = -r; j <= r; ++j)
        for (int32_t i = -r + ((j + r) & 1); i <= r; i += 2, ++bell)
        {
            const ptrdiff_t from = at + (ptrdiff_t)j * c->stride + i;

            if (c->uses[from] == OTX_CANVAS_NONE)
                continue;

            const otx_window_frame f =
                otx_window_frame_of(c, from, c->matches[from]);
            const float x = f.x - f.xx * (float)i - f.xy * (float)j;
            const float y = f.y - f.yx * (float)i - f.yy * (float)j;

            vote_for(c, quads, x, y, *bell * c->trust[from], t);
        }
    count_pending(c, quads, t);
}

/* Returns whether the colour is another one now. */
static bool
settle(otx_canvas *c, ptrdiff_t at, const tally *t)
{
    const float share = c->anchor ? c->anchor_share[at] : 0.0f;
    bool changed = false;

    for (int32_t q = 0; q < c->voted; ++q)
    {
        otx_quad *color = &c->colors[at * c->quads + q];
        otx_quad now = t->sum[q] / t->weight;

        if (share > 0.0f)
            now += (c->anchor[at * c->quads + q] - now) * share;
        for (int i = 0; i < 4; ++i)
            changed = changed || fabsf(now[i] - (*color)[i]) > CHANGE;
        *color = now;
    }
    return changed;
}

static void
vote_texel(otx_canvas *c, ptrdiff_t at, const float *bell)
{
    tally t = {.x = -1e9f};

    c->changed[at] = 0;
    if (!c->votes[at])
        return;
    if (c->quads == 1)
        gather_votes(c, 1, at, bell, &t);
    else
        gather_votes(c, 2, at, bell, &t);
    if (t.weight > 0.0f)
        c->changed[at] = settle(c, at, &t);
}

static otx_status
vote_strip(void *context, int64_t index, otx_worker *worker)
{
    const vote_job *job = context;
    otx_canvas *c = job->canvases[job->chart_of[index]];
    const int32_t r = c->radius, first = job->first[index];
    const int32_t end = first + OTX_CANVAS_STRIP;
    float bell[(2 * OTX_CANVAS_RIM + 1) * (2 * OTX_CANVAS_RIM + 1)], *b = bell;

    (void)worker;
    for (int32_t j = -r; j <= r; ++j)
        for (int32_t i = -r + ((j + r) & 1); i <= r; i += 2)
            *b++ = expf((float)(i * i + j * j) / (-2.0f * SIGMA * SIGMA));
    for (int32_t y = first; y < end && y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
            vote_texel(c, otx_canvas_index(c, x, y), bell);
    return OSDTEX_OK;
}

static otx_status
vote_wrap(void *context, int64_t index, otx_worker *worker)
{
    const vote_job *job = context;

    (void)worker;
    otx_canvas_wrap(job->canvases[index]);
    otx_canvas_stir(job->canvases[index], false);
    return OSDTEX_OK;
}

otx_status
otx_vote_cast(otx_run *run, otx_canvas *const *canvases, int32_t count)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    vote_job job = {.canvases = canvases};
    int64_t strips;
    otx_status status;

    OTX_TRY(otx_canvas_cut(
        run, canvases, count, &job.chart_of, &job.first, &strips));
    status = otx_pool_for(run->pool, strips, vote_strip, &job);
    otx_arena_release(run->scratch, mark);
    OTX_TRY(status);
    return otx_pool_for(run->pool, count, vote_wrap, &job);
}
