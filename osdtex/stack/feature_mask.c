/* feature_mask.c -- what sticks out, and what hangs together. */
#include "stack/feature_mask.h"

#include "base/union_find.h"
#include "image/threshold.h"

#include <math.h>
#include <string.h>

enum
{
    TAPS_MAX = 31
};

/* Texels; so that grain does not count. */
#define SPOT_BLUR 1.5
#define JOINT_BLUR 1.0

/* Half the side of the square that joints are narrower than, for pictures of
 * 256 texels. */
#define HAT_RADIUS 6.0

/* ---- plain filters on a torus -------------------------------------------- */

typedef struct plane
{
    int32_t width, height;
    float *values; /* [height * width] */
    float *other;  /* likewise, for sweeps */
} plane;

static void
blur_axis(
    const plane *p, const float *from, float *to, bool along_x,
    const double *taps, int32_t radius)
{
    for (int32_t y = 0; y < p->height; ++y)
        for (int32_t x = 0; x < p->width; ++x)
        {
            double sum = 0.0;

            for (int32_t k = -radius; k <= radius; ++k)
            {
                const int32_t i = along_x ? otx_image_wrap(x + k, p->width) : x;
                const int32_t j =
                    along_x ? y : otx_image_wrap(y + k, p->height);

                sum += taps[k + radius] *
                       (double)from[(ptrdiff_t)j * p->width + i];
            }
            to[(ptrdiff_t)y * p->width + x] = (float)sum;
        }
}

static void
blur(plane *p, double sigma)
{
    double taps[2 * TAPS_MAX + 1], sum = 0.0;
    int32_t radius = (int32_t)ceil(3.0 * sigma);

    radius = radius > TAPS_MAX ? TAPS_MAX : radius;
    for (int32_t k = -radius; k <= radius; ++k)
        sum += taps[k + radius] = exp(-0.5 * k * k / (sigma * sigma));
    for (int32_t k = 0; k <= 2 * radius; ++k)
        taps[k] /= sum;
    blur_axis(p, p->values, p->other, true, taps, radius);
    blur_axis(p, p->other, p->values, false, taps, radius);
}

/* The largest of `sign` times the values within `radius` along an axis. */
static void
grow_axis(
    const plane *p, const float *from, float *to, bool along_x, float sign,
    int32_t radius)
{
    for (int32_t y = 0; y < p->height; ++y)
        for (int32_t x = 0; x < p->width; ++x)
        {
            float most = -(float)INFINITY;

            for (int32_t k = -radius; k <= radius; ++k)
            {
                const int32_t i = along_x ? otx_image_wrap(x + k, p->width) : x;
                const int32_t j =
                    along_x ? y : otx_image_wrap(y + k, p->height);

                most = fmaxf(most, sign * from[(ptrdiff_t)j * p->width + i]);
            }
            to[(ptrdiff_t)y * p->width + x] = sign * most;
        }
}

/* Closing: what is darker than its surroundings and narrow is filled up. */
static void
close_narrow(plane *p, int32_t radius)
{
    for (int pass = 0; pass < 2; ++pass)
    {
        const float sign = pass == 0 ? 1.0f : -1.0f;

        grow_axis(p, p->values, p->other, true, sign, radius);
        grow_axis(p, p->other, p->values, false, sign, radius);
    }
}

/* ---- finding ------------------------------------------------------------- */

static void
lightness(const otx_image *lab, plane *p)
{
    const int64_t texels = (int64_t)lab->width * lab->height;

    for (int64_t i = 0; i < texels; ++i)
        p->values[i] = lab->pixels[i * lab->channels];
}

static int32_t
hat_radius(const otx_image *lab)
{
    const int32_t side = lab->width < lab->height ? lab->width : lab->height;
    const double radius = HAT_RADIUS * side / 256.0;

    return radius > 2.0 ? (int32_t)lround(radius) : 2;
}

double
otx_feature_mask_share(const uint8_t *mask, int64_t texels)
{
    int64_t in = 0;

    for (int64_t i = 0; i < texels; ++i)
        in += mask[i] != 0;
    return (double)in / (double)texels;
}

/* Turns lightness into how far a texel is below, or above, what is around it on
 * a scale that narrow things stick out of: negative in them. */
static void
take_hat(plane *p, const float *light, int32_t radius, float sign)
{
    const int64_t texels = (int64_t)p->width * p->height;

    for (int64_t i = 0; i < texels; ++i)
        p->values[i] = sign * light[i];
    close_narrow(p, radius);
    for (int64_t i = 0; i < texels; ++i)
        p->values[i] = sign * light[i] - p->values[i];
}

