/* seam_fit.c -- the residual of lookups on a rim, put onto the texels around.
 */
#include "bake/seam_fit.h"

#include "mapping/source.h"
#include "surface/facet.h"

/* The table of the C++ library is not linked. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <stdlib.h>
#include <string.h>

enum
{
    SAMPLES = 4 /* within a texel of an edge */
};

/* How far a rim may be from the middle between texels that it runs through, in
 * half texels: coordinates are rounded to floats. */
static const double MIDWAY = 0.01;

/* A fraction of an edge that is nearer to an end than this is the end. */
static const double END = 1e-3;

/* Exemplar UVs that differ by less are one: rounding. */
static const double SAME = 1e-5;

/* Colours of mixed faces that differ by less of the exemplar's range are one:
 * lattices of photographs repeat no better. */
static const double ALIKE = 1.0 / 32.0;

/* ---- what an edge shows ---------------------------------------------------
 */

static otx_vec2
corner_of(const float *uvs, int32_t corner)
{
    const float *uv = uvs + 2 * (size_t)corner;

    return (otx_vec2){uv[0], uv[1]};
}

/* An edge as the side of its facet: the corners of the edge, then the third. */
static void
edge_corners(
    const otx_level *leaf, int32_t face, int32_t edge, int32_t corners[3])
{
    int32_t side;
    const otx_facet facet = otx_facet_at_edge(leaf, face, edge, &side);

    for (int k = 0; k < 3; ++k)
        corners[k] = facet.corners[(side + k) % 3];
}

static double
length_of(const otx_mip *mip, const int32_t corners[3])
{
    const otx_vec2 d = otx_vec2_sub(
        otx_mip_texel(mip, corners[1]), otx_mip_texel(mip, corners[0]));

    return otx_vec2_length(d);
}

/* The change of barycentric coordinates from a texel to the next one away from
 * the edge; 0 where the facet has no area. */
static void
step_away(const otx_seam_fit *fit, const int32_t corners[3], double away[3])
{
    const otx_mip *mip = fit->mip;
    const otx_vec2 at = otx_mip_texel(mip, corners[0]);
    const otx_vec2 edge = otx_vec2_sub(otx_mip_texel(mip, corners[1]), at);
    const otx_vec2 arm = otx_vec2_sub(otx_mip_texel(mip, corners[2]), at);
    const double sq = otx_vec2_dot(edge, edge);
    const double height = otx_vec2_cross(edge, arm) / sqrt(sq);
    const double foot = otx_vec2_dot(arm, edge) / sq;

    away[0] = away[1] = away[2] = 0.0;
    /* Written so that NaN, of an edge without length, lands here too. */
    if (!(fabs(height) > 0.0))
        return;
    away[0] = (foot - 1.0) / height;
    away[1] = -foot / height;
    away[2] = 1.0 / height;
}

/* The exemplar's UV from a texel to the next one away from the edge. */
static otx_vec2
away_from_edge(const otx_seam_fit *fit, const int32_t corners[3])
{
    const float *uvs = fit->mapping->uvs;
    const otx_mip *mip = fit->mip;
    const otx_vec2 at = otx_mip_texel(mip, corners[0]);
    const otx_vec2 edge = otx_vec2_sub(otx_mip_texel(mip, corners[1]), at);
    const otx_vec2 arm = otx_vec2_sub(otx_mip_texel(mip, corners[2]), at);
    const double sq = otx_vec2_dot(edge, edge);
    const double height = otx_vec2_cross(edge, arm) / sqrt(sq);

    /* Written so that NaN, of an edge without length, lands here too. */
    if (!(fabs(height) > 0.0))
        return (otx_vec2){0.0, 0.0};

    const otx_vec2 uv = corner_of(uvs, corners[0]);
    const otx_vec2 foot = otx_vec2_lerp(
        uv, corner_of(uvs, corners[1]), otx_vec2_dot(arm, edge) / sq);

    return otx_vec2_scale(
        1.0 / height, otx_vec2_sub(corner_of(uvs, corners[2]), foot));
}

/* Texels lie to either side of the edge: a lookup on it sees two of them. */
static otx_seam_fit_side
side_of(
    const otx_seam_fit *fit, int32_t face, const int32_t corners[3],
    double step)
{
    const otx_vec2 uv = corner_of(fit->mapping->uvs, corners[0]);
    otx_seam_fit_side side = {
        .face = face,
        .exemplar = otx_source_of(fit->mapping, face),
        .corners = {corners[0], corners[1], corners[2]},
        .dx = {-step / SAMPLES, step / SAMPLES, 0.0},
        .layered = otx_show_is_layered(fit->show, face),
        .uv = uv,
        .along = otx_vec2_sub(corner_of(fit->mapping->uvs, corners[1]), uv),
    };

    step_away(fit, corners, side.dy);
    for (int k = 0; k < 3; ++k)
        side.dy[k] *= 2.0;
    side.probes = otx_texture_measure(
        &fit->textures[side.exemplar],
        otx_vec2_scale(step / SAMPLES, side.along),
        otx_vec2_scale(2.0, away_from_edge(fit, corners)));
    return side;
}

