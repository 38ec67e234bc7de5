/* window_cost.c -- how far a window is from where a match says it is from.
 *
 * Rows are summed one by one, and after each it is asked whether the limit is
 * passed: most candidates end so after two or three. */
#include "synth/window_cost.h"

bool
otx_window_is_inside(const otx_canvas *c, otx_window_frame f)
{
    const otx_pattern *p = c->pattern;
    const otx_pattern_level *level = &p->levels[c->level];
    const float r = (float)c->radius;
    const float ex = r * (fabsf(f.xx) + fabsf(f.xy)) - 0.5f;
    const float ey = r * (fabsf(f.yx) + fabsf(f.yy)) - 0.5f;

    return (p->wrap_x || (f.x >= ex && f.x <= (float)level->width - ex)) &&
           (p->wrap_y || (f.y >= ey && f.y <= (float)level->height - ey));
}

/* Of one row of the window, whose first texel is at (x, y) in the pattern. */
static inline otx_quad
row_cost(
    const otx_canvas *c, const otx_pattern_level *level, int32_t quads,
    ptrdiff_t at, float x, float y, otx_window_frame f)
{
    const int32_t count = 2 * c->radius + 1;
    const otx_quad *color = c->colors + at * quads;
    const float *weight = c->weights + at;
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};

    for (int32_t i = 0; i < count; ++i, x += f.xx, y += f.yx)
    {
        otx_quad value[2];

        otx_pattern_at(level, quads, x, y, value);
        for (int32_t q = 0; q < quads; ++q)
        {
            const otx_quad d = value[q] - *color++;

            sum += d * d * weight[i];
        }
    }
    return sum;
}

static inline float
cost_of(
    const otx_canvas *c, int32_t quads, ptrdiff_t at, otx_window_frame f,
    float limit)
{
    const otx_pattern_level *level = &c->pattern->levels[c->level];
    const int32_t r = c->radius;
    const float most = limit * c->masses[at];
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};
    float x = f.x - (float)r * (f.xx + f.xy);
    float y = f.y - (float)r * (f.yx + f.yy);

    if (!(c->masses[at] > 0.0f))
        return 0.0f;
    at -= (ptrdiff_t)r * c->stride + r;
    for (int32_t j = -r; j <= r; ++j, x += f.xy, y += f.yy, at += c->stride)
    {
        sum += row_cost(c, level, quads, at, x, y, f);
        if (otx_quad_sum(sum) > most)
            break;
    }
    return otx_quad_sum(sum);
}

float
otx_window_cost(
    const otx_canvas *c, ptrdiff_t at, otx_window_frame f, float limit)
{
    const float sum = c->quads == 1 ? cost_of(c, 1, at, f, limit)
                                    : cost_of(c, 2, at, f, limit);

    return c->masses[at] > 0.0f ? sum / c->masses[at] : 0.0f;
}
