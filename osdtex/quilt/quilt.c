/* quilt.c -- expansion moves over sheets of texels. */
#include "quilt/quilt.h"
#include "math/maxflow.h"

#include <math.h>
#include <string.h>

enum
{
    ABSENT = 1 << 10, /* where a sheet has a hole: no distance */
    /* Of a squared unit of distance: the most different colours cost less than
     * 2^18, and a hole more than 64 of them. */
    TOLL_UNIT = 4,
    ABSENT_TOLL = 1 << 24
};

static const char STAGE[] = "tiles";

otx_status
otx_quilt_create(
    otx_run *run, otx_arena *arena, const otx_texel_pool *pool, int32_t width,
    int32_t height, otx_quilt *out)
{
    const size_t count = (size_t)width * (size_t)height;

    *out = (otx_quilt){
        .pool = pool,
        .width = width,
        .height = height,
        .labels = OTX_ZNEW(arena, uint8_t, count),
        .locks = OTX_NEW(arena, uint8_t, count),
    };
    if (!out->labels || !out->locks)
        return otx_fail_memory(run, STAGE);
    memset(out->locks, OTX_QUILT_FREE, count);
    return OSDTEX_OK;
}

int32_t
otx_quilt_add(otx_quilt *quilt, int32_t x, int32_t y, otx_texel_map map)
{
    if (quilt->sheet_count == OTX_QUILT_MAX_SHEETS)
        return -1;
    quilt->sheets[quilt->sheet_count] = (otx_quilt_sheet){x, y, map};
    return quilt->sheet_count++;
}

/* A texel of the quilt. */
typedef struct place
{
    int32_t x, y;
} place;

static inline int32_t
label_at(const otx_quilt *quilt, place p)
{
    return quilt->labels[otx_quilt_at(quilt, p.x, p.y)];
}

static bool
may_show(const otx_quilt *quilt, place p, int32_t sheet)
{
    const uint8_t lock = quilt->locks[otx_quilt_at(quilt, p.x, p.y)];

    return (lock == OTX_QUILT_FREE || lock == sheet) &&
           otx_quilt_sheet_texel(&quilt->sheets[sheet], p.x, p.y) !=
               OTX_TEXEL_NONE;
}

void
otx_quilt_fill(otx_quilt *quilt, int32_t sheet)
{
    const otx_quilt_sheet *s = &quilt->sheets[sheet];

    for (int32_t y = s->y; y < s->y + s->map.height; ++y)
        for (int32_t x = s->x; x < s->x + s->map.width; ++x)
            if (may_show(quilt, (place){x, y}, sheet))
                quilt->labels[otx_quilt_at(quilt, x, y)] = (uint8_t)sheet;
}

/* Squared distance of two sheets at one texel, negative where one has a
 * hole. */
static double
square(const otx_quilt *quilt, place at, int32_t a, int32_t b)
{
    const int32_t p = otx_quilt_sheet_texel(&quilt->sheets[a], at.x, at.y);
    const int32_t q = otx_quilt_sheet_texel(&quilt->sheets[b], at.x, at.y);

    if (p == q)
        return 0.0;
    if (p == OTX_TEXEL_NONE || q == OTX_TEXEL_NONE)
        return -1.0;
    return otx_texel_pool_square(quilt->pool, p, q);
}

/* Squared distances of the sheets `a` and `b` at both sides of a seam. Where
 * one of them has a hole, the other side stands for both. */
static void
squares(
    const otx_quilt *quilt, place p, place q, int32_t a, int32_t b,
    double out[2])
{
    out[0] = square(quilt, p, a, b);
    out[1] = square(quilt, q, a, b);
    if (out[0] < 0.0)
        out[0] = out[1];
    if (out[1] < 0.0)
        out[1] = out[0];
}

/* Cost of sheet `a` at `p` beside sheet `b` at `q`: squares, since the eye
 * finds the worst spot of a cut, and a longer one that avoids it shows less. */
static int64_t
seam(const otx_quilt *quilt, place p, place q, int32_t a, int32_t b)
{
    double d[2];

    if (a == b)
        return 0;
    squares(quilt, p, q, a, b, d);
    return d[0] < 0.0 ? ABSENT_TOLL : (int64_t)((d[0] + d[1]) * TOLL_UNIT);
}

/* What the labels cost between `p` and the texels right of it and above. */
static int64_t
cost_at(const otx_quilt *quilt, place p)
{
    const place right = {p.x + 1, p.y}, above = {p.x, p.y + 1};
    const int32_t a = label_at(quilt, p);
    int64_t cost = 0;

    if (right.x < quilt->width)
        cost += seam(quilt, p, right, a, label_at(quilt, right));
    if (above.y < quilt->height)
        cost += seam(quilt, p, above, a, label_at(quilt, above));
    return cost;
}

