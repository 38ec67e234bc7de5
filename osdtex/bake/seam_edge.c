/* seam_edge.c -- what both sides of an edge show, settled once. */
#include "bake/seam_edge.h"

#include "mapping/source.h"
#include "surface/facet.h"

enum
{
    SAMPLES = 4 /* within a texel of an edge */
};

/* A fraction of an edge that is nearer to an end than this is the end. */
static const double END = 1e-3;

/* Exemplar UVs that differ by less are one: rounding. */
static const double SAME = 1e-5;

/* Colours of mixed faces that differ by less of the exemplar's range are one:
 * lattices of photographs repeat no better. */
static const double ALIKE = 1.0 / 32.0;

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

/* Texels of an edge of the cage that has `count` such leaf edges. */
static double
texels_of(const otx_mip *mip, const int32_t corners[3], int32_t count)
{
    const otx_vec2 d = otx_vec2_sub(
        otx_mip_texel(mip, corners[1]), otx_mip_texel(mip, corners[0]));

    return count * fmax(fabs(d.x), fabs(d.y));
}

/* How heights can meet along an edge of a block. */
static void
set_knots(
    const otx_seam_fit *fit, const int32_t here[3], const int32_t there[3],
    otx_seam_fit_edge *out)
{
    const otx_layout *layout = fit->mip->layout;
    double n, m;

    if (!fit->welds || !layout->is_atlas || layout->is_charts)
        return;
    out->way = otx_rim_way_of(out->ends);
    out->chain = otx_rim_chain_of(layout, &out->place);
    n = texels_of(fit->mip, here, out->chain.count);
    m = texels_of(fit->mip, there, out->chain.count);
    if (fabs(n - m) > 0.5)
        out->parts = otx_rim_knots(n, m);
}

/* Places a leaf edge.
 *
 *   step  of samples, as a share of it; at least that of the larger texel */
static void
set_edge_at(
    const otx_seam_fit *fit, const otx_mip_rim *r, double step,
    otx_seam_fit_edge *out)
{
    const otx_mip *mip = fit->mip;
    const otx_level *leaf = otx_surface_leaf(mip->layout->surface);
    const int32_t edge = leaf->face_edges[leaf->face_first[r->face] + r->edge];
    const int32_t other = otx_layout_across(mip->layout, r->face, r->edge);
    int32_t here[3], there[3];

    out->place = *r;
    out->way = OTX_RIM_ANY;
    out->parts = 0;
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

    out->step = fmax(texels > 1.0 ? 1.0 / texels : 1.0, fmin(step, 1.0));
    otx_mip_ends(mip, r, out->ends);
    set_knots(fit, here, there, out);
    out->sides[0] = side_of(fit, r->face, here, out->step);
    out->sides[1] =
        side_of(fit, other >= 0 ? other : r->face, there, out->step);
    /* Along a seam the step is the mapping's own. */
    out->goes_on = fit->welds || is_whole(fit, out->sides);
}

void
otx_seam_edge_set(const otx_seam_fit *fit, int32_t rim, otx_seam_fit_edge *out)
{
    set_edge_at(fit, &fit->mip->rims[rim], 0.0, out);
    out->rim = rim;
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
        const otx_mip_rim *r = &edge->place;
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
            const double off = t + ((s + 0.5) / SAMPLES - 0.5) * step;
            const double at = fit->welds ? fmin(fmax(off, 0.0), 1.0) : off;

            color_on_side(fit, &edge->sides[i], i == 0 ? at : 1.0 - at, color);
            for (int32_t c = 0; c < channels; ++c)
                sum[c] += color[c];
        }
    for (int32_t c = 0; c < channels; ++c)
        color[c] = (float)(sum[c] / (2 * SAMPLES));
}

/* Where knot k of `parts` is: the middle of a part; before and behind all the
 * ends. */
static double
knot_at(int32_t k, int32_t parts)
{
    return k < 0 ? 0.0 : k < parts ? (k + 0.5) / parts : 1.0;
}

/* What an edge of the cage shows at a knot, over a part of it. */
static double
height_at_knot(
    const otx_seam_fit *fit, const otx_seam_fit_edge *edge, int32_t k)
{
    const otx_rim_chain chain = edge->chain;
    const double at = knot_at(k, edge->parts) * chain.count;
    const int32_t index =
        (int32_t)at < chain.count ? (int32_t)at : chain.count - 1;
    const otx_mip_rim place =
        otx_rim_chain_step(fit->mip->layout, &edge->place, index - chain.index);
    otx_seam_fit_edge there = {.rim = -1};
    float height;

    set_edge_at(fit, &place, (double)chain.count / edge->parts, &there);
    color_of(fit, &there, at - index, &height);
    return (double)height;
}

void
otx_seam_edge_show(
    const otx_seam_fit *fit, const otx_seam_fit_edge *edge, double t,
    float *out)
{
    if (edge->parts == 0)
    {
        color_of(fit, edge, t, out);
        return;
    }

    const double at = (edge->chain.index + t) / edge->chain.count;
    const int32_t k = (int32_t)floor(at * edge->parts - 0.5);
    const double low = knot_at(k, edge->parts);
    const double high = knot_at(k + 1, edge->parts);
    const double share = (at - low) / (high - low);

    *out =
        (float)((1.0 - share) * height_at_knot(fit, edge, k) + share * height_at_knot(fit, edge, k + 1));
}

bool
otx_seam_edge_is_sharp(
    const otx_seam_fit *fit, const otx_seam_fit_edge *edge, double t)
{
    const otx_layout *layout = fit->mip->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t face = edge->place.face, first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const int32_t k = (edge->place.edge + (t < 0.5 ? 0 : 1)) % size;
    const int32_t before = (k + size - 1) % size;
    otx_vec2 ends[2];

    if (!layout->is_atlas || layout->is_charts || !is_end(t) ||
        leaf->face_verts[first + k] >= layout->surface->levels[0].vert_count ||
        !layout->rim[first + k] || !layout->rim[first + before])
        return false;
    otx_mip_ends(fit->mip, &(otx_mip_rim){face, k}, ends);

    const otx_rim_way after = otx_rim_way_of(ends);

    otx_mip_ends(fit->mip, &(otx_mip_rim){face, before}, ends);
    return after != OTX_RIM_ANY && otx_rim_way_of(ends) != OTX_RIM_ANY &&
           (after == OTX_RIM_DIAGONAL ||
            otx_rim_way_of(ends) == OTX_RIM_DIAGONAL);
}