static int32_t
edge_of(const otx_level *leaf, int32_t face, int32_t edge)
{
    const int32_t *edges = leaf->face_edges + leaf->face_first[face];
    int32_t k = 0;

    while (edges[k] != edge)
        ++k;
    return k;
}

/* Whether a step in the exemplar leads to the same place, where it wraps also
 * by whole pictures. */
static bool
is_nothing(double step, bool wrap)
{
    return fabs(wrap ? step - floor(step + 0.5) : step) < SAME;
}

/* The height of a place. */
static float
height_at(const otx_seam_fit *fit, const otx_show_place *place)
{
    const int32_t exemplar = otx_source_of(fit->mapping, place->face);
    float values[OTX_IMAGE_MAX_CHANNELS];

    otx_show_color(
        fit->show, fit->textures, place, exemplar, 1.0,
        fit->textures[exemplar].pyramid.levels[0].channels, values);
    return values[fit->show->carry->height];
}

/* What one side shows at fraction t of the way from its corner 0. */
static void
color_on_side(
    const otx_seam_fit *fit, const otx_seam_fit_side *side, double t,
    float *color)
{
    const otx_texture *texture = &fit->textures[side->exemplar];
    const double at[3] = {1.0 - t, t, 0.0};
    const otx_show_place place = {
        side->face, side->corners, at, side->dx, side->dy};

    if (fit->welds && side->layered)
    {
        *color = height_at(fit, &place);
        return;
    }
    if (side->layered)
    {
        otx_show_color(
            fit->show, fit->textures, &place, side->exemplar, 1.0,
            fit->grid->channels, color);
        return;
    }
    otx_texture_probe(
        texture, &side->probes,
        otx_vec2_add(side->uv, otx_vec2_scale(t, side->along)), color);
    if (fit->welds)
    {
        const otx_carry_matrix none = {1.0, 0.0, 0.0, 1.0};

        otx_carry_values(
            fit->show->carry, &none,
            otx_carry_scale(fit->show->carry, side->corners, at),
            side->exemplar, color);
        return;
    }
    /* Opaque, where only another exemplar has alpha. */
    for (int32_t c = texture->pyramid.levels[0].channels;
         c < fit->grid->channels; ++c)
        color[c] = 1.0f;
}

/* Whether both sides of an edge show the same: the same place of the exemplar
 * where each looks up one, else the same colours, as far as the eye can tell.
 */
static bool
is_whole(const otx_seam_fit *fit, const otx_seam_fit_side sides[2])
{
    float a[OTX_IMAGE_MAX_CHANNELS], b[OTX_IMAGE_MAX_CHANNELS];

    if (!sides[0].layered && !sides[1].layered)
    {
        const otx_texture *texture = &fit->textures[sides[0].exemplar];
        const otx_vec2 end = otx_vec2_add(sides[1].uv, sides[1].along);
        const otx_vec2 d = otx_vec2_sub(end, sides[0].uv);
        const otx_vec2 e = otx_vec2_add(sides[1].along, sides[0].along);

        return sides[0].exemplar == sides[1].exemplar &&
               is_nothing(d.x, texture->wrap_x) &&
               is_nothing(d.y, texture->wrap_y) && is_nothing(e.x, false) &&
               is_nothing(e.y, false);
    }
    for (int s = 0; s <= SAMPLES; ++s)
    {
        color_on_side(fit, &sides[0], (double)s / SAMPLES, a);
        color_on_side(fit, &sides[1], 1.0 - (double)s / SAMPLES, b);
        for (int32_t c = 0; c < fit->grid->channels; ++c)
            if (!(fabs((double)a[c] - b[c]) <=
                  ALIKE * ((double)fit->high[c] - fit->low[c])))
                return false;
    }
    return true;
}

static void
set_edge(const otx_seam_fit *fit, int32_t rim, otx_seam_fit_edge *out)
{
    const otx_mip *mip = fit->mip;
    const otx_level *leaf = otx_surface_leaf(mip->layout->surface);
    const otx_mip_rim *r = &mip->rims[rim];
    const int32_t edge = leaf->face_edges[leaf->face_first[r->face] + r->edge];
    const int32_t other = otx_layout_across(mip->layout, r->face, r->edge);
    int32_t here[3], there[3];

    out->rim = rim;
    out->known_at = -1.0;
    out->goes_on = other >= 0 || fit->welds;
    if (!out->goes_on)
        return;
    edge_corners(leaf, r->face, r->edge, here);
    edge_corners(leaf, r->face, r->edge, there);
    if (other >= 0)
        edge_corners(leaf, other, edge_of(leaf, other, edge), there);
    else
    {
        /* The same side backwards: rims that end there want its heights. */
        there[0] = here[1];
        there[1] = here[0];
    }

    const double texels = fmin(length_of(mip, here), length_of(mip, there));

    out->step = texels > 1.0 ? 1.0 / texels : 1.0;
    otx_mip_ends(mip, r, out->ends);
    out->sides[0] = side_of(fit, r->face, here, out->step);
    out->sides[1] =
        side_of(fit, other >= 0 ? other : r->face, there, out->step);
    /* Along a seam the step is the mapping's own. */
    out->goes_on = fit->welds || is_whole(fit, out->sides);
}

