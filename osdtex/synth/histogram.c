/* histogram.c -- as much light and dark as the pattern has.
 *
 * Votes are means and means are flat: a random start loses a tenth of the
 * exemplar's contrast and comes to rest on its commonest colours. So after each
 * vote lightness is drawn to the value that has the same rank in the pattern
 * [Kopf07, sec. 4.2, which weighs histograms instead]. */
#include "synth/vote.h"

#include "base/sort.h"

enum
{
    RANKS = 256
};

/* Lightness at RANKS even ranks, of every `stride`-th value. */
typedef struct ladder
{
    double *values;
    size_t count;
    float steps[RANKS];
} ladder;

static void
climb(ladder *l)
{
    otx_sort_doubles(l->values, l->count);
    for (int32_t r = 0; r < RANKS; ++r)
        l->steps[r] =
            (float)l->values[(size_t)r * (l->count - 1) / (RANKS - 1)];
}

static void
take_pattern(const otx_pattern *p, int32_t level, ladder *l)
{
    const otx_pattern_level *of = &p->levels[level];

    for (int32_t y = 0; y < of->height; ++y)
        for (int32_t x = 0; x < of->width; ++x)
            l->values[l->count++] =
                of->values
                    [((ptrdiff_t)(y + OTX_PATTERN_RIM) * of->stride + x +
                      OTX_PATTERN_RIM) *
                     p->quads][0];
}

static void
take_canvas(const otx_canvas *c, ladder *l)
{
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            if (c->kinds[at] == OTX_SYNTH_FREE)
                l->values[l->count++] = c->colors[at * c->quads][0];
        }
}

/* Where v is on the ladder, as the value that another one has there. */
static float
moved(const ladder *from, const ladder *to, float v)
{
    int32_t low = 0, high = RANKS - 1;

    while (high - low > 1)
    {
        const int32_t middle = (low + high) / 2;

        if (from->steps[middle] <= v)
            low = middle;
        else
            high = middle;
    }

    const float span = from->steps[high] - from->steps[low];
    const float t = span > 0.0f ? (v - from->steps[low]) / span : 0.5f;

    return to->steps[low] + (t < 0.0f   ? 0.0f
                             : t > 1.0f ? 1.0f
                                        : t) *
                                (to->steps[high] - to->steps[low]);
}

static void
move_canvas(const ladder *from, const ladder *to, float share, otx_canvas *c)
{
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            otx_quad *color = &c->colors[at * c->quads];

            if (c->votes[at])
                (*color)[0] +=
                    share * (moved(from, to, (*color)[0]) - (*color)[0]);
        }
    otx_canvas_wrap(c);
}

static otx_status
match_ladders(
    otx_run *run, otx_canvas *const *canvases, int32_t count, double share)
{
    const otx_pattern *p = canvases[0]->pattern;
    const otx_pattern_level *level = &p->levels[canvases[0]->level];
    int64_t texels = 0;
    ladder *from = OTX_ZNEW(run->scratch, ladder, 2), *to = from + 1;

    for (int32_t k = 0; k < count; ++k)
        texels += (int64_t)canvases[k]->width * canvases[k]->height;
    OTX_TRY(otx_run_ok(run));
    from->values = OTX_NEW(run->scratch, double, texels);
    to->values =
        OTX_NEW(run->scratch, double, (int64_t)level->width * level->height);
    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < count; ++k)
        take_canvas(canvases[k], from);
    if (from->count == 0)
        return OSDTEX_OK;
    take_pattern(p, canvases[0]->level, to);
    climb(from);
    climb(to);
    for (int32_t k = 0; k < count; ++k)
        move_canvas(from, to, (float)share, canvases[k]);
    return OSDTEX_OK;
}

otx_status
otx_vote_match_histogram(
    otx_run *run, otx_canvas *const *canvases, int32_t count, double share)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_status status = match_ladders(run, canvases, count, share);

    otx_arena_release(run->scratch, mark);
    return status;
}
