/* chart_pack.c -- masks of cells, the lowest place, the scale by bisection. */
#include "bake/chart_pack.h"

#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "bake";

enum
{
    STEP = 4,         /* texels of a cell at least */
    CELLS_MOST = 320, /* of a tile's side */
    WORD = 64,        /* bits */
    ANGLES = 30,      /* between 0 and 90 degrees, tried for the smallest box */
    TURNS = 8,        /* from the one with the smallest box on */
    ORDERS = 3,
    SEARCH_STEPS = 12
};

/* A chart in one of its quarter turns: a bit for each cell that it or its
 * margin reaches into, rows from the bottom, from its own lower left. */
typedef struct mask
{
    int32_t width, height, words; /* words of a row */
    uint64_t *bits;               /* [height * words] */
} mask;

/* For sorting. */
typedef struct sized
{
    double value;
    int32_t chart;
} sized;

typedef struct packer
{
    otx_run *run;
    const otx_chart_rims *rims;
    int32_t step;  /* texels of a cell's side */
    int32_t cells; /* of a tile's side */
    int32_t words; /* of a row of the tile, and one that stays empty */
    double margin;
    otx_vec2 *turns;   /* [chart_count] for the smallest box */
    otx_vec2 *boxes;   /* [chart_count] its sides, scene units */
    sized *sizes;      /* [chart_count] */
    int32_t *order;    /* [chart_count] large ones first */
    uint64_t *tile;    /* [cells * words] what is taken */
    double *crossings; /* [most edges of a chart] of a column */
    mask tries[TURNS];
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

static int
by_size(const void *a, const void *b)
{
    const sized *x = a, *y = b;

    if (x->value != y->value)
        return x->value > y->value ? -1 : 1;
    return x->chart < y->chart ? -1 : 1;
}

/* How large a chart is by one of the measures that they are ordered by. */
static double
size_of(const packer *p, int32_t chart, int order)
{
    const otx_vec2 box = p->boxes[chart];

    return order == 0 ? box.x * box.y : order == 1 ? box.y : box.x + box.y;
}

static void
sort_charts(packer *p, int order)
{
    const int32_t count = p->rims->chart_count;

    for (int32_t i = 0; i < count; ++i)
        p->sizes[i] = (sized){size_of(p, i, order), i};
    qsort(p->sizes, (size_t)count, sizeof *p->sizes, by_size);
    for (int32_t i = 0; i < count; ++i)
        p->order[i] = p->sizes[i].chart;
}

/* ---- masks ----------------------------------------------------------------
 */

/* Sets the cells [low, high) of a column. */
static void
fill_column(mask *m, int32_t x, int32_t low, int32_t high)
{
    const int32_t end = high < m->height ? high : m->height;

    for (int32_t y = low < 0 ? 0 : low; y < end; ++y)
        m->bits[(size_t)y * (size_t)m->words + (size_t)(x / WORD)] |=
            (uint64_t)1 << (x % WORD);
}

/* Sets all cells in which a point may lie within the margin of an edge. */
static void
add_edge(const packer *p, mask *m, otx_vec2 a, otx_vec2 b)
{
    const double step = p->step, margin = p->margin;
    const otx_vec2 left = a.x <= b.x ? a : b, right = a.x <= b.x ? b : a;
    const int32_t first = (int32_t)floor((left.x - margin) / step);
    const int32_t last = (int32_t)floor((right.x + margin) / step);
    const double wide = right.x - left.x;

    for (int32_t k = first < 0 ? 0 : first; k <= last && k < m->width; ++k)
    {
        /* The part of the edge that comes within the margin of the column. */
        const double x0 = fmax(left.x, step * k - margin);
        const double x1 = fmin(right.x, step * (k + 1.0) + margin);
        const double t0 = wide > 0.0 ? fmin((x0 - left.x) / wide, 1.0) : 0.0;
        const double t1 = wide > 0.0 ? fmax((x1 - left.x) / wide, 0.0) : 1.0;
        const double y0 = left.y + t0 * (right.y - left.y);
        const double y1 = left.y + t1 * (right.y - left.y);

        fill_column(
            m, k, (int32_t)floor((fmin(y0, y1) - margin) / step),
            (int32_t)ceil((fmax(y0, y1) + margin) / step));
    }
}

static int
by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* End `i` of a chart's rim on the tile, its lower left corner at (0, 0). */
static otx_vec2
end_at(const packer *p, int32_t i, otx_vec2 turn, double scale, otx_vec2 shift)
{
    return otx_vec2_add(
        shift, otx_vec2_scale(scale, turned(turn, p->rims->ends[i])));
}

/* Sets what is inside of the rim, by the middles of the columns. */
static void
fill_inside(
    const packer *p, int32_t chart, otx_vec2 turn, double scale, otx_vec2 shift,
    mask *m)
{
    for (int32_t k = 0; k < m->width; ++k)
    {
        const double x = p->step * (k + 0.5);
        int32_t count = 0;

        for (int32_t i = p->rims->first[chart]; i < p->rims->first[chart + 1];
             ++i)
        {
            const otx_vec2 a = end_at(p, 2 * i, turn, scale, shift);
            const otx_vec2 b = end_at(p, 2 * i + 1, turn, scale, shift);

            if ((a.x <= x) != (b.x <= x))
                p->crossings[count++] =
                    a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
        }
        qsort(p->crossings, (size_t)count, sizeof *p->crossings, by_value);
        for (int32_t i = 0; i + 1 < count; i += 2)
            fill_column(
                m, k, (int32_t)floor(p->crossings[i] / p->step),
                (int32_t)ceil(p->crossings[i + 1] / p->step));
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
make_mask(const packer *p, int32_t chart, otx_vec2 turn, double scale, mask *m)
{
    otx_vec2 box;
    const otx_vec2 shift = shift_of(p, chart, turn, scale, &box);
    const double width = ceil((box.x + 2.0 * p->margin) / p->step);
    const double height = ceil((box.y + 2.0 * p->margin) / p->step);

    if (!(width <= p->cells && height <= p->cells))
        return false;
    m->width = (int32_t)width;
    m->height = (int32_t)height;
    m->words = (m->width + WORD - 1) / WORD;
    memset(m->bits, 0, (size_t)m->height * (size_t)m->words * sizeof *m->bits);
    for (int32_t i = p->rims->first[chart]; i < p->rims->first[chart + 1]; ++i)
        add_edge(
            p, m, end_at(p, 2 * i, turn, scale, shift),
            end_at(p, 2 * i + 1, turn, scale, shift));
    fill_inside(p, chart, turn, scale, shift, m);
    return true;
}

/* ---- setting down ---------------------------------------------------------
 */

/* Word `w` of a mask's row that begins at bit `shift`. */
static uint64_t
shifted(const mask *m, const uint64_t *row, int32_t w, int shift)
{
    const uint64_t own = w < m->words ? row[w] << shift : 0;

    return w > 0 && shift > 0 ? own | row[w - 1] >> (WORD - shift) : own;
}

static bool
fits(const packer *p, const mask *m, int32_t x, int32_t y)
{
    const int32_t first = x / WORD;
    const int shift = x % WORD;

    for (int32_t j = 0; j < m->height; ++j)
    {
        const uint64_t *row = m->bits + (size_t)j * (size_t)m->words;
        const uint64_t *taken =
            p->tile + (size_t)(y + j) * (size_t)p->words + first;

        for (int32_t w = 0; w <= m->words && first + w < p->words; ++w)
            if (taken[w] & shifted(m, row, w, shift))
                return false;
    }
    return true;
}

static void
take_cells(const packer *p, const mask *m, int32_t x, int32_t y)
{
    const int32_t first = x / WORD;
    const int shift = x % WORD;

    for (int32_t j = 0; j < m->height; ++j)
    {
        const uint64_t *row = m->bits + (size_t)j * (size_t)m->words;
        uint64_t *taken = p->tile + (size_t)(y + j) * (size_t)p->words + first;

        for (int32_t w = 0; w <= m->words && first + w < p->words; ++w)
            taken[w] |= shifted(m, row, w, shift);
    }
}

typedef struct spot
{
    int32_t x, y, top;
    int turn; /* -1: none */
} spot;

/* The first place from the bottom, then from the left, if its top is lower than
 * that of `best`. */
static void
seek(const packer *p, const mask *m, int turn, spot *best)
{
    for (int32_t y = 0; y + m->height <= p->cells &&
                        (best->turn < 0 || y + m->height < best->top);
         ++y)
        for (int32_t x = 0; x + m->width <= p->cells; ++x)
            if (fits(p, m, x, y))
            {
                *best = (spot){x, y, y + m->height, turn};
                return;
            }
}

static otx_vec2
further(otx_vec2 turn, int eighths)
{
    return turned(otx_vec2_polar(0.25 * OTX_PI * eighths), turn);
}

/* Sets a chart down where there is room; false where the tile has none. */
static bool
set_down(packer *p, int32_t chart, double scale, int32_t tile)
{
    otx_chart_place *place = &p->places[chart];
    spot best = {.turn = -1};
    otx_vec2 box, turn;

    for (int i = 0; i < TURNS; ++i)
        if (make_mask(
                p, chart, further(p->turns[chart], i), scale, &p->tries[i]))
            seek(p, &p->tries[i], i, &best);
    if (best.turn < 0)
        return false;
    take_cells(p, &p->tries[best.turn], best.x, best.y);
    turn = further(p->turns[chart], best.turn);
    *place = (otx_chart_place){
        turn,
        otx_vec2_add(
            shift_of(p, chart, turn, scale, &box),
            (otx_vec2){(double)p->step * best.x, (double)p->step * best.y}),
        tile};
    return true;
}

static void
clear_tile(packer *p)
{
    memset(p->tile, 0, (size_t)p->cells * (size_t)p->words * sizeof *p->tile);
}

/* How many tiles are taken, up to `most`; 0 where that does not do. */
static int32_t
pack(packer *p, double scale, int32_t most)
{
    int32_t tile = 0;

    clear_tile(p);
    for (int32_t i = 0; i < p->rims->chart_count; ++i)
    {
        if (set_down(p, p->order[i], scale, tile))
            continue;
        if (++tile == most)
            return 0;
        clear_tile(p);
        if (!set_down(p, p->order[i], scale, tile))
            return 0;
    }
    return tile + 1;
}

/* Narrows [low, high], of which all lie on one tile with `low`. */
static otx_status
bisect(packer *p, double *low, double high)
{
    for (int32_t i = 0; i < SEARCH_STEPS && high > 1.001 * *low; ++i)
    {
        const double middle = 0.5 * (*low + high);

        OTX_TRY(otx_progress(p->run, STAGE, 0.0));
        if (pack(p, middle, 1) == 1)
            *low = middle;
        else
            high = middle;
    }
    return OSDTEX_OK;
}

/* The most texels to a unit with which all lie on one tile, in any order, which
 * is left sorted; 0: none. */
static otx_status
find_scale(packer *p, double *out)
{
    double high = INFINITY, area = 0.0, low;
    int best = 0;

    for (int32_t i = 0; i < p->rims->chart_count; ++i)
    {
        area += p->boxes[i].x * p->boxes[i].y;
        high = fmin(high, p->step * p->cells / fmax(p->boxes[i].y, 1e-300));
    }
    /* Boxes may overlap, to three times their area at most. */
    high = fmin(high, p->step * p->cells * sqrt(3.0 / fmax(area, 1e-300)));
    for (low = 0.3 * high; pack(p, low, 1) != 1; low *= 0.5)
    {
        OTX_TRY(otx_progress(p->run, STAGE, 0.0));
        high = low;
        if (low * sqrt(area) < 1.0)
            return OSDTEX_OK;
    }
    OTX_TRY(bisect(p, &low, high));
    for (int order = 1; order < ORDERS; ++order)
    {
        const double more = 1.01 * low;

        sort_charts(p, order);
        if (!(more < high) || pack(p, more, 1) != 1)
            continue;
        best = order;
        low = more;
        OTX_TRY(bisect(p, &low, fmin(1.1 * low, high)));
    }
    sort_charts(p, best);
    *out = low;
    return OSDTEX_OK;
}

static otx_status
prepare(packer *p)
{
    otx_arena *scratch = p->run->scratch;
    const int32_t count = p->rims->chart_count;
    int32_t most = 1;

    p->turns = OTX_NEW(scratch, otx_vec2, count);
    p->boxes = OTX_NEW(scratch, otx_vec2, count);
    p->order = OTX_NEW(scratch, int32_t, count);
    p->sizes = OTX_NEW(scratch, sized, count);
    p->tile = OTX_NEW(scratch, uint64_t, (size_t)p->cells * (size_t)p->words);
    for (int i = 0; i < TURNS; ++i)
        p->tries[i].bits =
            OTX_NEW(scratch, uint64_t, (size_t)p->cells * (size_t)p->words);
    for (int32_t i = 0; i < count; ++i)
    {
        const int32_t edges = p->rims->first[i + 1] - p->rims->first[i];

        most = edges > most ? edges : most;
    }
    p->crossings = OTX_NEW(scratch, double, most);
    p->places = OTX_NEW(p->run->arena, otx_chart_place, count);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t i = 0; i < count; ++i)
        find_box(p, i);
    sort_charts(p, 0);
    return OSDTEX_OK;
}

otx_status
otx_chart_pack(
    otx_run *run, const otx_chart_rims *rims, int32_t side, int32_t margin,
    double scale, otx_chart_packing *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    packer p = {.run = run, .rims = rims, .margin = margin};

    p.step = STEP * ((side / STEP + CELLS_MOST - 1) / CELLS_MOST);
    p.cells = side / p.step;
    p.words = p.cells / WORD + 2;
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
