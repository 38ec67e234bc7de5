/* nearest.c -- for every window of a canvas, a near one of the pattern. */
#include "synth/nearest.h"

#include "base/random.h"
#include "synth/window_cost.h"

#include <string.h>

#define NARROWER 0.4    /* a random step to the one before it */
#define BY_CHANCE 0.97f /* of the best cost that a random place has to have */
#define BY_NEIGHBOUR 1.01f /* and a neighbour's: ties make it coherent */
#define NO_MATCH 1e30f     /* the cost of what is barred */
#define SAME 0.02f /* texels of the level between two that are one place */

/* The search at one texel. */
typedef struct seeker
{
    const otx_nearest_pass *pass;
    otx_canvas *canvas;
    const otx_synth_chart *given;
    otx_occurrence *usage; /* the chart's own; NULL */
    int32_t chart;
    float cos_tolerance;
    /* Rows that are seen as they are now. */
    int32_t y_first, y_end;
} seeker;

static float
overuse(const seeker *s, otx_synth_match m)
{
    return s->usage
               ? s->usage->weight *
                     (float)s->usage
                         ->counts[otx_occurrence_cell(s->canvas->pattern, m)]
               : 0.0f;
}

/* Within the tolerance of the nearest of the field's directions. */
static bool
is_held(const seeker *s, ptrdiff_t at, otx_synth_match m)
{
    const float *f = s->canvas->field;
    const int32_t symmetry = s->pass->symmetry;

    if (!f || (f[2 * at] == 0.0f && f[2 * at + 1] == 0.0f))
        return true;

    const float along = m.c * f[2 * at] + m.s * f[2 * at + 1];
    const float across = m.s * f[2 * at] - m.c * f[2 * at + 1];

    return along >= s->cos_tolerance ||
           (symmetry > 1 && -along >= s->cos_tolerance) ||
           (symmetry > 2 && fabsf(across) >= s->cos_tolerance);
}

/* The texel of the chart that a texel of the level lies on. */
static int64_t
texel_of(const seeker *s, int32_t x, int32_t y)
{
    const otx_canvas *c = s->canvas;
    const int32_t i = (int32_t)(((float)x + 0.5f) * c->step_x);
    const int32_t j = (int32_t)(((float)y + 0.5f) * c->step_y);

    return (int64_t)j * s->given->width + i;
}

static bool
is_barred(const seeker *s, ptrdiff_t at, otx_synth_match m)
{
    const otx_canvas *c = s->canvas;
    const int32_t x = (int32_t)(at % c->stride) - OTX_CANVAS_RIM;
    const int32_t y = (int32_t)(at / c->stride) - OTX_CANVAS_RIM;

    if (s->pass->apart > 0.0f &&
        otx_nearest_is_near(c, x, y, m, s->pass->apart))
        return true;
    for (int32_t k = 0; k < s->given->barred_count; ++k)
    {
        const int32_t from = s->given->barred[k][texel_of(s, x, y)];
        const int32_t width = c->pattern->width;

        if (otx_nearest_is_beside(
                c->pattern, (float)(from % width) + 0.5f,
                (float)(from / width) + 0.5f, m, s->pass->barred_apart))
            return true;
    }
    return false;
}

static void
take(const seeker *s, ptrdiff_t at, otx_synth_match m, float cost)
{
    otx_canvas *c = s->canvas;

    if (s->usage)
    {
        --s->usage->counts[otx_occurrence_cell(c->pattern, c->matches[at])];
        ++s->usage->counts[otx_occurrence_cell(c->pattern, m)];
    }
    c->matches[at] = m;
    c->costs[at] = cost;
    c->moved[at] = 1;
}

/* Takes a candidate where its cost is below `factor` of what there is. */
static void
try_match(const seeker *s, ptrdiff_t at, otx_synth_match m, float factor)
{
    const otx_canvas *c = s->canvas;
    const float more = overuse(s, m);
    const float limit =
        factor * (c->costs[at] + overuse(s, c->matches[at])) - more;

    if (!(limit >= 0.0f) || !is_held(s, at, m) || is_barred(s, at, m))
        return;

    const otx_window_frame frame = otx_window_frame_of(c, at, m);

    if (!otx_window_is_inside(c, frame))
        return;

    const float cost = otx_window_cost(c, at, frame, limit);

    if (cost < limit || (cost == 0.0f && limit == 0.0f))
        take(s, at, m, cost);
}

