/* texture.c -- mip levels and anisotropic lookups. */
#include "render/texture.h"

enum
{
    MAX_PROBES = 16
};

otx_status
otx_texture_create(
    otx_run *run, otx_arena *arena, const otx_scene_texture *source,
    otx_texture *out)
{
    out->wrap_x = source->wrap_x;
    out->wrap_y = source->wrap_y;
    return otx_pyramid_build(run, arena, &source->image, &out->pyramid);
}

/* A coordinate brought near [0, 1], so that texel positions fit any integer
 * and keep their precision. Where the border is held, all beyond one picture
 * outside is border. */
static double
reduce(double x, bool wrap)
{
    return wrap ? x - floor(x) : fmin(fmax(x, -1.0), 2.0);
}

static void
add_level(
    const otx_texture *texture, int32_t level, otx_vec2 uv, double weight,
    double sum[3])
{
    const otx_image *image = &texture->pyramid.levels[level];
    float color[OTX_IMAGE_MAX_CHANNELS];

    otx_image_sample(
        image, texture->wrap_x, texture->wrap_y,
        (otx_vec2){uv.x * image->width, uv.y * image->height}, color);
    for (int32_t c = 0; c < 3; ++c)
        sum[c] += weight * color[image->channels >= 3 ? c : 0];
}

/* Linear between the two levels around `lod`. */
static void
add_trilinear(
    const otx_texture *texture, double lod, otx_vec2 uv, double weight,
    double sum[3])
{
    const int32_t last = texture->pyramid.count - 1;
    const double held = fmin(fmax(lod, 0.0), last);
    const int32_t level = (int32_t)held;
    const double t = held - level;
    const otx_vec2 near = {
        reduce(uv.x, texture->wrap_x), reduce(uv.y, texture->wrap_y)};

    add_level(texture, level, near, weight * (1.0 - t), sum);
    if (t > 0.0)
        add_level(texture, level + 1, near, weight * t, sum);
}

/* Axes of the ellipse that is the image of the unit circle under the matrix
 * with columns a and b: `major` as a vector, the length of the other
 * returned. By the eigenvectors of its 2 x 2 Gram matrix. */
static double
ellipse_axes(otx_vec2 a, otx_vec2 b, otx_vec2 *major)
{
    const double xx = a.x * a.x + b.x * b.x;
    const double xy = a.x * a.y + b.x * b.y;
    const double yy = a.y * a.y + b.y * b.y;
    const double mean = 0.5 * (xx + yy);
    const double spread = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    const double angle = 0.5 * atan2(2.0 * xy, xx - yy);
    const double length = sqrt(mean + spread);

    *major = otx_vec2_scale(length, otx_vec2_polar(angle));
    return length > 0.0 ? fabs(otx_vec2_cross(a, b)) / length : 0.0;
}

void
otx_texture_filter(
    const otx_texture *texture, otx_vec2 uv, otx_vec2 uv_dx, otx_vec2 uv_dy,
    float rgb[3])
{
    const otx_image *image = &texture->pyramid.levels[0];
    const otx_vec2 a = {uv_dx.x * image->width, uv_dx.y * image->height};
    const otx_vec2 b = {uv_dy.x * image->width, uv_dy.y * image->height};
    double sum[3] = {0.0, 0.0, 0.0};
    otx_vec2 major;
    const double minor = ellipse_axes(a, b, &major);
    const double length = otx_vec2_length(major);

    /* Probes are as wide as the short axis, and never narrower than a texel
     * or than what leaves MAX_PROBES of them. Written so that a length that is
     * not finite takes one probe of the last level. */
    const double width = fmax(fmax(minor, 1.0), length / MAX_PROBES);
    const double ratio = length < INFINITY ? length / width : 1.0;
    const int32_t probes = ratio > 1.0 ? (int32_t)ceil(ratio) : 1;
    const double lod = width < INFINITY ? log2(width) : OTX_PYRAMID_MAX_LEVELS;
    const otx_vec2 step = {
        probes > 1 ? major.x / image->width / probes : 0.0,
        probes > 1 ? major.y / image->height / probes : 0.0};

    for (int32_t i = 0; i < probes; ++i)
    {
        const otx_vec2 at =
            otx_vec2_add(uv, otx_vec2_scale(i - 0.5 * (probes - 1), step));

        add_trilinear(texture, lod, at, 1.0 / probes, sum);
    }
    for (int32_t c = 0; c < 3; ++c)
        rgb[c] = (float)sum[c];
}
