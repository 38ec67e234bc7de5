/* show_decals.c -- what decals leave of the colour below them. */
#include "mapping/show_decals.h"

#include "image/view.h"

/* UVs that differ by less go on: they are floats. */
static const double SAME = 1e-4;

/* One decal on a face. */
typedef struct piece
{
    const otx_lookup *items; /* by the corners of the face */
    const otx_fragment *fragment;
} piece;

static int32_t
count_on(const otx_show_view *show, int32_t face)
{
    const otx_lookups *l = &show->decals->lookups;
    const int32_t size = show->face_first[face + 1] - show->face_first[face];

    return (int32_t)((l->first[face + 1] - l->first[face]) / size);
}

static piece
piece_at(const otx_show_view *show, int32_t face, int32_t index)
{
    const otx_lookups *l = &show->decals->lookups;
    const int32_t size = show->face_first[face + 1] - show->face_first[face];
    const otx_lookup *items = l->items + l->first[face] + (int64_t)index * size;

    return (piece){items, &l->fragments[items->fragment]};
}

static otx_vec2
mix(const otx_show_view *show, const otx_show_place *place, const piece *p,
    const double w[3])
{
    const int32_t first = show->face_first[place->face];
    otx_vec2 sum = {0, 0};

    for (int k = 0; k < 3; ++k)
    {
        const float *uv = p->items[place->corners[k] - first].uv;

        sum = otx_vec2_add(sum, otx_vec2_scale(w[k], (otx_vec2){uv[0], uv[1]}));
    }
    return sum;
}

/* The share of a stretch of `width` about `at` that is within 0 and 1. */
static double
within(double at, double width)
{
    if (!(width > 1e-9))
        return at >= 0.0 && at <= 1.0;

    const double low = fmax(at - 0.5 * width, 0.0);
    const double high = fmin(at + 0.5 * width, 1.0);

    return fmax(high - low, 0.0) / width;
}

static double
weight_of(const otx_show_place *place, const piece *p, int32_t first)
{
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
        sum += place->at[k] * p->items[place->corners[k] - first].weight;
    return fmin(fmax(sum, 0.0), 1.0);
}

/* How much of a place's footprint is on the picture, times the decal's weight.
 */
static double
coverage(
    const otx_show_view *show, const otx_show_place *place, const piece *p,
    otx_vec2 uv, otx_vec2 dx, otx_vec2 dy)
{
    return weight_of(place, p, show->face_first[place->face]) *
           within(uv.x, fabs(dx.x) + fabs(dy.x)) *
           within(uv.y, fabs(dx.y) + fabs(dy.y));
}

static void
put_over(
    const otx_texture *texture, const otx_texture_probes *probes, otx_vec2 uv,
    double weight, int32_t channels, float *color)
{
    const int32_t own = texture->pyramid.levels[0].channels;
    float value[OTX_IMAGE_MAX_CHANNELS];

    otx_texture_probe(texture, probes, uv, value);
    if (own < 4)
        value[3] = 1.0f;

    const double left = 1.0 - weight * (double)value[3];

    for (int32_t c = 0; c < channels; ++c)
        color[c] = (float)(weight * (double)value[c] + left * (double)color[c]);
}

void
otx_show_decals_color(
    const otx_show_view *show, const otx_show_place *place, double share,
    int32_t channels, float *color)
{
    const int32_t count = count_on(show, place->face);

    for (int32_t i = 0; i < count; ++i)
    {
        const piece p = piece_at(show, place->face, i);
        const otx_texture *texture =
            &show->decals->textures[p.fragment->exemplar];
        const otx_vec2 uv = mix(show, place, &p, place->at);
        otx_vec2 dx = {0, 0}, dy = {0, 0};
        otx_texture_probes probes = {.count = 1};

        if (place->dx)
        {
            dx = otx_vec2_scale(share, mix(show, place, &p, place->dx));
            dy = otx_vec2_scale(share, mix(show, place, &p, place->dy));
            probes = otx_texture_measure(texture, dx, dy);
        }

        const double weight = coverage(show, place, &p, uv, dx, dy);

        if (weight > 0.0)
            put_over(texture, &probes, uv, weight, channels, color);
    }
}

/* Alpha of a picture, unfiltered. */
static double
alpha_at(const otx_exemplar *picture, otx_vec2 uv)
{
    float value[OTX_IMAGE_MAX_CHANNELS];

    if (picture->linear.channels < 4)
        return 1.0;
    otx_view_value(
        otx_view_of(&picture->linear, false, false),
        (otx_vec2){uv.x * picture->linear.width, uv.y * picture->linear.height},
        value);
    return (double)value[3];
}

void
otx_show_decals_lab(
    const otx_show_view *show, const otx_show_place *place, float lab[3])
{
    static const otx_vec2 NONE = {0, 0};
    const int32_t count = count_on(show, place->face);

    for (int32_t i = 0; i < count; ++i)
    {
        const piece p = piece_at(show, place->face, i);
        const otx_exemplar *picture =
            &show->decals->pictures[p.fragment->exemplar];
        const otx_vec2 uv = mix(show, place, &p, place->at);
        const double weight =
            coverage(show, place, &p, uv, NONE, NONE) * alpha_at(picture, uv);
        float value[3];

        if (!(weight > 0.0) || !picture->lab.pixels)
            continue;
        otx_view_value(
            otx_view_of(&picture->lab, false, false),
            (otx_vec2){uv.x * picture->lab.width, uv.y * picture->lab.height},
            value);
        for (int c = 0; c < 3; ++c)
            lab[c] += (float)weight * (value[c] - lab[c]);
    }
}

/* Whether a decal shows at some place between two ends. */
static bool
meets_picture(const float *a, const float *b)
{
    return fmaxf(a[0], b[0]) > 0.0f && fminf(a[0], b[0]) < 1.0f &&
           fmaxf(a[1], b[1]) > 0.0f && fminf(a[1], b[1]) < 1.0f;
}

static bool
is_same(const float *a, const float *b)
{
    return fabs((double)a[0] - (double)b[0]) < SAME &&
           fabs((double)a[1] - (double)b[1]) < SAME;
}

static const float *
end_of(const otx_show_view *show, const piece *p, int32_t face, int32_t corner)
{
    return p->items[corner - show->face_first[face]].uv;
}

/* Whether each decal of one side that comes to the edge is on the other, too.
 */
static bool
is_met(
    const otx_show_view *show, const int32_t faces[2],
    const int32_t corners[2][2], int side)
{
    const int32_t face = faces[side], other = faces[1 - side];

    for (int32_t i = 0; i < count_on(show, face); ++i)
    {
        const piece p = piece_at(show, face, i);
        const float *a = end_of(show, &p, face, corners[side][0]);
        const float *b = end_of(show, &p, face, corners[side][1]);
        bool met = !meets_picture(a, b);

        for (int32_t k = 0; k < count_on(show, other) && !met; ++k)
        {
            const piece q = piece_at(show, other, k);

            met = q.fragment == p.fragment &&
                  is_same(a, end_of(show, &q, other, corners[1 - side][0])) &&
                  is_same(b, end_of(show, &q, other, corners[1 - side][1]));
        }
        if (!met)
            return false;
    }
    return true;
}

bool
otx_show_decals_go_on(
    const otx_show_view *show, const int32_t faces[2],
    const int32_t corners[2][2])
{
    return is_met(show, faces, corners, 0) && is_met(show, faces, corners, 1);
}
