/* seam_fit.c -- the residual of lookups on a rim, put onto the texels around.
 */
#include "bake/seam_fit.h"

/* The table of the C++ library is not linked. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <stdlib.h>
#include <string.h>

/* How far a rim may be from the middle between texels that it runs through, in
 * half texels: coordinates are rounded to floats. */
static const double MIDWAY = 0.01;

/* ---- lookups --------------------------------------------------------------
 */

/* Four texels that a lookup mixes: the lower left one, and the weights of the
 * right and the upper ones. */
typedef struct lookup
{
    int64_t corner;
    double x, y;
} lookup;

/* The lower of two neighbours, and the weight of the upper. */
static int32_t
cell_at(double at, int32_t count, double *weight)
{
    const double low = floor(at - 0.5);
    const double most = count > 1 ? count - 2 : 0;
    const double held = low > 0.0 ? low < most ? low : most : 0.0;
    const double t = at - 0.5 - held;

    *weight = t > 0.0 ? t < 1.0 ? t : 1.0 : 0.0;
    return (int32_t)held;
}

/* Around a point in texels of the mip. */
static lookup
lookup_at(const otx_raster *raster, otx_vec2 at)
{
    lookup out;
    const int32_t x = cell_at(at.x - raster->origin.x, raster->width, &out.x);
    const int32_t y = cell_at(at.y - raster->origin.y, raster->height, &out.y);

    out.corner = (int64_t)y * raster->width + x;
    return out;
}

/* The chart that a texel shows or continues; -1 far from all. */
static int32_t
chart_shown(const otx_seam_fit *fit, int64_t texel)
{
    const int32_t owner = fit->grid->owners[texel];
    const int32_t rim = fit->near_rim->edges[texel];

    return owner >= 0 || rim < 0
               ? owner
               : fit->mip->layout->chart[fit->mip->rims[rim].face];
}

/* Whether all that a lookup mixes shows one chart. */
static bool
is_of_chart(const otx_seam_fit *fit, lookup at, int32_t chart)
{
    const int64_t above = at.corner + fit->raster->width;

    return chart_shown(fit, at.corner) == chart &&
           chart_shown(fit, at.corner + 1) == chart &&
           chart_shown(fit, above) == chart &&
           chart_shown(fit, above + 1) == chart;
}

static double
look_up(const otx_seam_fit *fit, lookup at, int32_t channel)
{
    const int32_t right = fit->grid->channels;
    const ptrdiff_t up = (ptrdiff_t)fit->raster->width * right;
    const float *p = fit->grid->pixels + at.corner * right + channel;

    return (1.0 - at.y) * ((1.0 - at.x) * p[0] + at.x * p[right]) +
           at.y * ((1.0 - at.x) * p[up] + at.x * p[up + right]);
}

/* ---- texels ---------------------------------------------------------------
 */

/* As the file will have it. */
static float
half_of(float value)
{
    return fabsf(value) < (float)HALF_MAX
               ? imath_half_to_float(imath_float_to_half(value))
               : value;
}

static float
hold(const otx_seam_fit *fit, int32_t channel, double value)
{
    if (fit->welds)
        return (float)value;

    const float low = fit->low[channel], high = fit->high[channel];

    return value < low ? low : value > high ? high : (float)value;
}

/* Steps to the texel on the other side of a rim midway between both, or across
 * a corner midway between four. */
static bool
is_mirrored(otx_vec2 texel, otx_vec2 foot, int32_t steps[2])
{
    const double d[2] = {2.0 * (foot.x - texel.x), 2.0 * (foot.y - texel.y)};

    for (int i = 0; i < 2; ++i)
    {
        steps[i] = (int32_t)floor(d[i] + 0.5);
        if (abs(steps[i]) > 1 || fabs(d[i] - steps[i]) > MIDWAY)
            return false;
    }
    return steps[0] != 0 || steps[1] != 0;
}

/* The texel as it is. */
static void
keep(const otx_seam_fit *fit, int32_t x, int32_t y, float *out)
{
    const int32_t channels = fit->grid->channels;
    const int64_t texel = (int64_t)y * fit->raster->width + x;

    memcpy(
        out, fit->grid->pixels + texel * channels,
        (size_t)channels * sizeof *out);
}

static void fit_texel(
    const otx_seam_fit *fit, int32_t x, int32_t y, int32_t depth,
    otx_seam_fit_edge *edge, float *out);

static bool
is_owned(const otx_seam_fit *fit, int32_t x, int32_t y, int32_t chart)
{
    return x >= 0 && x < fit->raster->width && y >= 0 &&
           y < fit->raster->height &&
           fit->grid->owners[(int64_t)y * fit->raster->width + x] == chart;
}

/* A texel of the margin with which the mean of both sides is what is wanted,
 * after rounding, too; or that of the four around a corner, where no seam ends
 * there, so that all who meet in it want the same. */
