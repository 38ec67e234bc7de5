/* canvas.c -- a chart at one level, at work. */
#include "synth/canvas.h"

#include "image/pyramid.h"

#include <string.h>

enum
{
    SPARSE_LEVELS = 3 /* where neighbours are much alike */
};

static otx_status
allocate(otx_run *run, const otx_synth_chart *chart, otx_canvas *c)
{
    otx_arena *arena = run->scratch;
    const int64_t count = (int64_t)c->stride * (c->height + 2 * OTX_CANVAS_RIM);

    c->kinds = OTX_ZNEW(arena, uint8_t, count);
    c->uses = OTX_ZNEW(arena, uint8_t, count);
    c->votes = OTX_ZNEW(arena, uint8_t, count);
    c->changed = OTX_ZNEW(arena, uint8_t, count);
    c->stirred = OTX_ZNEW(arena, uint8_t, count);
    c->moved = OTX_ZNEW(arena, uint8_t, count);
    c->was_moved = OTX_ZNEW(arena, uint8_t, count);
    c->row = OTX_ZNEW(arena, float, count);
    c->weights = OTX_ZNEW(arena, float, count);
    c->masses = OTX_ZNEW(arena, float, count);
    c->colors = OTX_ZNEW(arena, otx_quad, count * c->quads);
    c->metric = OTX_ZNEW(arena, otx_quad, count);
    c->matches = OTX_ZNEW(arena, otx_synth_match, count);
    c->before = OTX_ZNEW(arena, otx_synth_match, count);
    c->costs = OTX_ZNEW(arena, float, count);
    c->trust = OTX_ZNEW(arena, float, count);
    if (chart->field)
        c->field = OTX_ZNEW(arena, float, 2 * count);
    if (chart->anchor)
    {
        c->anchor = OTX_ZNEW(arena, otx_quad, count * c->quads);
        c->anchor_share = OTX_ZNEW(arena, float, count);
    }
    return otx_run_ok(run);
}

static float
clamped(float v, float low, float high)
{
    return v < low ? low : v > high ? high : v;
}

static otx_quad
metric_of(const float *m)
{
    const float shear = clamped(m[1], -0.5f, 0.5f);

    return (otx_quad){
        clamped(m[0], 0.5f, 2.0f), shear, shear, clamped(m[2], 0.5f, 2.0f)};
}

/* A texel of full resolution, as the chart says. */
static void
fill_texel(
    const otx_synth_chart *chart, bool given, int64_t from, ptrdiff_t to,
    otx_canvas *c)
{
    otx_quad *color = &c->colors[to * c->quads];
    otx_synth_match *m = &c->matches[to];

    c->kinds[to] = chart->kinds ? chart->kinds[from] : (uint8_t)OTX_SYNTH_FREE;
    c->metric[to] = chart->metric ? metric_of(chart->metric + 3 * from)
                                  : (otx_quad){1.0f, 0.0f, 0.0f, 1.0f};
    *m = (otx_synth_match){0.0f, 0.0f, 1.0f, 0.0f};
    if (c->kinds[to] == OTX_SYNTH_FROZEN || (given && c->kinds[to]))
    {
        *m = otx_canvas_fold(c, chart->matches[from]);
        otx_pattern_at(&c->pattern->levels[0], c->quads, m->x, m->y, color);
    }
    if (chart->guide && c->quads > 1)
        memcpy(&color[1], chart->guide + 4 * from, sizeof *color);
    if (c->field)
        memcpy(
            c->field + 2 * to, chart->field + 2 * from, 2 * sizeof *c->field);
    if (!c->anchor)
        return;
    memcpy(
        &c->anchor[to * c->quads], chart->anchor + 4 * c->quads * from,
        (size_t)c->quads * sizeof *c->anchor);
    c->anchor_share[to] = chart->anchor_share[from];
}

static void
fill(const otx_synth_chart *chart, bool given, otx_canvas *c)
{
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
            fill_texel(
                chart, given, (int64_t)y * c->width + x,
                otx_canvas_index(c, x, y), c);
}

