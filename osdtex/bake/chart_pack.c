/* chart_pack.c -- profiles, a horizon, and the scale by bisection. */
#include "bake/chart_pack.h"

#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "bake";

enum
{
    STEP = 4,    /* texels of a column */
    ANGLES = 30, /* between 0 and 90 degrees, tried for the smallest box */
    QUARTERS = 4,
    SEARCH_STEPS = 18
};

/* A chart in one of its quarter turns: the lowest and the one above the highest
 * cell of each column, margins included, from its own lower left. */
typedef struct profile
{
    int32_t width, height;
    int32_t *low, *high; /* [width] */
} profile;

typedef struct packer
{
    otx_run *run;
    const otx_chart_rims *rims;
    int32_t columns; /* of a tile, and its rows */
    double margin;
    otx_vec2 *turns;  /* [chart_count] for the smallest box */
    otx_vec2 *boxes;  /* [chart_count] its sides, scene units */
    int32_t *order;   /* [chart_count] high ones first */
    int32_t *horizon; /* [columns] */
    profile tries[QUARTERS];
    otx_chart_place *places;
} packer;

/* ---- boxes ----------------------------------------------------------------
 */

static otx_vec2
turned(otx_vec2 turn, otx_vec2 p)
{
    return otx_vec2_mul(turn, p);
}

static void
bounds_of(
    const packer *p, int32_t chart, otx_vec2 turn, otx_vec2 *low,
    otx_vec2 *high)
{
    *low = (otx_vec2){INFINITY, INFINITY};
    *high = (otx_vec2){-INFINITY, -INFINITY};
    for (int32_t i = 2 * p->rims->first[chart];
         i < 2 * p->rims->first[chart + 1]; ++i)
    {
        const otx_vec2 q = turned(turn, p->rims->ends[i]);

        *low = (otx_vec2){fmin(low->x, q.x), fmin(low->y, q.y)};
        *high = (otx_vec2){fmax(high->x, q.x), fmax(high->y, q.y)};
    }
}

/* The turn of the smallest box, upright. */
static void
find_box(packer *p, int32_t chart)
{
    double least = INFINITY;

    for (int32_t i = 0; i < ANGLES; ++i)
    {
        const otx_vec2 turn = otx_vec2_polar(0.5 * OTX_PI * i / ANGLES);
        otx_vec2 low, high, box;

        bounds_of(p, chart, turn, &low, &high);
        box = otx_vec2_sub(high, low);
        if (!(box.x * box.y < least))
            continue;
        least = box.x * box.y;
        p->turns[chart] =
            box.x > box.y ? turned((otx_vec2){0.0, 1.0}, turn) : turn;
        p->boxes[chart] = (otx_vec2){fmin(box.x, box.y), fmax(box.x, box.y)};
    }
}

typedef struct upright
{
    double value;
    int32_t chart;
} upright;

static int
by_height(const void *a, const void *b)
{
    const upright *x = a, *y = b;

    if (x->value != y->value)
        return x->value > y->value ? -1 : 1;
    return x->chart < y->chart ? -1 : 1;
}

static otx_status
sort_charts(packer *p)
{
    const int32_t count = p->rims->chart_count;
    upright *heights = OTX_NEW(p->run->scratch, upright, count);

    OTX_TRY(otx_run_ok(p->run));
    for (int32_t i = 0; i < count; ++i)
        heights[i] = (upright){p->boxes[i].y, i};
    qsort(heights, (size_t)count, sizeof *heights, by_height);
    for (int32_t i = 0; i < count; ++i)
        p->order[i] = heights[i].chart;
    return OSDTEX_OK;
}

/* ---- profiles -------------------------------------------------------------
 */

