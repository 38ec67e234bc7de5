/* view.c -- lookups at borders, with derivatives, and along lines. */
#include "image/view.h"

/* ---- one value ---- */

/* The two texels that a lookup mixes along one axis. */
typedef struct tap
{
    int32_t low, high;
    double weight; /* of `high` */
} tap;

/* `x` in texels from the first texel's centre. Comparisons are written so that
 * NaN and infinities land on a texel too. */
static tap
tap_at(double x, int32_t side, bool wrap)
{
    if (wrap)
    {
        x = otx_view_wrap(x, side);
        if (!(x >= 0.0 && x < side))
            x = 0.0;
    }
    else if (!(x > 0.0))
        x = 0.0;
    else if (x > side - 1)
        x = side - 1;

    const int32_t low = (int32_t)x;
    const int32_t next = low + 1;

    return (tap){low, next < side ? next : wrap ? 0 : low, x - low};
}

void
otx_view_value_at_border(otx_image_view view, otx_vec2 texel, float *color)
{
    const otx_image *image = view.image;
    const tap x = tap_at(texel.x - 0.5, image->width, view.wrap_x);
    const tap y = tap_at(texel.y - 0.5, image->height, view.wrap_y);
    const float *c00 = otx_image_at(image, x.low, y.low);
    const float *c10 = otx_image_at(image, x.high, y.low);
    const float *c01 = otx_image_at(image, x.low, y.high);
    const float *c11 = otx_image_at(image, x.high, y.high);

    for (int32_t c = 0; c < image->channels; ++c)
        color[c] = (float)otx_view_mix(
            c00[c], c10[c], c01[c], c11[c], x.weight, y.weight);
}

/* ---- with its derivative ---- */

void
otx_view_slope(
    otx_image_view view, otx_vec2 texel, double color[3], otx_vec2 slope[3])
{
    const otx_image *image = view.image;
    const double x = texel.x - 0.5, y = texel.y - 0.5;
    const double fx = floor(x), fy = floor(y);
    const double u = x - fx, v = y - fy;
    const int32_t x0 = otx_view_fold((int32_t)fx, image->width, view.wrap_x);
    const int32_t x1 =
        otx_view_fold((int32_t)fx + 1, image->width, view.wrap_x);
    const int32_t y0 = otx_view_fold((int32_t)fy, image->height, view.wrap_y);
    const int32_t y1 =
        otx_view_fold((int32_t)fy + 1, image->height, view.wrap_y);
    const float *p00 = otx_image_at(image, x0, y0);
    const float *p10 = otx_image_at(image, x1, y0);
    const float *p01 = otx_image_at(image, x0, y1);
    const float *p11 = otx_image_at(image, x1, y1);

    for (int c = 0; c < 3; ++c)
    {
        const double low = p00[c] + u * (p10[c] - p00[c]);
        const double high = p01[c] + u * (p11[c] - p01[c]);

        color[c] = low + v * (high - low);
        slope[c].x = (1.0 - v) * (p10[c] - p00[c]) + v * (p11[c] - p01[c]);
        slope[c].y = high - low;
    }
}

/* ---- along a line ---- */

/* The two texels around a position and the weight of the second, in floats:
 * most of the time of a seam cut is spent here. */
typedef struct line_tap
{
    size_t index[2];
    float weight;
} line_tap;

static line_tap
line_tap_at(double position, int32_t size, bool wrap)
{
    const double below = floor(position - 0.5);
    line_tap t = {.weight = (float)(position - 0.5 - below)};

    for (int k = 0; k < 2; ++k)
    {
        double i = below + k;

        if (wrap)
            i = otx_view_wrap(i, size);
        /* Written so that NaN reads the first texel. */
        i = i > 0.0 ? i : 0.0;
        t.index[k] = (size_t)(i < size - 1 ? i : size - 1);
    }
    return t;
}

/* Mixes the four texels around a place, three channels. */
static inline void
mix(const float *below[2], const float *above[2], float u, float v, float *out)
{
    for (int c = 0; c < 3; ++c)
    {
        const float b = below[0][c] + u * (below[1][c] - below[0][c]);
        const float a = above[0][c] + u * (above[1][c] - above[0][c]);

        out[c] = b + v * (a - b);
    }
}

static void
sample(otx_image_view view, otx_vec2 p, float *color)
{
    const otx_image *image = view.image;
    const line_tap x = line_tap_at(p.x, image->width, view.wrap_x);
    const line_tap y = line_tap_at(p.y, image->height, view.wrap_y);
    const size_t stride = 3 * (size_t)image->width;
    const float *row[2] = {
        image->pixels + y.index[0] * stride,
        image->pixels + y.index[1] * stride};
    const float *below[2] = {row[0] + 3 * x.index[0], row[0] + 3 * x.index[1]};
    const float *above[2] = {row[1] + 3 * x.index[0], row[1] + 3 * x.index[1]};

    mix(below, above, x.weight, y.weight, color);
}

/* The same half a texel inside the picture, where nothing wraps or is held. */
static inline void
sample_inside(const otx_image *image, otx_vec2 p, float *color)
{
    const double x = p.x - 0.5, y = p.y - 0.5;
    const int32_t i = (int32_t)x, j = (int32_t)y;
    const float *at = otx_image_at(image, i, j);
    const float *up = at + 3 * (size_t)image->width;
    const float *below[2] = {at, at + 3};
    const float *above[2] = {up, up + 3};

    mix(below, above, (float)(x - i), (float)(y - j), color);
}

/* Whether all four texels around a place are in the picture. */
static bool
inside(const otx_image *image, otx_vec2 p)
{
    return p.x >= 0.5 && p.y >= 0.5 && p.x < image->width - 0.5 &&
           p.y < image->height - 0.5;
}

void
otx_view_line(
    otx_image_view view, const otx_vec2 ends[2], double offset, int32_t count,
    float *colors)
{
    const otx_image *image = view.image;
    const otx_vec2 along = otx_vec2_sub(ends[1], ends[0]);
    const double length = otx_vec2_length(along);
    const double step = length > 0.0 ? offset / length : 0.0;
    otx_vec2 start =
        otx_vec2_add(ends[0], (otx_vec2){-step * along.y, step * along.x});

    if (view.wrap_x)
        start.x = otx_view_wrap(start.x, image->width);
    if (view.wrap_y)
        start.y = otx_view_wrap(start.y, image->height);

    const bool fast =
        inside(image, start) && inside(image, otx_vec2_add(start, along));

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 p =
            otx_vec2_add(start, otx_vec2_scale((i + 0.5) / count, along));
        float *color = colors + 3 * (size_t)i;

        if (fast)
            sample_inside(image, p, color);
        else
            sample(view, p, color);
    }
}