/* What matters most of what is in it. */
static uint8_t
kind_over(const otx_canvas *fine, const ptrdiff_t children[4])
{
    static const uint8_t ORDER[] = {
        OTX_SYNTH_FREE, OTX_SYNTH_COLLAR, OTX_SYNTH_FROZEN};

    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 4; ++i)
            if (fine->kinds[children[i]] == ORDER[k])
                return ORDER[k];
    return OTX_SYNTH_VOID;
}

/* The match of a child, gone on with to the middle of its parent. */
static otx_synth_match
match_over(const otx_canvas *fine, const ptrdiff_t children[4], uint8_t kind)
{
    for (int i = 0; i < 4; ++i)
        if (fine->kinds[children[i]] == kind)
            return otx_canvas_go_on(
                fine, children[i], i % 2 ? -0.5f : 0.5f, i < 2 ? 0.5f : -0.5f);
    return (otx_synth_match){0.0f, 0.0f, 1.0f, 0.0f};
}

/* Adds the one of a direction's equals that is nearest to what there is. */
static void
add_direction(const float *f, int32_t symmetry, float sum[2])
{
    float c = f[0], s = f[1];

    if (symmetry > 2 &&
        fabsf(sum[0] * s - sum[1] * c) > fabsf(sum[0] * c + sum[1] * s))
    {
        c = -f[1];
        s = f[0];
    }

    const bool turned = symmetry > 1 && sum[0] * c + sum[1] * s < 0.0f;

    sum[0] += turned ? -c : c;
    sum[1] += turned ? -s : s;
}

static void
mix_field(
    const otx_canvas *fine, const ptrdiff_t children[4], int32_t symmetry,
    float *out)
{
    float sum[2] = {0.0f, 0.0f};

    for (int i = 0; i < 4; ++i)
        if (fine->kinds[children[i]])
            add_direction(fine->field + 2 * children[i], symmetry, sum);

    const float length = sqrtf(sum[0] * sum[0] + sum[1] * sum[1]);

    for (int k = 0; k < 2; ++k)
        out[k] = length > 0.0f ? sum[k] / length : 0.0f;
}

/* The mean over children that are there. */
static void
mix_colors(
    const otx_canvas *fine, const otx_quad *colors, const ptrdiff_t children[4],
    otx_quad *out)
{
    float count = 0.0f;

    for (int i = 0; i < 4; ++i)
        if (fine->kinds[children[i]])
        {
            for (int32_t q = 0; q < fine->quads; ++q)
                out[q] += colors[children[i] * fine->quads + q];
            count += 1.0f;
        }
    for (int32_t q = 0; q < fine->quads && count > 0.0f; ++q)
        out[q] /= count;
}

/* Steps are as long at the level as on the chart. */
static otx_quad
metric_over(const otx_canvas *fine, const ptrdiff_t children[4], otx_vec2 step)
{
    const otx_quad by = {
        (float)step.x, (float)step.y, (float)step.x, (float)step.y};
    otx_quad sum = {0.0f, 0.0f, 0.0f, 0.0f};
    float count = 0.0f;

    for (int i = 0; i < 4; ++i)
        if (fine->kinds[children[i]])
        {
            sum += fine->metric[children[i]];
            count += 1.0f;
        }
    return count > 0.0f ? sum * by / count : (otx_quad){1.0f, 0.0f, 0.0f, 1.0f};
}

static void
reduce_texel(
    const otx_canvas *fine, const ptrdiff_t children[4], ptrdiff_t to,
    otx_vec2 step, int32_t symmetry, otx_canvas *c)
{
    c->kinds[to] = kind_over(fine, children);
    c->metric[to] = metric_over(fine, children, step);
    c->matches[to] = match_over(fine, children, c->kinds[to]);
    mix_colors(fine, fine->colors, children, &c->colors[to * c->quads]);
    if (c->field)
        mix_field(fine, children, symmetry, c->field + 2 * to);
    if (!c->anchor)
        return;
    mix_colors(fine, fine->anchor, children, &c->anchor[to * c->quads]);
    c->anchor_share[to] = 1.0f;
    for (int i = 0; i < 4; ++i)
        if (fine->anchor_share[children[i]] < c->anchor_share[to])
            c->anchor_share[to] = fine->anchor_share[children[i]];
}