static void
complete(
    const otx_seam_fit *fit, int32_t x, int32_t y, const int32_t steps[2],
    int32_t depth, otx_seam_fit_edge *edge, const float *wanted, float *out)
{
    const int32_t channels = fit->grid->channels;
    const bool is_corner = steps[0] != 0 && steps[1] != 0;
    const int32_t others[3][2] = {
        {x + steps[0], y + steps[1]}, {x + steps[0], y}, {x, y + steps[1]}};
    float sum[OTX_IMAGE_MAX_CHANNELS] = {0.0f};

    for (int i = 0; i < (is_corner ? 3 : 1); ++i)
    {
        fit_texel(fit, others[i][0], others[i][1], depth - 1, edge, out);
        if (is_corner && !edge->goes_on)
        {
            keep(fit, x, y, out);
            return;
        }
        for (int32_t c = 0; c < channels; ++c)
            sum[c] += is_corner || fit->welds ? out[c] : half_of(out[c]);
    }
    for (int32_t c = 0; c < channels; ++c)
        out[c] = hold(fit, c, (is_corner ? 4.0 : 2.0) * wanted[c] - sum[c]);
}

/* The height of a texel near one that is to be fitted. */
static float
height_near(
    const otx_seam_fit *fit, int32_t x, int32_t y, int32_t depth,
    otx_seam_fit_edge *edge)
{
    float out;

    fit_texel(fit, x, y, depth, edge, &out);
    return out;
}

/* A height by a rim through the middles of texels, or across its end: what is
 * looked up along it must be linear from middle to middle, and is where the two
 * texels beside have the sum of the two on it. False: it is none.
 *
 *   t, foot  the nearest place on the rim */
static bool
fit_diagonal(
    const otx_seam_fit *fit, int32_t x, int32_t y, otx_seam_fit_edge *edge,
    double t, otx_vec2 foot, float *out)
{
    const otx_vec2 at = otx_raster_texel(fit->raster, x, y);
    const double dx = 2.0 * (foot.x - at.x), dy = 2.0 * (foot.y - at.y);
    const int32_t i = (int32_t)floor(dx + 0.5), j = (int32_t)floor(dy + 0.5);
    const int64_t texel = (int64_t)y * fit->raster->width + x;
    float height;

    if (fabs(dx - i) > MIDWAY || fabs(dy - j) > MIDWAY || abs(i) != abs(j))
        return false;
    if (i != 0 && otx_seam_edge_is_sharp(fit, edge, t))
    {
        otx_seam_edge_show(fit, edge, t, &height);
        *out = 2.0f * height - height_near(fit, x + i, y + j, 1, edge);
        return true;
    }
    if (edge->way != OTX_RIM_DIAGONAL)
        return false;
    if (i == 0)
        otx_seam_edge_show(fit, edge, t, out);
    else if (fit->grid->owners[texel] < 0)
        *out = height_near(fit, x + i, y, 0, edge) +
               height_near(fit, x, y + j, 0, edge) -
               height_near(fit, x + i, y + j, 0, edge);
    return true;
}

/* `depth`: 0 to share what is lacking with the other texels, 1 to complete a
 * texel of the margin from that across the rim, 2 from those around a corner,
 * too. */
static void
fit_texel(
    const otx_seam_fit *fit, int32_t x, int32_t y, int32_t depth,
    otx_seam_fit_edge *edge, float *out)
{
    const int32_t channels = fit->grid->channels;
    const int64_t texel = (int64_t)y * fit->raster->width + x;
    const int32_t rim = fit->near_rim->edges[texel];
    float wanted[OTX_IMAGE_MAX_CHANNELS];
    int32_t steps[2];

    keep(fit, x, y, out);
    if (rim < 0 || fit->raster->width < 2 || fit->raster->height < 2 ||
        !(fit->near_rim->distance[texel] < 1.0f) ||
        (!fit->welds && fit->near_seam->edges[texel] >= 0))
        return;
    if (edge->rim != rim)
        otx_seam_edge_set(fit, rim, edge);
    if (!edge->goes_on)
        return;

    const int32_t chart = fit->mip->layout->chart[fit->mip->rims[rim].face];
    const otx_vec2 at = otx_raster_texel(fit->raster, x, y);
    const double t = otx_raster_nearest(edge->ends[0], edge->ends[1], at);
    const otx_vec2 foot = otx_vec2_lerp(edge->ends[0], edge->ends[1], t);
    const lookup found = lookup_at(fit->raster, foot);

    if (fit->welds && fit_diagonal(fit, x, y, edge, t, foot, out))
        return;
    if (!is_of_chart(fit, found, chart))
        return;
    if (!(edge->known_at == t))
        otx_seam_edge_show(fit, edge, t, edge->known);
    edge->known_at = t;
    memcpy(wanted, edge->known, sizeof wanted);
    if (fit->grid->owners[texel] < 0 && is_mirrored(at, foot, steps) &&
        depth >= (steps[0] != 0) + (steps[1] != 0) &&
        is_owned(fit, x + steps[0], y + steps[1], chart))
    {
        complete(fit, x, y, steps, depth, edge, wanted, out);
        return;
    }
    for (int32_t c = 0; c < channels; ++c)
        out[c] = hold(fit, c, out[c] + (wanted[c] - look_up(fit, found, c)));
}

void
otx_seam_fit_texel(
    const otx_seam_fit *fit, int32_t x, int32_t y, otx_seam_fit_edge *edge,
    float *out)
{
    fit_texel(fit, x, y, 2, edge, out);
}
