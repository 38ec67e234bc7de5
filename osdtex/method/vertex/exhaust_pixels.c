/* exhaust_pixels.c -- the pixel whose square of colours is nearest to one.
 *
 * As exact as trying all of them: projections onto a few orthonormal low
 * frequencies are never further apart than the squares, and pixels are taken in
 * the order of the first of these, lightness, from where the colours' own is.
 */
#include "method/vertex/neighbourhood.h"

enum
{
    STRIDE = 8, /* samples between two looks at the limit */
    LEAF = 8    /* pixels of a leaf, at least */
};

/* Sample s of a pixel's square. */
static inline otx_quad
sample_of(const otx_pattern *p, const otx_hood *hood, int32_t pixel, int32_t s)
{
    const otx_pattern_level *own = &p->levels[hood->level];
    const int32_t x = pixel % own->width, y = pixel / own->width;
    const bool above = s >= hood->own;
    const otx_pattern_level *level = above ? own + 1 : own;
    const float px = level->per_x / own->per_x, py = level->per_y / own->per_y;
    otx_quad value;

    otx_pattern_at(
        level, 1, ((float)x + 0.5f) * px + (float)hood->right[s],
        ((float)y + 0.5f) * py - (float)hood->down[s], &value);
    return value;
}

/*   out  [OTX_HOOD_HEAD] */
static void
project(const otx_hood *hood, const otx_quad *colors, float *out)
{
    for (int32_t m = 0; m < OTX_HOOD_BASIS; ++m)
    {
        otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};

        for (int32_t s = 0; s < hood->bounded; ++s)
            sum += colors[s] * hood->basis[m][s];
        for (int c = 0; c < 3; ++c)
            *out++ = sum[c];
    }
}

/* Whether all of a pixel's square is on the picture. */
static bool
is_inside(const otx_pattern *p, const otx_hood *hood, int32_t pixel)
{
    const otx_pattern_level *level = &p->levels[hood->level];
    const int32_t reach = OTX_HOOD_REACH * (hood->own > 0 ? 1 : 2);
    const int32_t x = pixel % level->width, y = pixel / level->width;

    return (p->wrap_x || (x >= reach && x + reach < level->width)) &&
           (p->wrap_y || (y >= reach && y + reach < level->height));
}

/* The pixels that may be taken; their count. */
static int32_t
list(const otx_pattern *p, const otx_hood *hood, bool all, int32_t *out)
{
    const otx_pattern_level *level = &p->levels[hood->level];
    int32_t count = 0;

    for (int32_t i = 0; i < level->width * level->height; ++i)
        if (all || is_inside(p, hood, i))
            out[count++] = i;
    return count;
}

static void
set_head(const otx_hood_table *t, int32_t i)
{
    otx_quad colors[OTX_HOOD_MOST];

    for (int32_t s = 0; s < t->hood->bounded; ++s)
        colors[s] = sample_of(t->pattern, t->hood, t->pixels[i], s);
    project(t->hood, colors, t->heads + (ptrdiff_t)i * OTX_HOOD_HEAD);
}

/* ---- the tree ---- */

static float
coordinate(const otx_hood_table *t, int32_t i, int32_t axis)
{
    return t->heads[(ptrdiff_t)i * OTX_HOOD_HEAD + axis];
}

static int32_t
widest_axis(const otx_hood_table *t, int32_t first, int32_t end)
{
    float most = -1.0f;
    int32_t best = 0;

    for (int32_t axis = 0; axis < OTX_HOOD_HEAD; ++axis)
    {
        double sum = 0.0, squares = 0.0;

        for (int32_t i = first; i < end; ++i)
        {
            const double v = (double)coordinate(t, i, axis);

            sum += v;
            squares += v * v;
        }
        squares -= sum * sum / (end - first);
        if (!((float)squares > most))
            continue;
        most = (float)squares;
        best = axis;
    }
    return best;
}

static void
swap(otx_hood_table *t, int32_t a, int32_t b)
{
    const int32_t pixel = t->pixels[a];

    t->pixels[a] = t->pixels[b];
    t->pixels[b] = pixel;
    for (int32_t k = 0; k < OTX_HOOD_HEAD; ++k)
    {
        float *p = t->heads + (ptrdiff_t)a * OTX_HOOD_HEAD + k;
        float *q = t->heads + (ptrdiff_t)b * OTX_HOOD_HEAD + k;
        const float v = *p;

        *p = *q;
        *q = v;
    }
}

/* Brings those with the lower coordinates before `middle` [Hoare61]. */
static void
part(
    otx_hood_table *t, int32_t axis, int32_t first, int32_t middle, int32_t end)
{
    while (end - first > 1)
    {
        const float pivot = coordinate(t, first + (end - first) / 2, axis);
        int32_t i = first, j = end - 1;

        while (i <= j)
        {
            while (coordinate(t, i, axis) < pivot)
                ++i;
            while (coordinate(t, j, axis) > pivot)
                --j;
            if (i <= j)
                swap(t, i++, j--);
        }
        if (middle <= j)
            end = j + 1;
        else if (middle >= i)
            first = i;
        else
            return;
    }
}

/* The first pixel of a node's share at a depth; of the one behind the last, the
 * count. */
static int32_t
first_of(const otx_hood_table *t, int32_t depth, int32_t place)
{
    return (int32_t)(((int64_t)t->count * place) >> depth);
}