static void
reduce(const otx_canvas *fine, int32_t symmetry, otx_canvas *c)
{
    const otx_vec2 step = {c->step_x / fine->step_x, c->step_y / fine->step_y};

    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const int32_t right = fine->width > 1, up = fine->height > 1;
            const ptrdiff_t at =
                otx_canvas_index(fine, 2 * x * right, 2 * y * up);
            const ptrdiff_t above = at + (ptrdiff_t)up * fine->stride;
            const ptrdiff_t children[4] = {
                at, at + right, above, above + right};

            reduce_texel(
                fine, children, otx_canvas_index(c, x, y), step, symmetry, c);
        }
}

/* Shares are read by window: one texel that is not drawn sets its window
 * free. */
static otx_status
spread_shares(otx_run *run, otx_canvas *c)
{
    const int64_t count = (int64_t)c->stride * (c->height + 2 * OTX_CANVAS_RIM);
    float *least;

    if (!c->anchor)
        return OSDTEX_OK;
    least = OTX_ZNEW(run->scratch, float, count);
    if (!least)
        return otx_fail_memory(run, "synth");
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            float share = 1.0f;

            for (int32_t j = -c->radius; j <= c->radius; ++j)
                for (int32_t i = -c->radius; i <= c->radius; ++i)
                {
                    const ptrdiff_t near = at + (ptrdiff_t)j * c->stride + i;

                    if (c->kinds[near] && c->anchor_share[near] < share)
                        share = c->anchor_share[near];
                }
            least[at] = share;
        }
    c->anchor_share = least;
    return OSDTEX_OK;
}

static otx_canvas
sized(
    const otx_pattern *pattern, const otx_synth_chart *chart, int32_t level,
    int32_t radius)
{
    otx_canvas c = {
        .pattern = pattern,
        .width = chart->width ? otx_pyramid_side(chart->width, level) : 0,
        .height = chart->height ? otx_pyramid_side(chart->height, level) : 0,
        .level = level,
        .radius = radius,
        .wrap_x = chart->wrap_x,
        .wrap_y = chart->wrap_y,
        .sparse = level < SPARSE_LEVELS,
        .quads = pattern->quads,
        .voted = chart->guide ? 1 : pattern->quads};

    c.stride = c.width + 2 * OTX_CANVAS_RIM;
    c.step_x = c.width ? (float)chart->width / (float)c.width : 1.0f;
    c.step_y = c.height ? (float)chart->height / (float)c.height : 1.0f;
    return c;
}

otx_status
otx_canvas_build(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *chart,
    const otx_synth_options *options, int32_t level_count,
    otx_canvas_stack *out)
{
    for (int32_t l = 0; l < level_count; ++l)
    {
        otx_canvas *c = &out->levels[l];

        *c = sized(
            pattern, chart, l,
            l > 0 && l == level_count - 1 ? options->coarse_radius
                                          : options->radius);
        OTX_TRY(allocate(run, chart, c));
        if (l == 0)
            fill(chart, options->given, c);
        else
            reduce(&out->levels[l - 1], options->symmetry, c);
        otx_canvas_wrap(c);
    }
    for (int32_t l = 0; l < level_count; ++l)
    {
        OTX_TRY(spread_shares(run, &out->levels[l]));
        otx_canvas_use_windows(&out->levels[l]);
    }
    return OSDTEX_OK;
}