/* Widens the profile by an edge, whose every point keeps the margin free. */
static void
add_edge(profile *f, otx_vec2 a, otx_vec2 b, double margin)
{
    const otx_vec2 left = a.x <= b.x ? a : b, right = a.x <= b.x ? b : a;
    const int32_t first = (int32_t)floor((left.x - margin) / STEP);
    const int32_t last = (int32_t)floor((right.x + margin) / STEP);

    for (int32_t k = first < 0 ? 0 : first; k <= last && k < f->width; ++k)
    {
        /* The part of the edge that comes within the margin of the column. */
        const double x0 = fmax(left.x, STEP * (double)k - margin);
        const double x1 = fmin(right.x, STEP * (k + 1.0) + margin);
        const double wide = right.x - left.x;
        const double t0 = wide > 0.0 ? fmin((x0 - left.x) / wide, 1.0) : 0.0;
        const double t1 = wide > 0.0 ? fmax((x1 - left.x) / wide, 0.0) : 1.0;
        const double y0 = left.y + t0 * (right.y - left.y);
        const double y1 = left.y + t1 * (right.y - left.y);
        const int32_t low = (int32_t)floor((fmin(y0, y1) - margin) / STEP);
        const int32_t high = (int32_t)ceil((fmax(y0, y1) + margin) / STEP);

        f->low[k] = low < f->low[k] ? low : f->low[k];
        f->high[k] = high > f->high[k] ? high : f->high[k];
    }
}

/* The shift by which a turned and scaled chart keeps its margin from (0, 0). */
static otx_vec2
shift_of(
    const packer *p, int32_t chart, otx_vec2 turn, double scale, otx_vec2 *box)
{
    otx_vec2 low, high;

    bounds_of(p, chart, turn, &low, &high);
    *box = otx_vec2_scale(scale, otx_vec2_sub(high, low));
    return (otx_vec2){p->margin - scale * low.x, p->margin - scale * low.y};
}

/* False where it is wider or higher than a tile. */
static bool
make_profile(
    const packer *p, int32_t chart, otx_vec2 turn, double scale, profile *f)
{
    otx_vec2 box;
    const otx_vec2 shift = shift_of(p, chart, turn, scale, &box);
    const double width = ceil((box.x + 2.0 * p->margin) / STEP);
    const double height = ceil((box.y + 2.0 * p->margin) / STEP);

    if (!(width <= p->columns && height <= p->columns))
        return false;
    f->width = (int32_t)width;
    f->height = (int32_t)height;
    for (int32_t k = 0; k < f->width; ++k)
    {
        f->low[k] = f->height;
        f->high[k] = 0;
    }
    for (int32_t i = p->rims->first[chart]; i < p->rims->first[chart + 1]; ++i)
        add_edge(
            f,
            otx_vec2_add(
                shift,
                otx_vec2_scale(scale, turned(turn, p->rims->ends[2 * i]))),
            otx_vec2_add(
                shift,
                otx_vec2_scale(scale, turned(turn, p->rims->ends[2 * i + 1]))),
            p->margin);
    for (int32_t k = 0; k < f->width; ++k)
        if (f->low[k] < 0)
            f->low[k] = 0;
    return true;
}

/* ---- setting down ---------------------------------------------------------
 */

/* The lowest place: how high its top comes, and what is lost below it. */
typedef struct spot
{
    int32_t x, y, top;
    int64_t lost;
    int quarter; /* -1: none */
} spot;

static void
seek(const packer *p, const profile *f, int quarter, spot *best)
{
    for (int32_t x = 0; x + f->width <= p->columns; ++x)
    {
        int32_t y = 0;
        int64_t lost = 0;

        for (int32_t k = 0; k < f->width; ++k)
        {
            const int32_t own = p->horizon[x + k] - f->low[k];

            y = own > y ? own : y;
        }
        if (y + f->height > p->columns ||
            (best->quarter >= 0 && y + f->height > best->top))
            continue;
        for (int32_t k = 0; k < f->width; ++k)
            lost += y + f->low[k] - p->horizon[x + k];
        if (best->quarter < 0 || y + f->height < best->top || lost < best->lost)
            *best = (spot){x, y, y + f->height, lost, quarter};
    }
}