static void
grow(otx_hood_table *t)
{
    for (int32_t depth = 0; depth < t->depth; ++depth)
        for (int32_t place = 0; place < 1 << depth; ++place)
        {
            const int32_t node = (1 << depth) - 1 + place;
            const int32_t first = first_of(t, depth, place);
            const int32_t end = first_of(t, depth, place + 1);
            const int32_t middle = first_of(t, depth + 1, 2 * place + 1);

            t->axes[node] = widest_axis(t, first, end);
            part(t, t->axes[node], first, middle, end);
            t->splits[node] = coordinate(t, middle, t->axes[node]);
        }
}

otx_status
otx_hood_table_build(
    otx_run *run, const otx_pattern *pattern, const otx_hood *hood,
    otx_hood_table *out)
{
    const otx_pattern_level *level = &pattern->levels[hood->level];
    otx_hood_table *t = out;

    *t = (otx_hood_table){.pattern = pattern, .hood = hood};
    t->pixels =
        OTX_NEW(run->scratch, int32_t, (int64_t)level->width * level->height);
    OTX_TRY(otx_run_ok(run));
    t->count = list(pattern, hood, false, t->pixels);
    if (t->count == 0)
        t->count = list(pattern, hood, true, t->pixels);
    while (t->count >> t->depth > 2 * LEAF)
        ++t->depth;
    t->heads = OTX_NEW(run->scratch, float, (int64_t)t->count *OTX_HOOD_HEAD);
    t->axes = OTX_NEW(run->scratch, int32_t, (int64_t)1 << t->depth);
    t->splits = OTX_NEW(run->scratch, float, (int64_t)1 << t->depth);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < t->count; ++i)
        set_head(t, i);
    grow(t);
    return OSDTEX_OK;
}

/* ---- search ---- */

/* Squared distance to a pixel's square; beyond `limit`, where it is. */
static float
distance(
    const otx_hood_table *t, const otx_quad *colors, int32_t pixel, float limit)
{
    const otx_hood *hood = t->hood;
    const otx_pattern_level *own = &t->pattern->levels[hood->level];
    const otx_quad *middle =
        own->values +
        (ptrdiff_t)(pixel / own->width + OTX_PATTERN_RIM) * own->stride +
        pixel % own->width + OTX_PATTERN_RIM;
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};

    for (int32_t s = 0; s < hood->own; ++s)
    {
        const otx_quad d =
            middle[hood->right[s] - (ptrdiff_t)hood->down[s] * own->stride] -
            colors[s];

        sum += d * d;
        if (s % STRIDE == STRIDE - 1 && otx_quad_sum(sum) >= limit)
            return INFINITY;
    }
    for (int32_t s = hood->own; s < hood->count; ++s)
    {
        const otx_quad d = sample_of(t->pattern, hood, pixel, s) - colors[s];

        sum += d * d;
        if (s % STRIDE == STRIDE - 1 && otx_quad_sum(sum) >= limit)
            return INFINITY;
    }
    return otx_quad_sum(sum);
}

typedef struct search
{
    const otx_hood_table *table;
    const otx_quad *colors;
    float head[OTX_HOOD_HEAD];
    float aside[OTX_HOOD_HEAD]; /* from the node's cell, along each axis */
    float least;
    float loose; /* what a projection counts for */
    int32_t best;
} search;

/* Whether a pixel is too far, as far as projections tell. */
static bool
is_beyond(const search *s, int32_t i)
{
    const float *head = s->table->heads + (ptrdiff_t)i * OTX_HOOD_HEAD;
    float sum = 0.0f;

    for (int32_t k = 0; k < OTX_HOOD_HEAD; ++k)
    {
        sum += (head[k] - s->head[k]) * (head[k] - s->head[k]);
        if (k % STRIDE == STRIDE - 1 && s->loose * sum >= s->least)
            return true;
    }
    return false;
}

static void
look_in_leaf(search *s, int32_t place)
{
    const otx_hood_table *t = s->table;
    const int32_t end = first_of(t, t->depth, place + 1);

    for (int32_t i = first_of(t, t->depth, place); i < end; ++i)
    {
        float d;

        if (is_beyond(s, i))
            continue;
        d = distance(t, s->colors, t->pixels[i], s->least);
        if (!(d < s->least))
            continue;
        s->least = d;
        s->best = t->pixels[i];
    }
}

/* The nearer child first, the other where its cell is not too far [Arya93].
 *
 *   off  squared distance of the node's cell */
static void
look_below(search *s, int32_t depth, int32_t place, float off)
{
    const otx_hood_table *t = s->table;
    const int32_t node = (1 << depth) - 1 + place;

    if (depth == t->depth)
    {
        look_in_leaf(s, place);
        return;
    }

    const int32_t axis = t->axes[node];
    const float from = s->head[axis] - t->splits[node];
    const int32_t near = from >= 0.0f;
    const float was = s->aside[axis];
    const float beyond = off - was * was + from * from;

    look_below(s, depth + 1, 2 * place + near, off);
    if (!(s->loose * beyond < s->least))
        return;
    s->aside[axis] = from;
    look_below(s, depth + 1, 2 * place + 1 - near, beyond);
    s->aside[axis] = was;
}

int32_t
otx_hood_nearest(const otx_hood_table *t, const otx_quad *colors, int32_t guess)
{
    search s = {
        .table = t,
        .colors = colors,
        .least = INFINITY,
        .loose = (1.0f + t->slack) * (1.0f + t->slack),
        .best = guess};

    if (guess >= 0)
        s.least = distance(t, colors, guess, INFINITY);
    project(t->hood, colors, s.head);
    look_below(&s, 0, 0, 0.0f);
    return s.best;
}