void
otx_canvas_descend(const otx_canvas *from, otx_canvas *to)
{
    const float rx = to->step_x / from->step_x, ry = to->step_y / from->step_y;

    for (int32_t y = 0; y < to->height; ++y)
        for (int32_t x = 0; x < to->width; ++x)
        {
            const int32_t px = x / 2 < from->width ? x / 2 : from->width - 1;
            const int32_t py = y / 2 < from->height ? y / 2 : from->height - 1;
            const ptrdiff_t at = otx_canvas_index(to, x, y);
            const ptrdiff_t parent = otx_canvas_index(from, px, py);

            to->costs[at] = from->costs[parent];
            to->trust[at] = from->trust[parent];
            if (to->kinds[at] != OTX_SYNTH_FREE &&
                to->kinds[at] != OTX_SYNTH_COLLAR)
                continue;
            to->matches[at] = otx_canvas_go_on(
                from, parent, ((float)x + 0.5f) * rx - ((float)px + 0.5f),
                ((float)y + 0.5f) * ry - ((float)py + 0.5f));
        }
    otx_canvas_wrap(to);
}

static ptrdiff_t
count_of(const otx_canvas *c)
{
    return (ptrdiff_t)c->stride * (c->height + 2 * OTX_CANVAS_RIM);
}

/* Of every texel the sum of `in` over its window. */
static void
sum_windows(otx_canvas *c, const float *in, float *out)
{
    const int32_t r = c->radius, rim = OTX_CANVAS_RIM;

    for (int32_t y = -rim; y < c->height + rim; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            c->row[at] = 0.0f;
            for (int32_t i = -r; i <= r; ++i)
                c->row[at] += in[at + i];
        }
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);
            float sum = 0.0f;

            for (int32_t j = -r; j <= r; ++j)
                sum += c->row[at + (ptrdiff_t)j * c->stride];
            out[at] = sum;
        }
}

/* Sets the texels of `out` whose window has one of `in`. */
static void
spread(otx_canvas *c, const uint8_t *in, uint8_t *out)
{
    const int32_t r = c->radius, rim = OTX_CANVAS_RIM;
    const ptrdiff_t up = c->stride;
    uint8_t *row = (uint8_t *)c->row;

    /* How many there are: one comes, one goes. */
    for (int32_t y = -rim; y < c->height + rim; ++y)
    {
        ptrdiff_t at = otx_canvas_index(c, 0, y);
        uint8_t count = 0;

        for (int32_t i = -r; i < r; ++i)
            count = (uint8_t)(count + in[at + i]);
        for (int32_t x = 0; x < c->width; ++x, ++at)
        {
            count = (uint8_t)(count + in[at + r]);
            row[at] = count;
            count = (uint8_t)(count - in[at - r]);
        }
    }
    for (int32_t y = 0; y < c->height; ++y)
    {
        const ptrdiff_t first = otx_canvas_index(c, 0, y);

        for (ptrdiff_t at = first; at < first + c->width; ++at)
        {
            uint8_t any = 0;

            for (int32_t j = -r; j <= r; ++j)
                any |= row[at + j * up];
            out[at] = any != 0;
        }
    }
}

/* Windows with a FREE texel are searched; what these have in them is voted; and
 * windows that reach that have a say. */
static void
use_windows(otx_canvas *c)
{
    const ptrdiff_t count = count_of(c);
    uint8_t *mask = c->changed;

    for (ptrdiff_t i = 0; i < count; ++i)
        mask[i] = c->kinds[i] == OTX_SYNTH_FREE;
    spread(c, mask, c->stirred);
    for (ptrdiff_t i = 0; i < count; ++i)
        c->uses[i] = c->stirred[i] && (c->kinds[i] == OTX_SYNTH_FREE ||
                                       c->kinds[i] == OTX_SYNTH_FROZEN)
                         ? OTX_CANVAS_SEEK
                         : OTX_CANVAS_NONE;
    otx_canvas_wrap(c);
    for (ptrdiff_t i = 0; i < count; ++i)
        mask[i] = c->uses[i] == OTX_CANVAS_SEEK;
    spread(c, mask, c->stirred);
    for (ptrdiff_t i = 0; i < count; ++i)
        c->votes[i] = c->stirred[i] && (c->kinds[i] == OTX_SYNTH_FREE ||
                                        c->kinds[i] == OTX_SYNTH_COLLAR);
    otx_canvas_wrap(c);
    spread(c, c->votes, c->stirred);
    for (ptrdiff_t i = 0; i < count; ++i)
        if (c->stirred[i] && c->kinds[i] == OTX_SYNTH_COLLAR)
            c->uses[i] = OTX_CANVAS_READ;
    memset(mask, 0, (size_t)count);
}

