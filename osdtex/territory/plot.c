/* plot.c -- a chart's texels, and what of the surface each shows. */
#include "territory/plot.h"

#include "image/image.h"

#include <string.h>

enum
{
    MARGIN = 2,      /* texels around a chart */
    SIDE_MAX = 4096, /* of a plot; a chart is a few hundred texels wide */
    ROUND_UP = 16    /* sides are multiples of this, so that levels halve */
};

static void
bounds(const otx_chart *chart, otx_vec2 *low, otx_vec2 *high)
{
    *low = (otx_vec2){INFINITY, INFINITY};
    *high = (otx_vec2){-INFINITY, -INFINITY};
    for (int32_t i = 0; i < chart->vert_count; ++i)
    {
        const otx_vec2 p = chart->flat[i];

        low->x = fmin(low->x, p.x);
        low->y = fmin(low->y, p.y);
        high->x = fmax(high->x, p.x);
        high->y = fmax(high->y, p.y);
    }
}

static int32_t
side_of(double extent)
{
    const double side = ceil(extent) + 2.0 * MARGIN;

    return side <= SIDE_MAX
               ? ((int32_t)side + ROUND_UP - 1) / ROUND_UP * ROUND_UP
               : 0;
}

/* Barycentric coordinates over the plot; false without area. */
static bool
set_coordinates(otx_plot_facet *f)
{
    const double area2 = otx_vec2_cross(
        otx_vec2_sub(f->p[1], f->p[0]), otx_vec2_sub(f->p[2], f->p[0]));

    if (!(area2 > 1e-9))
        return false;
    for (int k = 0; k < 3; ++k)
    {
        const otx_vec2 a = f->p[(k + 1) % 3], b = f->p[(k + 2) % 3];

        f->at[k] = otx_vec2_cross(a, b) / area2;
        f->dx[k] = (a.y - b.y) / area2;
        f->dy[k] = (b.x - a.x) / area2;
    }
    return true;
}

/* The facet in its own plane, texels; a step (dx, dy) of the plot is one on the
 * surface by g. */
static void
set_metric(const otx_surface *surface, double texels, otx_plot_facet *f)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    int32_t verts[3];
    otx_vec3 x[3];

    for (int k = 0; k < 3; ++k)
    {
        verts[k] = leaf->face_verts[f->facet.corners[k]];
        x[k] = otx_vec3_load(surface->points, verts[k]);
    }

    const double unit = texels * otx_surface_density(surface, verts, 3);
    const otx_vec3 a = otx_vec3_scale(unit, otx_vec3_sub(x[1], x[0]));
    const otx_vec3 b = otx_vec3_scale(unit, otx_vec3_sub(x[2], x[0]));
    const otx_vec3 e = otx_vec3_unit(a);
    const otx_vec2 q1 = {otx_vec3_length(a), 0.0};
    const otx_vec2 q2 = {
        otx_vec3_dot(b, e), otx_vec3_length(otx_vec3_cross(e, b))};
    const double g[4] = {
        f->dx[1] * q1.x + f->dx[2] * q2.x, f->dy[1] * q1.x + f->dy[2] * q2.x,
        f->dx[2] * q2.y, f->dy[2] * q2.y};
    const otx_vec2 turn = {g[0] + g[3], g[2] - g[1]};
    const double length = otx_vec2_length(turn);

    f->rotation = length > 0.0 ? otx_vec2_scale(1.0 / length, turn)
                               : (otx_vec2){1.0, 0.0};
    f->metric[0] = f->rotation.x * g[0] + f->rotation.y * g[2];
    f->metric[1] = f->rotation.x * g[1] + f->rotation.y * g[3];
    f->metric[2] = f->rotation.x * g[3] - f->rotation.y * g[1];
}

bool
otx_plot_facet_of(
    const otx_plot *plot, const otx_surface *surface, double texels,
    int32_t slot, int32_t index, otx_plot_facet *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t face = plot->chart->faces[slot];

    out->facet = otx_facet_at(leaf, face, index);
    for (int k = 0; k < 3; ++k)
        out->p[k] = otx_plot_corner(
            plot, slot, out->facet.corners[k] - leaf->face_first[face]);
    if (!set_coordinates(out))
        return false;
    set_metric(surface, texels, out);
    return true;
}

static int32_t
clamp(double v, int32_t side)
{
    return v < 0.0 ? 0 : v > side ? side : (int32_t)v;
}