/* Texels below the threshold that parts `values`. */
static void
mark_below(const float *values, int64_t texels, otx_feature_mask *out)
{
    const otx_threshold t = otx_threshold_find(values, texels);

    out->clarity = t.clarity;
    for (int64_t i = 0; i < texels; ++i)
        out->texels[i] = t.clarity > 0.0 && (double)values[i] < t.value;
    out->share = otx_feature_mask_share(out->texels, texels);
}

/* Dark joints or light ones, whichever are clearer. */
static otx_status
find_joints(otx_run *run, plane *p, int32_t radius, otx_feature_mask *out)
{
    const int64_t texels = (int64_t)p->width * p->height;
    float *light = OTX_NEW(run->scratch, float, texels);
    otx_feature_mask other = {.texels = OTX_NEW(run->scratch, uint8_t, texels)};

    OTX_TRY(otx_run_ok(run));
    memcpy(light, p->values, (size_t)texels * sizeof *light);
    take_hat(p, light, radius, 1.0f);
    mark_below(p->values, texels, out);
    take_hat(p, light, radius, -1.0f);
    mark_below(p->values, texels, &other);
    if (other.clarity <= out->clarity)
        return OSDTEX_OK;
    memcpy(out->texels, other.texels, (size_t)texels);
    out->share = other.share;
    out->clarity = other.clarity;
    return OSDTEX_OK;
}

otx_status
otx_feature_mask_find(
    otx_run *run, const otx_image *lab, otx_feature_kind feature,
    otx_feature_mask *out)
{
    const int64_t texels = (int64_t)lab->width * lab->height;
    const bool joints = feature == OTX_FEATURE_JOINTS;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    plane p = {
        lab->width, lab->height, OTX_NEW(run->scratch, float, texels),
        OTX_NEW(run->scratch, float, texels)};

    *out = (otx_feature_mask){.texels = OTX_NEW(run->arena, uint8_t, texels)};
    OTX_TRY(otx_run_ok(run));
    lightness(lab, &p);
    blur(&p, joints ? JOINT_BLUR : SPOT_BLUR);
    if (joints)
        OTX_TRY(find_joints(run, &p, hat_radius(lab), out));
    else
        mark_below(p.values, texels, out);
    otx_arena_release(run->scratch, mark);
    /* The minority is the feature. */
    for (int64_t i = 0; i < texels && out->share > 0.5; ++i)
        out->texels[i] = !out->texels[i];
    out->share = out->share > 0.5 ? 1.0 - out->share : out->share;
    return OSDTEX_OK;
}

/* ---- what hangs together --------------------------------------------------
 */

/* Sizes of the pieces of both kinds, at their first texels. */
static otx_status
find_pieces(
    otx_run *run, const uint8_t *mask, int32_t width, int32_t height,
    int32_t **parent, int32_t **size)
{
    const int32_t texels = width * height;
    int32_t *p = OTX_NEW(run->scratch, int32_t, texels);
    int32_t *s = OTX_ZNEW(run->scratch, int32_t, texels);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < texels; ++i)
        p[i] = i;
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
        {
            const int32_t i = y * width + x;
            const int32_t right = y * width + (x + 1) % width;
            const int32_t above = (y + 1) % height * width + x;

            if (!mask[i] == !mask[right])
                otx_union_find_join(p, i, right);
            if (!mask[i] == !mask[above])
                otx_union_find_join(p, i, above);
        }
    for (int32_t i = 0; i < texels; ++i)
        ++s[otx_union_find_root(p, i)];
    *parent = p;
    *size = s;
    return OSDTEX_OK;
}

otx_status
otx_feature_mask_clean(
    otx_run *run, uint8_t *mask, int32_t width, int32_t height, int32_t least)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *parent, *size;

    OTX_TRY(find_pieces(run, mask, width, height, &parent, &size));
    for (int32_t i = 0; i < width * height; ++i)
        if (size[otx_union_find_root(parent, i)] < least)
            mask[i] = !mask[i];
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_feature_mask_crumbs(
    otx_run *run, const uint8_t *mask, int32_t width, int32_t height,
    int32_t below, int32_t *count)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *parent, *size;

    OTX_TRY(find_pieces(run, mask, width, height, &parent, &size));
    *count = 0;
    for (int32_t i = 0; i < width * height; ++i)
        *count += parent[i] == i && size[i] < below;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}
