/* texture.c -- mip levels and anisotropic lookups. */
#include "image/texture.h"

#include "image/view.h"

#include <string.h>

enum
{
    MAX_PROBES = 16
};

otx_status
otx_texture_create(
    otx_run *run, otx_arena *arena, const otx_image *image, bool wrap_x,
    bool wrap_y, otx_texture *out)
{
    *out = (otx_texture){.wrap_x = wrap_x, .wrap_y = wrap_y};
    return otx_pyramid_build(run, arena, image, &out->pyramid);
}

otx_status
otx_texture_add_slices(
    otx_run *run, otx_arena *arena, const otx_image *images, int32_t count,
    otx_texture *texture)
{
    otx_texture *slices = OTX_ZNEW(arena, otx_texture, count);

    if (!slices)
        return otx_fail_memory(run, "texture");
    for (int32_t k = 0; k < count; ++k)
        OTX_TRY(otx_texture_create(
            run, arena, &images[k], texture->wrap_x, texture->wrap_y,
            &slices[k]));
    texture->slices = slices;
    texture->slice_count = count;
    return OSDTEX_OK;
}

/* A coordinate brought near [0, 1], so that texel positions fit any integer
 * and keep their precision. Where the border is held, all beyond one picture
 * outside is border. */
static double
reduce(double x, bool wrap)
{
    /* Most are in the picture, and floor() is a call. */
    if (x >= 0.0 && x < 1.0)
        return x;
    if (wrap)
        return x - floor(x);
    /* Written so that NaN is held too. */
    return x > -1.0 ? x < 2.0 ? x : 2.0 : -1.0;
}

static void
look_up(const otx_texture *texture, int32_t level, otx_vec2 uv, float *color)
{
    const otx_image *image = &texture->pyramid.levels[level];

    otx_view_value(
        otx_view_of(image, texture->wrap_x, texture->wrap_y),
        (otx_vec2){uv.x * image->width, uv.y * image->height}, color);
}

/* Linear between the two levels around the probes' width. */
static void
look_up_between(
    const otx_texture *texture, const otx_texture_probes *probes, otx_vec2 uv,
    float *color)
{
    const otx_vec2 near = {
        reduce(uv.x, texture->wrap_x), reduce(uv.y, texture->wrap_y)};
    float coarse[OTX_IMAGE_MAX_CHANNELS];
    const double t = probes->fraction;

    look_up(texture, probes->level, near, color);
    if (!(t > 0.0))
        return;
    look_up(texture, probes->level + 1, near, coarse);
    for (int32_t c = 0; c < texture->pyramid.levels[0].channels; ++c)
        color[c] = (float)((1.0 - t) * color[c] + t * coarse[c]);
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

otx_texture_probes
otx_texture_measure(const otx_texture *texture, otx_vec2 uv_dx, otx_vec2 uv_dy)
{
    const otx_image *image = &texture->pyramid.levels[0];
    const otx_vec2 a = {uv_dx.x * image->width, uv_dx.y * image->height};
    const otx_vec2 b = {uv_dy.x * image->width, uv_dy.y * image->height};
    const int32_t last = texture->pyramid.count - 1;
    otx_vec2 major;

    /* No axis is longer than this sum: a close view, without the axes. */
    if (otx_vec2_dot(a, a) + otx_vec2_dot(b, b) <= 1.0)
        return (otx_texture_probes){.count = 1};

    const double minor = ellipse_axes(a, b, &major);
    const double length = otx_vec2_length(major);

    /* Probes are as wide as the short axis, and never narrower than a texel
     * or than what leaves MAX_PROBES of them. Written so that a length that is
     * not finite takes one probe of the last level. */
    const double width = fmax(fmax(minor, 1.0), length / MAX_PROBES);
    const double ratio = length < INFINITY ? length / width : 1.0;
    const int32_t count = ratio > 1.0 ? (int32_t)ceil(ratio) : 1;
    const double lod = width < INFINITY ? fmin(log2(width), last) : last;
    const otx_vec2 step = {
        count > 1 ? major.x / image->width / count : 0.0,
        count > 1 ? major.y / image->height / count : 0.0};

    return (otx_texture_probes){
        .count = count,
        .level = (int32_t)lod,
        .fraction = lod - (int32_t)lod,
        .first = otx_vec2_scale(-0.5 * (count - 1), step),
        .step = step,
    };
}

void
otx_texture_probe(
    const otx_texture *texture, const otx_texture_probes *probes, otx_vec2 uv,
    float *color)
{
    const int32_t channels = texture->pyramid.levels[0].channels;
    otx_vec2 at = otx_vec2_add(uv, probes->first);
    double sum[OTX_IMAGE_MAX_CHANNELS] = {0.0};

    if (probes->count == 1)
    {
        look_up_between(texture, probes, at, color);
        return;
    }
    for (int32_t i = 0; i < probes->count; ++i)
    {
        look_up_between(texture, probes, at, color);
        for (int32_t c = 0; c < channels; ++c)
            sum[c] += color[c];
        at = otx_vec2_add(at, probes->step);
    }
    for (int32_t c = 0; c < channels; ++c)
        color[c] = (float)(sum[c] / probes->count);
}

void
otx_texture_filter(
    const otx_texture *texture, otx_vec2 uv, otx_vec2 uv_dx, otx_vec2 uv_dy,
    float rgb[3])
{
    const otx_texture_probes probes =
        otx_texture_measure(texture, uv_dx, uv_dy);
    float color[OTX_IMAGE_MAX_CHANNELS];

    otx_texture_probe(texture, &probes, uv, color);
    if (texture->pyramid.levels[0].channels < 3)
        color[1] = color[2] = color[0];
    memcpy(rgb, color, 3 * sizeof *rgb);
}