void
otx_plot_box(const otx_plot *plot, const otx_plot_facet *f, int32_t box[4])
{
    const otx_vec2 *p = f->p;

    box[0] = clamp(floor(fmin(p[0].x, fmin(p[1].x, p[2].x))), plot->width);
    box[1] = clamp(floor(fmin(p[0].y, fmin(p[1].y, p[2].y))), plot->height);
    box[2] = clamp(ceil(fmax(p[0].x, fmax(p[1].x, p[2].x))), plot->width);
    box[3] = clamp(ceil(fmax(p[0].y, fmax(p[1].y, p[2].y))), plot->height);
}

static void
draw_facet(const otx_plot_facet *f, int32_t id, otx_plot *plot)
{
    int32_t box[4];

    otx_plot_box(plot, f, box);
    for (int32_t y = box[1]; y < box[3]; ++y)
        for (int32_t x = box[0]; x < box[2]; ++x)
        {
            int32_t *to = &plot->facets[(int64_t)y * plot->width + x];
            double at[3];

            otx_plot_at(f, x, y, at);
            if (*to < 0 && at[0] >= -1e-9 && at[1] >= -1e-9 && at[2] >= -1e-9)
                *to = id;
        }
}

static void
draw(const otx_surface *surface, otx_plot *plot)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t slot = 0; slot < plot->chart->face_count; ++slot)
    {
        const int32_t facets = otx_facet_count(leaf, plot->chart->faces[slot]);

        for (int32_t i = 0; i < facets && i < OTX_PLOT_FACETS; ++i)
        {
            otx_plot_facet f;

            if (otx_plot_facet_of(plot, surface, 1.0, slot, i, &f))
                draw_facet(&f, otx_plot_id(slot, i), plot);
        }
    }
}

otx_status
otx_plot_build(
    otx_run *run, const otx_surface *surface, const otx_chart *chart,
    otx_plot *out)
{
    otx_vec2 low, high;
    int64_t count;

    *out = (otx_plot){.chart = chart};
    if (chart->face_count == 0)
        return OSDTEX_OK;
    bounds(chart, &low, &high);
    out->width = side_of(high.x - low.x);
    out->height = side_of(high.y - low.y);
    if (out->width == 0 || out->height == 0)
    {
        out->width = out->height = 0;
        return OSDTEX_OK;
    }
    out->origin = otx_vec2_sub(low, (otx_vec2){MARGIN, MARGIN});
    count = (int64_t)out->width * out->height;
    out->facets = OTX_NEW(run->scratch, int32_t, count);
    out->near = OTX_ZNEW(run->scratch, uint8_t, count);
    OTX_TRY(otx_run_ok(run));
    memset(out->facets, 0xff, (size_t)count * sizeof *out->facets);
    draw(surface, out);
    return OSDTEX_OK;
}

static void
mark_segment(otx_vec2 a, otx_vec2 b, double reach, otx_plot *plot)
{
    const otx_vec2 d = otx_vec2_sub(b, a);
    const double square = otx_vec2_dot(d, d);
    const int32_t x0 = clamp(fmin(a.x, b.x) - reach, plot->width);
    const int32_t x1 = clamp(fmax(a.x, b.x) + reach + 1.0, plot->width);
    const int32_t y0 = clamp(fmin(a.y, b.y) - reach, plot->height);
    const int32_t y1 = clamp(fmax(a.y, b.y) + reach + 1.0, plot->height);

    for (int32_t y = y0; y < y1; ++y)
        for (int32_t x = x0; x < x1; ++x)
        {
            const otx_vec2 p = otx_vec2_sub((otx_vec2){x + 0.5, y + 0.5}, a);
            double t = square > 0.0 ? otx_vec2_dot(p, d) / square : 0.0;

            t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;

            const otx_vec2 off = otx_vec2_sub(p, otx_vec2_scale(t, d));

            if (otx_vec2_dot(off, off) <= reach * reach)
                plot->near[(int64_t)y * plot->width + x] = 1;
        }
}

void
otx_plot_mark(
    const otx_surface *surface, const uint8_t *seam, double reach,
    otx_plot *plot)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t slot = 0; plot->width > 0 && slot < plot->chart->face_count;
         ++slot)
    {
        const int32_t face = plot->chart->faces[slot];
        const int32_t size = otx_level_face_size(leaf, face);

        for (int32_t k = 0; k < size; ++k)
            if (seam[leaf->face_edges[leaf->face_first[face] + k]])
                mark_segment(
                    otx_plot_corner(plot, slot, k),
                    otx_plot_corner(plot, slot, (k + 1) % size), reach, plot);
    }
}