/* Whether two matches are one, as far as the level can tell. */
static bool
is_same(const otx_canvas *c, otx_synth_match a, otx_synth_match b)
{
    const float near = SAME * c->step_x;

    return fabsf(a.x - b.x) < near && fabsf(a.y - b.y) < near &&
           fabsf(a.c - b.c) + fabsf(a.s - b.s) < SAME / 4.0f;
}

/* The match of the texel (-dx, -dy) away, gone on with. */
static void
try_neighbour(const seeker *s, int32_t x, int32_t y, int32_t dx, int32_t dy)
{
    const otx_canvas *c = s->canvas;
    const ptrdiff_t at = otx_canvas_index(c, x, y);
    const ptrdiff_t from = otx_canvas_index(c, x - dx, y - dy);
    const bool now = y - dy >= s->y_first && y - dy < s->y_end;

    if (c->uses[from] == OTX_CANVAS_NONE)
        return;

    const otx_synth_match m = otx_canvas_fold(
        c, otx_canvas_step(
               now ? c->matches[from] : c->before[from],
               otx_canvas_onto(c, from, (float)dx, (float)dy)));

    if (!is_same(c, m, c->matches[at]))
        try_match(s, at, m, BY_NEIGHBOUR);
}

/* In [-1, 1), of 21 bits. */
static double
signed_unit(uint64_t bits)
{
    return (double)(bits & 0x1fffff) * 0x1.0p-20 - 1.0;
}

static otx_synth_match
turned(otx_synth_match m, double angle)
{
    const float c = (float)cos(angle), s = (float)sin(angle);

    return (otx_synth_match){m.x, m.y, m.c * c - m.s * s, m.s * c + m.c * s};
}

otx_synth_match
otx_nearest_random(
    const otx_pattern *pattern, const float *field, double tolerance,
    uint64_t bits)
{
    const bool held = field && (field[0] != 0.0f || field[1] != 0.0f);
    const otx_synth_match m = {
        (float)(0.5 * (signed_unit(bits) + 1.0) * pattern->width),
        (float)(0.5 * (signed_unit(bits >> 21) + 1.0) * pattern->height),
        held ? field[0] : 1.0f, held ? field[1] : 0.0f};

    return turned(m, (held ? tolerance : OTX_PI) * signed_unit(bits >> 42));
}

static void
try_around(const seeker *s, ptrdiff_t at)
{
    const otx_nearest_pass *pass = s->pass;
    const otx_canvas *c = s->canvas;
    const double step = c->step_x;
    uint64_t k = 0;

    for (double reach = pass->reach; reach >= step; reach *= NARROWER, ++k)
    {
        const uint64_t bits = otx_random_bits(
            pass->seed, pass->number,
            ((uint64_t)(uint32_t)s->chart << 40) ^ ((uint64_t)at << 4) ^ k);
        const double swing = reach / (8.0 * step);
        otx_synth_match m = c->matches[at];

        m.x += (float)(reach * signed_unit(bits));
        m.y += (float)(reach * signed_unit(bits >> 21));
        m = turned(
            m, (swing < pass->turn ? swing : pass->turn) *
                   signed_unit(bits >> 42));
        try_match(s, at, otx_canvas_fold(c, m), BY_CHANCE);
    }
}

/* Whether nothing has happened around a texel since it was last looked at:
 * neither to the colours in its window nor to its neighbours' matches. */
static bool
is_quiet(const seeker *s, int32_t y, ptrdiff_t at)
{
    const otx_canvas *c = s->canvas;
    const ptrdiff_t up = c->stride;
    const uint8_t *was = c->was_moved + at, *now = c->moved + at;

    return !s->usage && !(s->pass->stirred && c->stirred[at]) && !was[0] &&
           !was[-1] && !was[1] && !was[-up] && !was[up] && !now[-1] &&
           !now[1] && (y == s->y_first || !now[-up]) &&
           (y + 1 == s->y_end || !now[up]);
}

