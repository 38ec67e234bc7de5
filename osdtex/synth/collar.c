/* collar.c -- matches that charts read from each other. */
#include "synth/collar.h"

#include <stdlib.h>

/* The collar texel of level 0 nearest to the middle of a coarse one; false
 * where there is none in it. */
static bool
nearest_below(
    const otx_canvas *fine, const otx_canvas *c, int32_t x, int32_t y,
    int32_t *fx, int32_t *fy)
{
    const float mx = ((float)x + 0.5f) * c->step_x - 0.5f;
    const float my = ((float)y + 0.5f) * c->step_y - 0.5f;
    const int32_t x0 = (int32_t)((float)x * c->step_x);
    const int32_t y0 = (int32_t)((float)y * c->step_y);
    float best = INFINITY;

    for (int32_t j = y0; j < y0 + (1 << c->level) && j < fine->height; ++j)
        for (int32_t i = x0; i < x0 + (1 << c->level) && i < fine->width; ++i)
        {
            const float dx = (float)i - mx, dy = (float)j - my;

            if (fine->kinds[otx_canvas_index(fine, i, j)] != OTX_SYNTH_COLLAR ||
                dx * dx + dy * dy >= best)
                continue;
            best = dx * dx + dy * dy;
            *fx = i;
            *fy = j;
        }
    return best < INFINITY;
}

/* The FREE texel of the owner's canvas nearest to a position in its texels. */
static bool
nearest_owned(const otx_canvas *owner, otx_vec2 at, int32_t *ox, int32_t *oy)
{
    const int32_t x = (int32_t)floor(at.x), y = (int32_t)floor(at.y);
    double best = INFINITY;

    for (int32_t j = y - 2; j <= y + 2; ++j)
        for (int32_t i = x - 2; i <= x + 2; ++i)
        {
            const double dx = i + 0.5 - at.x, dy = j + 0.5 - at.y;

            if (i < 0 || j < 0 || i >= owner->width || j >= owner->height ||
                owner->kinds[otx_canvas_index(owner, i, j)] != OTX_SYNTH_FREE ||
                dx * dx + dy * dy >= best)
                continue;
            best = dx * dx + dy * dy;
            *ox = i;
            *oy = j;
        }
    return best < INFINITY;
}

/* What of a chart is (dx, dy) on the surface, in its texels of level 0. */
static otx_vec2
back(const otx_canvas *fine, ptrdiff_t at, otx_vec2 d)
{
    const otx_quad m = fine->metric[at];
    const double det = (double)m[0] * m[3] - (double)m[1] * m[2];

    return (otx_vec2){
        (m[3] * d.x - m[1] * d.y) / det, (m[0] * d.y - m[2] * d.x) / det};
}

static bool
link_texel(
    const otx_synth_chart *chart, otx_canvas *const *finest,
    otx_canvas *const *canvases, int32_t k, int32_t x, int32_t y,
    otx_collar_link *out)
{
    const otx_canvas *c = canvases[k], *fine = finest[k];
    int32_t fx = 0, fy = 0, ox = 0, oy = 0;

    if (!nearest_below(fine, c, x, y, &fx, &fy))
        return false;

    const otx_synth_place *place =
        &chart->places[(int64_t)fy * chart->width + fx];
    const otx_canvas *owner = canvases[place->chart];
    const otx_canvas *owner_fine = finest[place->chart];
    const otx_vec2 d = otx_canvas_onto(
        fine, otx_canvas_index(fine, fx, fy),
        ((float)x + 0.5f) * c->step_x - ((float)fx + 0.5f),
        ((float)y + 0.5f) * c->step_y - ((float)fy + 0.5f));
    const otx_vec2 there = otx_vec2_mul((otx_vec2){place->c, place->s}, d);
    otx_vec2 at = {place->x, place->y};

    if (!nearest_owned(owner_fine, at, &ox, &oy))
        return false;
    at = otx_vec2_add(
        at, back(owner_fine, otx_canvas_index(owner_fine, ox, oy), there));
    at = (otx_vec2){at.x / owner->step_x, at.y / owner->step_y};
    if (!nearest_owned(owner, at, &ox, &oy))
        return false;
    *out = (otx_collar_link){
        .at = (int32_t)otx_canvas_index(c, x, y),
        .chart = place->chart,
        .from = (int32_t)otx_canvas_index(owner, ox, oy),
        .dx = (float)(at.x - ox - 0.5),
        .dy = (float)(at.y - oy - 0.5),
        .c = place->c,
        .s = place->s};
    return true;
}

typedef struct collar_job
{
    const otx_synth_chart *charts;
    otx_canvas *const *finest;
    otx_canvas *const *canvases;
    otx_collar *collars;
} collar_job;

static otx_status
link_chart(void *context, int64_t index, otx_worker *worker)
{
    const collar_job *j = context;
    const int32_t k = (int32_t)index;
    otx_canvas *c = j->canvases[k];
    otx_collar *out = &j->collars[k];

    (void)worker;
    for (int32_t y = 0; out->links && y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
        {
            const ptrdiff_t at = otx_canvas_index(c, x, y);

            if (c->uses[at] != OTX_CANVAS_READ)
                continue;
            if (link_texel(
                    &j->charts[k], j->finest, j->canvases, k, x, y,
                    &out->links[out->count]))
                ++out->count;
            else
                c->kinds[at] = OTX_SYNTH_VOID;
        }
    if (out->links)
        otx_canvas_use_windows(c);
    return OSDTEX_OK;
}

static int64_t
collar_size(const otx_canvas *c)
{
    int64_t count = 0;

    for (int32_t y = 0; y < c->height; ++y)
        for (int32_t x = 0; x < c->width; ++x)
            count += c->uses[otx_canvas_index(c, x, y)] == OTX_CANVAS_READ;
    return count;
}

otx_status
otx_collar_link_up(
    otx_run *run, const otx_synth_chart *charts, otx_canvas *const *finest,
    otx_canvas *const *canvases, int32_t count, otx_collar *out)
{
    collar_job job = {charts, finest, canvases, out};

    for (int32_t k = 0; k < count; ++k)
    {
        out[k] = (otx_collar){NULL, 0};
        if (charts[k].places)
            out[k].links = OTX_NEW(
                run->scratch, otx_collar_link, collar_size(canvases[k]));
    }
    OTX_TRY(otx_run_ok(run));
    return otx_pool_for(run->pool, count, link_chart, &job);
}

static otx_status
exchange_chart(void *context, int64_t index, otx_worker *worker)
{
    const collar_job *j = context;
    const otx_collar *collar = &j->collars[index];
    otx_canvas *c = j->canvases[index];

    (void)worker;
    for (int32_t i = 0; i < collar->count; ++i)
    {
        const otx_collar_link *l = &collar->links[i];
        const otx_canvas *owner = j->canvases[l->chart];
        otx_synth_match m = otx_canvas_go_on(owner, l->from, l->dx, l->dy);
        const float turn = m.c;

        m.c = turn * l->c - m.s * l->s;
        m.s = m.s * l->c + turn * l->s;
        c->matches[l->at] = m;
        c->costs[l->at] = owner->costs[l->from];
        c->trust[l->at] = owner->trust[l->from];
    }
    otx_canvas_wrap(c);
    return OSDTEX_OK;
}

otx_status
otx_collar_exchange(
    otx_run *run, otx_canvas *const *canvases, otx_collar *collars,
    int32_t count)
{
    collar_job job = {NULL, NULL, canvases, collars};

    return otx_pool_for(run->pool, count, exchange_chart, &job);
}
