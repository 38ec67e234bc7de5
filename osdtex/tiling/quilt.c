/* quilt.c -- expansion moves over sheets of texels. */
#include "tiling/quilt.h"
#include "math/maxflow.h"

#include <string.h>

enum
{
    UNIT = 64,        /* of one Lab unit */
    ABSENT = 1 << 16, /* where a sheet has a hole: no distance in Lab */
    /* So that the most different colours cost less than 2^17, and a hole more
     * than a hundred of them. */
    TOLL_SCALE = 1 << 9,
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
otx_quilt_add(otx_quilt *quilt, otx_texel_map sheet)
{
    if (quilt->sheet_count == OTX_QUILT_MAX_SHEETS)
        return -1;
    quilt->sheets[quilt->sheet_count] = sheet;
    return quilt->sheet_count++;
}

static bool
may_show(const otx_quilt *quilt, size_t at, int32_t sheet)
{
    const uint8_t lock = quilt->locks[at];

    return (lock == OTX_QUILT_FREE || lock == sheet) &&
           quilt->sheets[sheet].texels[at] != OTX_TEXEL_NONE;
}

void
otx_quilt_fill(otx_quilt *quilt, int32_t sheet)
{
    const size_t count = (size_t)quilt->width * (size_t)quilt->height;

    for (size_t at = 0; at < count; ++at)
        if (may_show(quilt, at, sheet))
            quilt->labels[at] = (uint8_t)sheet;
}

/* Distance of two sheets at one texel. */
static int64_t
distance(const otx_quilt *quilt, size_t at, int32_t a, int32_t b)
{
    const int32_t p = quilt->sheets[a].texels[at];
    const int32_t q = quilt->sheets[b].texels[at];

    if (p == q)
        return 0;
    if (p == OTX_TEXEL_NONE || q == OTX_TEXEL_NONE)
        return ABSENT;
    return (int64_t)(otx_texel_pool_distance(quilt->pool, p, q) * UNIT + 0.5);
}

/* What one side of a seam costs: the square, since the eye finds the worst spot
 * of a cut, and a longer one that avoids it shows less. */
static int64_t
toll(const otx_quilt *quilt, size_t at, int32_t a, int32_t b)
{
    const int64_t d = distance(quilt, at, a, b);

    return d == ABSENT ? ABSENT_TOLL : d * d / TOLL_SCALE;
}

/* Cost of sheet `a` at `p` beside sheet `b` at `q`. */
static int64_t
seam(const otx_quilt *quilt, size_t p, size_t q, int32_t a, int32_t b)
{
    return a == b ? 0 : toll(quilt, p, a, b) + toll(quilt, q, a, b);
}

void
otx_quilt_price(otx_quilt *quilt)
{
    const size_t row = (size_t)quilt->width;
    const uint8_t *labels = quilt->labels;

    quilt->cost = 0;
    for (int32_t y = 0; y < quilt->height; ++y)
        for (int32_t x = 0; x < quilt->width; ++x)
        {
            const size_t p = (size_t)y * row + (size_t)x;

            if (x + 1 < quilt->width)
                quilt->cost += seam(quilt, p, p + 1, labels[p], labels[p + 1]);
            if (y + 1 < quilt->height)
                quilt->cost +=
                    seam(quilt, p, p + row, labels[p], labels[p + row]);
        }
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
    otx_maxflow *graph;
    int32_t *nodes; /* [height * width] */
    int32_t sheet;
} move;

/* The energy of the pair p, q is E(x_p, x_q), where x is 1 for a texel that
 * takes the sheet, and E(1, 1) = 0. As terminals and an edge [Kolmogorov04]. */
static void
add_pair(move *m, size_t p, size_t q)
{
    const otx_quilt *quilt = m->quilt;
    const int32_t node_p = m->nodes[p], node_q = m->nodes[q];
    const int32_t a = quilt->labels[p], b = quilt->labels[q], s = m->sheet;
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

static void
add_pairs(move *m)
{
    const int32_t width = m->quilt->width, height = m->quilt->height;

    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
        {
            const size_t p = (size_t)y * (size_t)width + (size_t)x;

            if (x + 1 < width)
                add_pair(m, p, p + 1);
            if (y + 1 < height)
                add_pair(m, p, p + (size_t)width);
        }
}

static int32_t
number_nodes(move *m)
{
    const otx_quilt *quilt = m->quilt;
    const size_t count = (size_t)quilt->width * (size_t)quilt->height;
    int32_t node_count = 0;

    for (size_t at = 0; at < count; ++at)
    {
        if (quilt->labels[at] == m->sheet)
            m->nodes[at] = SHOWS;
        else if (may_show(quilt, at, m->sheet))
            m->nodes[at] = node_count++;
        else
            m->nodes[at] = KEEPS;
    }
    return node_count;
}

static otx_status
expand(otx_run *run, otx_quilt *quilt, int32_t sheet)
{
    const size_t count = (size_t)quilt->width * (size_t)quilt->height;
    move m = {
        .quilt = quilt,
        .nodes = OTX_NEW(run->scratch, int32_t, count),
        .sheet = sheet,
    };
    int32_t node_count;

    if (!m.nodes)
        return otx_fail_memory(run, STAGE);
    node_count = number_nodes(&m);
    m.graph = otx_maxflow_create(run->scratch, node_count, 2 * node_count);
    if (!m.graph)
        return otx_fail_memory(run, STAGE);
    add_pairs(&m);
    otx_maxflow_solve(m.graph);
    for (size_t at = 0; at < count; ++at)
        if (m.nodes[at] >= 0 && !otx_maxflow_source_side(m.graph, m.nodes[at]))
            quilt->labels[at] = (uint8_t)sheet;
    otx_quilt_price(quilt);
    return OSDTEX_OK;
}

otx_status
otx_quilt_expand(otx_run *run, otx_quilt *quilt, int32_t sheet)
{
    const size_t count = (size_t)quilt->width * (size_t)quilt->height;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int64_t before = quilt->cost;
    uint8_t *labels = OTX_NEW(run->scratch, uint8_t, count);
    otx_status status;

    if (!labels)
        return otx_fail_memory(run, STAGE);
    memcpy(labels, quilt->labels, count);
    status = expand(run, quilt, sheet);
    if (status == OSDTEX_OK && quilt->cost > before)
    {
        memcpy(quilt->labels, labels, count);
        quilt->cost = before;
    }
    otx_arena_release(run->scratch, mark);
    return status;
}

otx_quilt_seams
otx_quilt_measure(const otx_quilt *quilt)
{
    const size_t row = (size_t)quilt->width;
    otx_quilt_seams seams = {0, 0.0};
    int64_t cost = 0;

    for (int32_t y = 0; y < quilt->height; ++y)
        for (int32_t x = 0; x < quilt->width; ++x)
            for (int32_t axis = 0; axis < 2; ++axis)
            {
                const size_t p = (size_t)y * row + (size_t)x;
                const size_t q = axis == 0 ? p + 1 : p + row;
                int32_t a, b;

                if (axis == 0 ? x + 1 == quilt->width : y + 1 == quilt->height)
                    continue;
                a = quilt->labels[p];
                b = quilt->labels[q];
                if (a == b ||
                    (quilt->sheets[a].texels[q] == quilt->sheets[b].texels[q] &&
                     quilt->sheets[a].texels[p] == quilt->sheets[b].texels[p]))
                    continue;
                ++seams.length;
                cost += distance(quilt, p, a, b) + distance(quilt, q, a, b);
            }
    if (seams.length > 0)
        seams.mean = (double)cost / (2.0 * UNIT * (double)seams.length);
    return seams;
}