static void
seek(const seeker *s, int32_t x, int32_t y, int32_t back)
{
    const otx_synth_chart *chart = s->given;
    otx_canvas *c = s->canvas;
    const ptrdiff_t at = otx_canvas_index(c, x, y);

    if (c->uses[at] != OTX_CANVAS_SEEK || is_quiet(s, y, at))
        return;
    /* What may not stay gives way to anything. */
    if (s->given->barred_count > 0 && is_barred(s, at, c->matches[at]))
        c->costs[at] = NO_MATCH;
    else if (s->pass->refresh)
        c->costs[at] = otx_window_cost(
            c, at, otx_window_frame_of(c, at, c->matches[at]), INFINITY);
    try_neighbour(s, x, y, back, 0);
    try_neighbour(s, x, y, 0, back);
    try_neighbour(s, x, y, back, back);
    if (s->pass->hint && chart->hints)
        try_match(
            s, at, otx_canvas_fold(c, chart->hints[texel_of(s, x, y)]),
            BY_NEIGHBOUR);
    try_around(s, at);
}

/* Every other pass goes the other way. */
static void
seek_rows(const seeker *s)
{
    const int32_t width = s->canvas->width, rows = s->y_end - s->y_first;
    const bool down = s->pass->number % 2 != 0;

    for (int32_t j = 0; j < rows; ++j)
        for (int32_t i = 0; i < width; ++i)
            seek(
                s, down ? width - 1 - i : i,
                down ? s->y_end - 1 - j : s->y_first + j, down ? -1 : 1);
}

/* Strips of charts; where usage counts, whole charts. */
typedef struct job
{
    otx_canvas *const *canvases;
    const otx_synth_chart *charts;
    const otx_nearest_pass *pass;
    const int32_t *chart_of, *first; /* [strips]; not of whole charts */
} job;

static otx_status
search_strip(void *context, int64_t index, otx_worker *worker)
{
    const job *j = context;
    const int32_t k = j->chart_of[index], y = j->first[index];
    otx_canvas *c = j->canvases[k];
    const int32_t end = y + OTX_CANVAS_STRIP;
    const seeker s = {
        .pass = j->pass,
        .canvas = c,
        .given = &j->charts[k],
        .chart = k,
        .cos_tolerance = (float)cos(j->pass->tolerance),
        .y_first = y,
        .y_end = end < c->height ? end : c->height};

    (void)worker;
    seek_rows(&s);
    return OSDTEX_OK;
}

/* Each chart counts on from what all took before the pass. */
static otx_status
search_whole(void *context, int64_t index, otx_worker *worker)
{
    const job *j = context;
    otx_canvas *c = j->canvases[index];
    seeker s = {
        .pass = j->pass,
        .canvas = c,
        .given = &j->charts[index],
        .usage = OTX_NEW(worker->scratch, otx_occurrence, 1),
        .chart = (int32_t)index,
        .cos_tolerance = (float)cos(j->pass->tolerance),
        .y_end = c->height};

    if (!s.usage)
        return OSDTEX_ERROR_MEMORY;
    *s.usage = *j->pass->usage;
    seek_rows(&s);
    return OSDTEX_OK;
}

static otx_status
remember(void *context, int64_t index, otx_worker *worker)
{
    const job *j = context;
    otx_canvas *c = j->canvases[index];
    const size_t count =
        (size_t)c->stride * (size_t)(c->height + 2 * OTX_CANVAS_RIM);

    (void)worker;
    memcpy(c->before, c->matches, count * sizeof *c->before);
    memcpy(c->was_moved, c->moved, count);
    memset(c->moved, 0, count);
    return OSDTEX_OK;
}

static otx_status
wrap(void *context, int64_t index, otx_worker *worker)
{
    const job *j = context;

    (void)worker;
    otx_canvas_wrap(j->canvases[index]);
    return OSDTEX_OK;
}

otx_status
otx_nearest_search(
    otx_run *run, otx_canvas *const *canvases, const otx_synth_chart *charts,
    int32_t count, const otx_nearest_pass *pass)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    job j = {.canvases = canvases, .charts = charts, .pass = pass};
    int64_t strips;
    otx_status status;

    OTX_TRY(
        otx_canvas_cut(run, canvases, count, &j.chart_of, &j.first, &strips));
    OTX_TRY(otx_pool_for(run->pool, count, remember, &j));
    status = pass->usage ? otx_pool_for(run->pool, count, search_whole, &j)
                         : otx_pool_for(run->pool, strips, search_strip, &j);
    otx_arena_release(run->scratch, mark);
    OTX_TRY(otx_loop_result(run, "synth", status));
    return otx_pool_for(run->pool, count, wrap, &j);
}