/* Of all pairs with a texel in the box of `sheet`, and some beside it. */
static int64_t
cost_around(const otx_quilt *quilt, const otx_quilt_sheet *sheet)
{
    int64_t cost = 0;

    for (int32_t y = sheet->y > 0 ? sheet->y - 1 : 0;
         y < sheet->y + sheet->map.height; ++y)
        for (int32_t x = sheet->x > 0 ? sheet->x - 1 : 0;
             x < sheet->x + sheet->map.width; ++x)
            cost += cost_at(quilt, (place){x, y});
    return cost;
}

void
otx_quilt_price(otx_quilt *quilt)
{
    quilt->cost = 0;
    for (int32_t y = 0; y < quilt->height; ++y)
        for (int32_t x = 0; x < quilt->width; ++x)
            quilt->cost += cost_at(quilt, (place){x, y});
}

void
otx_quilt_map_cost(const otx_quilt *quilt, int64_t *out)
{
    for (int32_t y = 0; y < quilt->height; ++y)
        for (int32_t x = 0; x < quilt->width; ++x)
            *out++ = cost_at(quilt, (place){x, y});
}

/* One expansion: node of every texel that may change, or what it is. */
enum
{
    KEEPS = -1, /* stays, with a sheet that is not the one that expands */
    SHOWS = -2  /* shows that sheet, before and after */
};

typedef struct move
{
    const otx_quilt *quilt;
    const otx_quilt_sheet *box; /* of the sheet that expands */
    otx_maxflow *graph;
    int32_t *nodes; /* [box height * width] */
    int32_t sheet;
} move;

static int32_t
node_of(const move *m, place p)
{
    const int32_t x = p.x - m->box->x, y = p.y - m->box->y;

    if (x < 0 || y < 0 || x >= m->box->map.width || y >= m->box->map.height)
        return KEEPS;
    return m->nodes[(size_t)y * (size_t)m->box->map.width + (size_t)x];
}

/* The energy of the pair p, q is E(x_p, x_q), where x is 1 for a texel that
 * takes the sheet, and E(1, 1) = 0. As terminals and an edge [Kolmogorov04]. */
static void
add_pair(move *m, place p, place q)
{
    const otx_quilt *quilt = m->quilt;
    const int32_t node_p = node_of(m, p), node_q = node_of(m, q);
    const int32_t a = label_at(quilt, p), b = label_at(quilt, q), s = m->sheet;
    int64_t keep_keep, keep_take, take_keep;

    if (node_p < 0 && node_q < 0)
        return;
    keep_keep = seam(quilt, p, q, a, b);
    keep_take = seam(quilt, p, q, a, s);
    take_keep = seam(quilt, p, q, s, b);
    if (node_p < 0 || node_q < 0)
    {
        const bool fixed_shows = (node_p < 0 ? node_p : node_q) == SHOWS;
        const int64_t other = node_p < 0 ? keep_take : take_keep;
        const int64_t mine = node_p < 0 ? take_keep : keep_take;

        /* The source side keeps: what keeping costs is cut on the way to the
         * sink. */
        otx_maxflow_terminal(
            m->graph, node_p < 0 ? node_q : node_p, fixed_shows ? 0 : other,
            fixed_shows ? mine : keep_keep);
        return;
    }
    /* Squares and holes can break the triangle inequality. Then the old seam
     * counts for less than it is, which makes the move more careful. */
    if (keep_keep > keep_take + take_keep)
        keep_keep = keep_take + take_keep;
    otx_maxflow_terminal(m->graph, node_q, 0, take_keep);
    if (take_keep > keep_keep)
        otx_maxflow_terminal(m->graph, node_p, take_keep - keep_keep, 0);
    else
        otx_maxflow_terminal(m->graph, node_p, 0, keep_keep - take_keep);
    otx_maxflow_edge(
        m->graph, node_p, node_q, keep_take + take_keep - keep_keep, 0);
}

/* All pairs with a texel in the box. */
static void
add_pairs(move *m)
{
    const otx_quilt *quilt = m->quilt;
    const otx_quilt_sheet *box = m->box;

    for (int32_t y = box->y > 0 ? box->y - 1 : 0; y < box->y + box->map.height;
         ++y)
        for (int32_t x = box->x > 0 ? box->x - 1 : 0;
             x < box->x + box->map.width; ++x)
        {
            const place p = {x, y}, right = {x + 1, y}, above = {x, y + 1};

            if (right.x < quilt->width)
                add_pair(m, p, right);
            if (above.y < quilt->height)
                add_pair(m, p, above);
        }
}