void
otx_canvas_seek_own(otx_canvas *c)
{
    const ptrdiff_t count = count_of(c);

    for (ptrdiff_t i = 0; i < count; ++i)
        c->uses[i] =
            c->kinds[i] == OTX_SYNTH_FREE ? OTX_CANVAS_SEEK : OTX_CANVAS_NONE;
}

void
otx_canvas_stir(otx_canvas *c, bool all)
{
    if (all)
        memset(c->stirred, 1, (size_t)count_of(c));
    else
        spread(c, c->changed, c->stirred);
}

void
otx_canvas_weigh(otx_canvas *c, float hole)
{
    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            c->weights[at] = c->kinds[at] == OTX_SYNTH_FREE   ? hole
                             : c->kinds[at] == OTX_SYNTH_VOID ? 0.0f
                                                              : 1.0f;
        }
    otx_canvas_wrap(c);
    sum_windows(c, c->weights, c->masses);
    otx_canvas_stir(c, true);
    otx_canvas_wrap(c);
}

void
otx_canvas_use_windows(otx_canvas *c)
{
    otx_canvas_wrap(c);
    use_windows(c);
    otx_canvas_weigh(c, 1.0f);
}

static void
copy_texel(otx_canvas *c, ptrdiff_t from, ptrdiff_t to)
{
    c->kinds[to] = c->kinds[from];
    c->uses[to] = c->uses[from];
    c->votes[to] = c->votes[from];
    c->changed[to] = c->changed[from];
    c->moved[to] = c->moved[from];
    c->weights[to] = c->weights[from];
    c->masses[to] = c->masses[from];
    for (int32_t q = 0; q < c->quads; ++q)
        c->colors[to * c->quads + q] = c->colors[from * c->quads + q];
    c->metric[to] = c->metric[from];
    c->matches[to] = c->matches[from];
    c->costs[to] = c->costs[from];
    c->trust[to] = c->trust[from];
    if (c->anchor_share)
        c->anchor_share[to] = c->anchor_share[from];
}

/* Columns first, then whole rows, so that corners are right. A torus narrower
 * than the rim repeats. */
void
otx_canvas_wrap(otx_canvas *c)
{
    const int32_t rim = OTX_CANVAS_RIM;

    for (int32_t y = 0; c->wrap_x && y < c->height; ++y)
        for (int32_t i = -rim; i < c->width + rim; ++i)
            if (i < 0 || i >= c->width)
                copy_texel(
                    c, otx_canvas_index(c, otx_image_wrap(i, c->width), y),
                    otx_canvas_index(c, i, y));
    for (int32_t j = -rim; c->wrap_y && j < c->height + rim; ++j)
        for (int32_t i = -rim; (j < 0 || j >= c->height) && i < c->width + rim;
             ++i)
            copy_texel(
                c, otx_canvas_index(c, i, otx_image_wrap(j, c->height)),
                otx_canvas_index(c, i, j));
}

otx_status
otx_canvas_cut(
    otx_run *run, otx_canvas *const *canvases, int32_t count,
    const int32_t **chart_of, const int32_t **first, int64_t *strips)
{
    int32_t *charts, *rows;
    int64_t n = 0;

    for (int32_t k = 0; k < count; ++k)
        n += otx_canvas_strips(canvases[k]);
    charts = OTX_NEW(run->scratch, int32_t, n);
    rows = OTX_NEW(run->scratch, int32_t, n);
    if (!charts || !rows)
        return otx_fail_memory(run, "synth");
    *chart_of = charts;
    *first = rows;
    *strips = n;
    for (int32_t k = 0; k < count; ++k)
        for (int32_t i = 0; i < otx_canvas_strips(canvases[k]); ++i)
        {
            *charts++ = k;
            *rows++ = i * OTX_CANVAS_STRIP;
        }
    return OSDTEX_OK;
}