/* The height of a face around corner k, a texel of it. */
static float
height_at_corner(const otx_seam_fit *fit, int32_t face, int32_t k)
{
    const otx_level *leaf = otx_surface_leaf(fit->mapping->surface);
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const int32_t corners[3] = {
        first + k, first + (k + 1) % size, first + (k + size - 1) % size};
    const double at[3] = {1.0, 0.0, 0.0};
    double along[3] = {0.0}, away[3];
    const double texels = length_of(fit->mip, corners);

    along[1] = texels > 1.0 ? 1.0 / texels : 1.0;
    along[0] = -along[1];
    step_away(fit, corners, away);
    return height_at(fit, &(otx_show_place){face, corners, at, along, away});
}

/* Adds up heights of the faces around a corner, over the edges before it (way
 * 0) or after it (1), until one comes again or the surface ends. True when it
 * has been all around. */
static bool
sum_around(
    const otx_seam_fit *fit, int32_t face, int32_t k, int way, double *sum,
    int32_t *count)
{
    const otx_layout *layout = fit->mip->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t begin = face,
                  vert = leaf->face_verts[leaf->face_first[face] + k];

    for (;;)
    {
        const int32_t size = otx_level_face_size(leaf, face);
        const int32_t over = way ? k : (k + size - 1) % size;
        const int32_t other = otx_layout_across(layout, face, over);
        int32_t first;

        if (other < 0 || other == begin)
            return other >= 0;
        first = leaf->face_first[other];
        for (k = 0; leaf->face_verts[first + k] != vert;)
            ++k;
        face = other;
        *sum += (double)height_at_corner(fit, face, k);
        ++*count;
    }
}

/* What all faces around corner k of a face show there, in the mean. */
static float
height_at_vertex(const otx_seam_fit *fit, int32_t face, int32_t k)
{
    double sum = (double)height_at_corner(fit, face, k);
    int32_t count = 1;

    if (!sum_around(fit, face, k, 1, &sum, &count))
        sum_around(fit, face, k, 0, &sum, &count);
    return (float)(sum / count);
}

/* Whether a fraction of the way is one of the ends, which other edges have as
 * well: coordinates are rounded to floats. */
static bool
is_end(double t)
{
    return !(t > END && t < 1.0 - END);
}

/* What both sides show at fraction t of the way, in the mean. At an end, which
 * other edges have as well, without what is beside it. */
static void
color_of(
    const otx_seam_fit *fit, const otx_seam_fit_edge *edge, double t,
    float *color)
{
    const int32_t channels = fit->grid->channels;

    if (fit->welds && is_end(t))
    {
        const otx_level *leaf = otx_surface_leaf(fit->mip->layout->surface);
        const otx_mip_rim *r = &fit->mip->rims[edge->rim];
        const int32_t size = otx_level_face_size(leaf, r->face);

        *color = height_at_vertex(
            fit, r->face, (r->edge + (t < 0.5 ? 0 : 1)) % size);
        return;
    }

    const double step = t > 0.0 && t < 1.0 ? edge->step : 0.0;
    double sum[OTX_IMAGE_MAX_CHANNELS] = {0.0};

    for (int i = 0; i < 2; ++i)
        for (int s = 0; s < SAMPLES; ++s)
        {
            const double at = t + ((s + 0.5) / SAMPLES - 0.5) * step;

            color_on_side(fit, &edge->sides[i], i == 0 ? at : 1.0 - at, color);
            for (int32_t c = 0; c < channels; ++c)
                sum[c] += color[c];
        }
    for (int32_t c = 0; c < channels; ++c)
        color[c] = (float)(sum[c] / (2 * SAMPLES));
}

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
        set_edge(fit, rim, edge);
    if (!edge->goes_on)
        return;

    const int32_t chart = fit->mip->layout->chart[fit->mip->rims[rim].face];
    const otx_vec2 at = otx_raster_texel(fit->raster, x, y);
    const double t = otx_raster_nearest(edge->ends[0], edge->ends[1], at);
    const otx_vec2 foot = otx_vec2_lerp(edge->ends[0], edge->ends[1], t);
    const lookup found = lookup_at(fit->raster, foot);

    if (!is_of_chart(fit, found, chart))
        return;
    if (!(edge->known_at == t))
        color_of(fit, edge, t, edge->known);
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