static int32_t
number_nodes(move *m)
{
    const otx_quilt_sheet *box = m->box;
    int32_t node_count = 0, *node = m->nodes;

    for (int32_t y = box->y; y < box->y + box->map.height; ++y)
        for (int32_t x = box->x; x < box->x + box->map.width; ++x, ++node)
        {
            if (label_at(m->quilt, (place){x, y}) == m->sheet)
                *node = SHOWS;
            else if (may_show(m->quilt, (place){x, y}, m->sheet))
                *node = node_count++;
            else
                *node = KEEPS;
        }
    return node_count;
}

/* Gives the sheet what the cut says. `labels` takes the old labels of the
 * box. */
static void
take(const move *m, otx_quilt *quilt, uint8_t *labels)
{
    const otx_quilt_sheet *box = m->box;
    const int32_t *node = m->nodes;

    for (int32_t y = box->y; y < box->y + box->map.height; ++y)
        for (int32_t x = box->x; x < box->x + box->map.width; ++x, ++node)
        {
            uint8_t *label = &quilt->labels[otx_quilt_at(quilt, x, y)];

            *labels++ = *label;
            if (*node >= 0 && !otx_maxflow_source_side(m->graph, *node))
                *label = (uint8_t)m->sheet;
        }
}

static void
put_back(const otx_quilt_sheet *box, const uint8_t *labels, otx_quilt *quilt)
{
    for (int32_t y = box->y; y < box->y + box->map.height; ++y)
        for (int32_t x = box->x; x < box->x + box->map.width; ++x)
            quilt->labels[otx_quilt_at(quilt, x, y)] = *labels++;
}

otx_status
otx_quilt_expand(otx_run *run, otx_quilt *quilt, int32_t sheet)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_quilt_sheet *box = &quilt->sheets[sheet];
    const size_t count = (size_t)box->map.width * (size_t)box->map.height;
    const int64_t before = cost_around(quilt, box);
    uint8_t *labels = OTX_NEW(run->scratch, uint8_t, count);
    move m = {
        .quilt = quilt,
        .box = box,
        .nodes = OTX_NEW(run->scratch, int32_t, count),
        .sheet = sheet,
    };
    int32_t node_count;
    int64_t after;

    OTX_TRY(otx_run_ok(run));
    node_count = number_nodes(&m);
    m.graph = otx_maxflow_create(run->scratch, node_count, 2 * node_count);
    if (!m.graph)
        return otx_fail_memory(run, STAGE);
    add_pairs(&m);
    otx_maxflow_solve(m.graph);
    take(&m, quilt, labels);
    after = cost_around(quilt, box);
    if (after >= before)
    {
        put_back(box, labels, quilt);
        after = before;
    }
    quilt->cost += after - before;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

static bool
is_seen(const otx_quilt *quilt, int32_t sheet)
{
    return memchr(
               quilt->labels, sheet,
               (size_t)quilt->width * (size_t)quilt->height) != NULL;
}

otx_status
otx_quilt_settle(otx_run *run, otx_quilt *quilt, int32_t rounds)
{
    for (int32_t round = 0; round < rounds; ++round)
    {
        const int64_t before = quilt->cost;

        for (int32_t s = 0; s < quilt->sheet_count; ++s)
            if (round == 0 || is_seen(quilt, s))
                OTX_TRY(otx_quilt_expand(run, quilt, s));
        if (quilt->cost == before)
            break;
    }
    return OSDTEX_OK;
}

/* Adds the seam between two neighbours, if there is one that could be seen. */
static void
measure_pair(const otx_quilt *quilt, place p, place q, otx_quilt_seams *seams)
{
    const int32_t a = label_at(quilt, p), b = label_at(quilt, q);
    double d[2];

    if (a == b)
        return;
    squares(quilt, p, q, a, b, d);
    if (d[0] == 0.0 && d[1] == 0.0)
        return;
    ++seams->length;
    seams->mean += d[0] < 0.0 ? ABSENT : 0.5 * (sqrt(d[0]) + sqrt(d[1]));
}

otx_quilt_seams
otx_quilt_measure(const otx_quilt *quilt)
{
    otx_quilt_seams seams = {0, 0.0};

    for (int32_t y = 0; y < quilt->height; ++y)
        for (int32_t x = 0; x < quilt->width; ++x)
        {
            const place p = {x, y};

            if (x + 1 < quilt->width)
                measure_pair(quilt, p, (place){x + 1, y}, &seams);
            if (y + 1 < quilt->height)
                measure_pair(quilt, p, (place){x, y + 1}, &seams);
        }
    if (seams.length > 0)
        seams.mean /= (double)seams.length;
    return seams;
}
