/* wear.c -- how much of what a patch would show has been shown before. */
#include "match/wear.h"

#include <string.h>

enum
{
    POINTS = 200 /* of a patch that are looked up, at the most */
};

static int32_t
point_count(const otx_match_query *query)
{
    return query->cover_count < 1        ? 1
           : query->cover_count < POINTS ? query->cover_count
                                         : POINTS;
}

/* Points evenly taken from the cover; the centre where there is none. */
static otx_vec2
point_at(const otx_match_query *query, int32_t n)
{
    return query->cover_count < 1
               ? query->centre
               : query->cover
                     [(int64_t)n * query->cover_count / point_count(query)];
}

double
otx_wear_factor(
    const otx_matcher *matcher, const otx_match_query *query,
    const otx_match *placement)
{
    const otx_vec2 turn = otx_vec2_polar(placement->angle);
    const int32_t count = point_count(query);
    double sum = 0.0;

    if (!query->usage)
        return 1.0;
    for (int32_t n = 0; n < count; ++n)
    {
        const otx_vec2 p = otx_vec2_add(
            otx_vec2_mul(turn, point_at(query, n)), placement->shift);
        const int32_t x = otx_matcher_usage_cell(
            p.x, matcher->width, matcher->wrap_x, query->usage_width);
        const int32_t y = otx_matcher_usage_cell(
            p.y, matcher->height, matcher->wrap_y, query->usage_height);

        sum += (double)query->usage[y * query->usage_width + x];
    }
    return 1.0 + query->usage_weight * sum / count;
}

otx_status
otx_wear_create(otx_arena *arena, const otx_match_query *query, otx_wear *out)
{
    const int64_t cells = (int64_t)query->usage_width * query->usage_height;

    *out = (otx_wear){0};
    if (!query->usage)
        return OSDTEX_OK;
    out->print = OTX_NEW(arena, float, 4 * cells);
    out->factors = OTX_NEW(arena, float, cells);
    return out->print && out->factors ? OSDTEX_OK : OSDTEX_ERROR_MEMORY;
}

/* A distance from the centre in cells, as it counts along an axis. */
static int32_t
fold_offset(int32_t offset, int32_t cells, bool wrap)
{
    if (wrap)
        return otx_view_fold(offset, cells, true);
    return offset < -cells ? -cells : offset >= cells ? cells - 1 : offset;
}

/* The patch's points, each shared out between the four offsets around it. */
static void
draw_print(
    const otx_matcher *m, const otx_match_query *q, double angle, float *print)
{
    const int32_t count = point_count(q), w = q->usage_width,
                  h = q->usage_height;
    const otx_vec2 turn = otx_vec2_polar(angle);

    memset(print, 0, 4 * (size_t)w * (size_t)h * sizeof *print);
    for (int32_t n = 0; n < count; ++n)
    {
        const otx_vec2 d =
            otx_vec2_mul(turn, otx_vec2_sub(point_at(q, n), q->centre));
        const double x = d.x / m->width * w, y = d.y / m->height * h;
        const int32_t i = (int32_t)floor(x), j = (int32_t)floor(y);

        for (int k = 0; k < 4; ++k)
        {
            const int32_t a = fold_offset(i + (k & 1), w, m->wrap_x);
            const int32_t b = fold_offset(j + (k >> 1), h, m->wrap_y);
            const double u = k & 1 ? x - i : 1.0 - (x - i);
            const double v = k >> 1 ? y - j : 1.0 - (y - j);

            print[(b + h) * 2 * w + a + w] += (float)(u * v / count);
        }
    }
}

/* Adds a share of the usage at an offset from each cell. */
static void
add_offset(
    const otx_matcher *m, const otx_match_query *q, int32_t dx, int32_t dy,
    float share, float *sums)
{
    const int32_t w = q->usage_width, h = q->usage_height;

    for (int32_t y = 0; y < h; ++y)
    {
        const float *row = q->usage + otx_view_fold(y + dy, h, m->wrap_y) * w;

        for (int32_t x = 0; x < w; ++x)
            sums[y * w + x] += share * row[otx_view_fold(x + dx, w, m->wrap_x)];
    }
}

void
otx_wear_tabulate(
    const otx_matcher *matcher, const otx_match_query *query, double angle,
    const otx_wear *wear)
{
    const int32_t w = query->usage_width, h = query->usage_height;

    draw_print(matcher, query, angle, wear->print);
    memset(wear->factors, 0, (size_t)w * (size_t)h * sizeof(float));
    for (int32_t i = 0; i < 4 * w * h; ++i)
        if (wear->print[i] > 0.0f)
            add_offset(
                matcher, query, i % (2 * w) - w, i / (2 * w) - h,
                wear->print[i], wear->factors);
    for (int32_t i = 0; i < w * h; ++i)
        wear->factors[i] = 1.0f + (float)query->usage_weight * wear->factors[i];
}
