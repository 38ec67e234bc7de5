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

/* What a texel is off by, squared, channel by channel. */
static inline otx_quad
error_of(
    const otx_canvas *c, const otx_pattern_level *level, int32_t quads,
    ptrdiff_t at, float x, float y)
{
    const otx_quad *color = c->colors + at * quads;
    otx_quad value[2], sum = {0.0f, 0.0f, 0.0f, 0.0f};

    otx_pattern_at(level, quads, x, y, value);
    for (int32_t q = 0; q < quads; ++q)
    {
        const otx_quad d = value[q] - color[q];

        sum += d * d;
    }
    return sum;
}

/* Of a window with texels that weigh less than others. */
static inline float
cost_of_some(
    const otx_canvas *c, int32_t quads, ptrdiff_t at, otx_window_frame f,
    float limit)
{
    const otx_pattern_level *level = &c->pattern->levels[c->level];
    const int32_t r = c->radius;
    const float mass = c->masses[at], most = limit * mass;
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};

    if (!(mass > 0.0f))
        return 0.0f;
    for (int32_t j = -r; j <= r && !(otx_quad_sum(sum) > most); ++j)
    {
        const ptrdiff_t row = at + (ptrdiff_t)j * c->stride;
        float x = f.x + (float)j * f.xy - (float)r * f.xx;
        float y = f.y + (float)j * f.yy - (float)r * f.yx;

        for (int32_t i = -r; i <= r; ++i, x += f.xx, y += f.yx)
            sum +=
                error_of(c, level, quads, row + i, x, y) * c->weights[row + i];
    }
    return otx_quad_sum(sum) / mass;
}

/* Of a window that is whole; `step` 2: of every other texel, as the black
 * fields of a board are. */
static inline float
cost_of_whole(
    const otx_canvas *c, int32_t quads, int32_t step, ptrdiff_t at,
    otx_window_frame f, float limit)
{
    const otx_pattern_level *level = &c->pattern->levels[c->level];
    const int32_t r = c->radius, side = 2 * r + 1;
    const float count = (float)((side * side + step - 1) / step);
    const float most = limit * count;
    const float xx = (float)step * f.xx, yx = (float)step * f.yx;
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};

    for (int32_t j = -r; j <= r && !(otx_quad_sum(sum) > most); ++j)
    {
        const ptrdiff_t row = at + (ptrdiff_t)j * c->stride;
        const int32_t first = step > 1 ? -r + ((j + r) & 1) : -r;
        float x = f.x + (float)j * f.xy + (float)first * f.xx;
        float y = f.y + (float)j * f.yy + (float)first * f.yx;

        for (int32_t i = first; i <= r; i += step, x += xx, y += yx)
            sum += error_of(c, level, quads, row + i, x, y);
    }
    return otx_quad_sum(sum) / count;
}

static inline float
cost_of(
    const otx_canvas *c, int32_t quads, ptrdiff_t at, otx_window_frame f,
    float limit)
{
    const float side = (float)(2 * c->radius + 1);

    if (c->masses[at] < side * side)
        return cost_of_some(c, quads, at, f, limit);
    return c->sparse ? cost_of_whole(c, quads, 2, at, f, limit)
                     : cost_of_whole(c, quads, 1, at, f, limit);
}

float
otx_window_cost(
    const otx_canvas *c, ptrdiff_t at, otx_window_frame f, float limit)
{
    return c->quads == 1 ? cost_of(c, 1, at, f, limit)
                         : cost_of(c, 2, at, f, limit);
}