static otx_vec2
quarter_turn(otx_vec2 turn, int quarter)
{
    static const otx_vec2 QUARTER[QUARTERS] = {
        {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};

    return turned(QUARTER[quarter], turn);
}

/* Sets a chart down on the horizon; false where the tile has no room. */
static bool
set_down(packer *p, int32_t chart, double scale, int32_t tile)
{
    otx_chart_place *place = &p->places[chart];
    spot best = {.quarter = -1};
    otx_vec2 box, turn;
    const profile *f;

    for (int quarter = 0; quarter < QUARTERS; ++quarter)
        if (make_profile(
                p, chart, quarter_turn(p->turns[chart], quarter), scale,
                &p->tries[quarter]))
            seek(p, &p->tries[quarter], quarter, &best);
    if (best.quarter < 0)
        return false;
    f = &p->tries[best.quarter];
    for (int32_t k = 0; k < f->width; ++k)
        if (best.y + f->high[k] > p->horizon[best.x + k])
            p->horizon[best.x + k] = best.y + f->high[k];
    turn = quarter_turn(p->turns[chart], best.quarter);
    *place = (otx_chart_place){
        turn,
        otx_vec2_add(
            shift_of(p, chart, turn, scale, &box),
            (otx_vec2){STEP * (double)best.x, STEP * (double)best.y}),
        tile};
    return true;
}

/* How many tiles are taken, up to `most`; 0 where that does not do. */
static int32_t
pack(packer *p, double scale, int32_t most)
{
    int32_t tile = 0;

    memset(p->horizon, 0, (size_t)p->columns * sizeof *p->horizon);
    for (int32_t i = 0; i < p->rims->chart_count; ++i)
    {
        if (set_down(p, p->order[i], scale, tile))
            continue;
        if (++tile == most)
            return 0;
        memset(p->horizon, 0, (size_t)p->columns * sizeof *p->horizon);
        if (!set_down(p, p->order[i], scale, tile))
            return 0;
    }
    return tile + 1;
}

/* The most texels to a unit with which all lie on one tile; 0: none. */
static otx_status
find_scale(packer *p, double *out)
{
    double low = 0.0, high = INFINITY, area = 0.0;

    for (int32_t i = 0; i < p->rims->chart_count; ++i)
    {
        area += p->boxes[i].x * p->boxes[i].y;
        high = fmin(high, STEP * p->columns / fmax(p->boxes[i].y, 1e-300));
    }
    /* Boxes may overlap, to three times their area at most. */
    high = fmin(high, STEP * p->columns * sqrt(3.0 / fmax(area, 1e-300)));
    for (int32_t i = 0; i < SEARCH_STEPS; ++i)
    {
        const double middle = 0.5 * (low + high);

        OTX_TRY(otx_progress(p->run, STAGE, 0.0));
        if (pack(p, middle, 1) == 1)
            low = middle;
        else
            high = middle;
    }
    *out = low;
    return OSDTEX_OK;
}

static otx_status
prepare(packer *p)
{
    otx_arena *scratch = p->run->scratch;
    const int32_t count = p->rims->chart_count;

    p->turns = OTX_NEW(scratch, otx_vec2, count);
    p->boxes = OTX_NEW(scratch, otx_vec2, count);
    p->order = OTX_NEW(scratch, int32_t, count);
    p->horizon = OTX_NEW(scratch, int32_t, p->columns);
    for (int i = 0; i < QUARTERS; ++i)
    {
        p->tries[i].low = OTX_NEW(scratch, int32_t, p->columns);
        p->tries[i].high = OTX_NEW(scratch, int32_t, p->columns);
    }
    p->places = OTX_NEW(p->run->arena, otx_chart_place, count);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t i = 0; i < count; ++i)
        find_box(p, i);
    return sort_charts(p);
}

otx_status
otx_chart_pack(
    otx_run *run, const otx_chart_rims *rims, int32_t side, int32_t margin,
    double scale, otx_chart_packing *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    packer p = {
        .run = run, .rims = rims, .columns = side / STEP, .margin = margin};

    OTX_TRY(prepare(&p));
    *out = (otx_chart_packing){.scale = scale, .places = p.places};
    if (!(scale > 0.0))
        OTX_TRY(find_scale(&p, &out->scale));
    if (out->scale > 0.0)
        out->tile_count = pack(&p, out->scale, scale > 0.0 ? INT32_MAX : 1);
    otx_arena_release(run->scratch, mark);
    if (out->tile_count > 0)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
        "%d charts with margins of %d texels do not fit a texture of %d texels "
        "a side; raise the resolution, lower the texels per unit, or bake to "
        "an atlas",
        rims->chart_count, margin, side);
}
