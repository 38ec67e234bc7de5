/* cut_cost.c -- colour differences along edges, rounded to whole numbers. */
#include "relax/cut_cost.h"

#include "image/view.h"
#include "seam/difference.h"
#include "seam/edge.h"

#include <string.h>

enum
{
    SAMPLES_MAX = 256, /* on one edge */
    UNITS_PER_SIGMA = 1 << 16
};

/* A million faces of the first still fit an int64, and no face has edges that
 * cost as much as it does. */
static const int64_t uncovered_cost = (int64_t)1 << 42;
static const int64_t cost_max = (int64_t)1 << 36;

otx_cut_cost
otx_cut_cost_create(
    const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_offer *offers, const otx_cut_options *options)
{
    const double sigma =
        options->lab ? exemplars->lab_sigma : exemplars->match_sigma;

    return (otx_cut_cost){
        .surface = surface,
        .leaf = otx_surface_leaf(surface),
        .exemplars = exemplars,
        .offers = offers,
        .options = options,
        /* The picture of one colour has no sigma; any unit serves. */
        .unit = (sigma > 0.0 ? sigma : 1.0) / UNITS_PER_SIGMA,
        .edge_length = options->length * (sigma > 0.0 ? sigma : 1.0),
    };
}

static int64_t
whole(const otx_cut_cost *cost, double energy)
{
    const double units = energy / cost->unit;

    /* Written so that NaN costs the most. */
    return units < (double)cost_max ? llround(units) : cost_max;
}

/* What one side of an edge shows. */
typedef struct flank
{
    const otx_exemplar *exemplar;
    otx_vec2 ends[2]; /* of the edge */
} flank;

static const otx_exemplar *
exemplar_of(const otx_cut_cost *cost, otx_cut_view view)
{
    return &cost->exemplars[cost->offers[view.label].exemplar];
}

/* How much one side cuts through features, per texel. */
static double
through(const otx_cut_cost *cost, const flank *side, int32_t count)
{
    const otx_exemplar *e = side->exemplar;
    const otx_image *outline = &cost->options->outlines[e - cost->exemplars];
    const double wide = (double)outline->width / e->match.width;
    const double high = (double)outline->height / e->match.height;
    double sum = 0.0;

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 p =
            otx_vec2_lerp(side->ends[0], side->ends[1], (i + 0.5) / count);
        float depth = 0.0f;

        otx_view_value(
            otx_view_of(outline, e->wrap_x, e->wrap_y),
            (otx_vec2){p.x * wide, p.y * high}, &depth);
        sum += (double)depth;
    }
    return cost->options->through * e->match_sigma * sum / count;
}

/* UVs that a view gives to the ends of an edge of `face`. */
static void
side_of(
    const otx_cut_cost *cost, int32_t edge, int32_t face, otx_cut_view view,
    otx_vec2 side[2])
{
    const otx_offer *offer = &cost->offers[view.label];
    const otx_vec2 *uvs = offer->uvs + offer->first[view.slot];
    int32_t corners[2];

    otx_seam_corners(cost->leaf, edge, face, corners);
    for (int k = 0; k < 2; ++k)
        side[k] = uvs[corners[k] - cost->leaf->face_first[face]];
}

static void
sample(
    const otx_cut_cost *cost, const flank *side, double offset, int32_t count,
    float *colors)
{
    const otx_exemplar *e = side->exemplar;

    otx_seam_sample(
        cost->options->lab ? &e->lab : &e->match, e->wrap_x, e->wrap_y,
        side->ends, offset, count, colors);
}

/* Mean distance of the colours along two sides. */
static double
mean_difference(
    const otx_cut_cost *cost, const flank sides[2], double offset,
    int32_t count)
{
    float p[3 * SAMPLES_MAX], q[3 * SAMPLES_MAX];

    sample(cost, &sides[0], offset, count, p);
    sample(cost, &sides[1], offset, count, q);
    return otx_difference_mean(p, q, count);
}

/* On the edge itself and, at half the samples, on each side of it: colours
 * may agree by chance on a line, hardly on a band. */
static double
band_difference(const otx_cut_cost *cost, const flank sides[2], int32_t count)
{
    const double band = cost->options->band;
    const double middle = mean_difference(cost, sides, 0.0, count);

    if (!(band > 0.0))
        return middle;
    return 0.5 * middle +
           0.25 * mean_difference(cost, sides, band, (count + 1) / 2) +
           0.25 * mean_difference(cost, sides, -band, (count + 1) / 2);
}

int64_t
otx_cut_cost_edge(
    const otx_cut_cost *cost, int32_t edge, otx_cut_view a, otx_cut_view b)
{
    const int32_t *faces = cost->leaf->edge_faces + 2 * (size_t)edge;
    flank sides[2];

    if (a.label < 0 || b.label < 0 || a.label == b.label)
        return 0;
    sides[0].exemplar = exemplar_of(cost, a);
    sides[1].exemplar = exemplar_of(cost, b);
    side_of(cost, edge, faces[0], a, sides[0].ends);
    side_of(cost, edge, faces[1], b, sides[1].ends);
    if (sides[0].exemplar == sides[1].exemplar &&
        otx_seam_continuous(sides[0].exemplar, sides[0].ends, sides[1].ends))
        return 0;

    const double length = cost->options->texels_per_unit *
                          otx_seam_edge_length(cost->surface, edge);
    const int32_t wanted = otx_seam_sample_count(length);
    const int32_t count = wanted < SAMPLES_MAX ? wanted : SAMPLES_MAX;
    double per_texel = band_difference(cost, sides, count) + cost->edge_length;

    if (cost->options->outlines && sides[0].exemplar != sides[1].exemplar)
        per_texel +=
            through(cost, &sides[0], count) + through(cost, &sides[1], count);
    return whole(cost, length * per_texel);
}

bool
otx_cut_cost_joined(
    const otx_cut_cost *cost, int32_t edge, otx_cut_view a, otx_cut_view b)
{
    const int32_t *faces = cost->leaf->edge_faces + 2 * (size_t)edge;
    otx_vec2 sides[2][2];

    side_of(cost, edge, faces[0], a, sides[0]);
    side_of(cost, edge, faces[1], b, sides[1]);
    return memcmp(sides[0], sides[1], sizeof sides[0]) == 0;
}

/* Length of the sum of cross products of a fan: planar faces exactly. */
static double
face_area(const otx_cut_cost *cost, int32_t face)
{
    const int32_t *verts =
        cost->leaf->face_verts + cost->leaf->face_first[face];
    const int32_t size = otx_level_face_size(cost->leaf, face);
    const otx_vec3 origin = otx_vec3_load(cost->surface->points, verts[0]);
    otx_vec3 sum = {0.0, 0.0, 0.0};

    for (int32_t k = 1; k + 1 < size; ++k)
    {
        const otx_vec3 p = otx_vec3_load(cost->surface->points, verts[k]);
        const otx_vec3 q = otx_vec3_load(cost->surface->points, verts[k + 1]);

        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(otx_vec3_sub(p, origin), otx_vec3_sub(q, origin)));
    }
    return 0.5 * otx_vec3_length(sum);
}

int64_t
otx_cut_cost_face(const otx_cut_cost *cost, int32_t face, otx_cut_view view)
{
    if (view.label < 0)
        return uncovered_cost;

    const float *costs = cost->offers[view.label].cost;
    const double texels_per_unit = cost->options->texels_per_unit;

    if (!costs)
        return 0;
    return whole(
        cost, cost->options->distortion * texels_per_unit * texels_per_unit *
                  face_area(cost, face) * costs[view.slot]);
}
