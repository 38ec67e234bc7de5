/* companions.c -- maps of a set interleaved, cut and moved like the picture. */
#include "exemplar/companions.h"

#include "image/view.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "material";

/* A normal map of which the vectors point up less than this in the mean is
 * taken to be something else: steep ones have some .8. */
static const double UP_MIN = 0.2;

const char *
otx_companion_name(otx_companion_kind kind)
{
    static const char *const names[OTX_COMPANION_COUNT] = {
        "normal", "roughness", "height", "metalness", "occlusion"};

    return names[kind];
}

void
otx_companion_neutral(otx_companion_kind kind, float *values)
{
    static const float neutral[OTX_COMPANION_COUNT] = {
        0.0f, 0.5f, 0.5f, 0.0f, 1.0f};

    values[0] = neutral[kind];
    if (kind == OTX_COMPANION_NORMAL)
    {
        values[1] = 0.0f;
        values[2] = 1.0f;
    }
}

/* ---- one file -------------------------------------------------------------
 */

/* Floats that are negative somewhere are vectors as they stand. */
static bool
is_signed(const otx_companion_input *in)
{
    const size_t count = (size_t)in->pixels.width * (size_t)in->pixels.height;
    const int32_t channels = in->pixels.channels;

    if (!in->is_float)
        return false;
    for (size_t i = 0; i < count; ++i)
        for (int32_t c = 0; c < 2; ++c)
            if (in->pixels.pixels[i * (size_t)channels + (size_t)c] < -0.01f)
                return true;
    return false;
}

/* A component of a normal. No integer is exactly half of its maximum; the two
 * beside it mean 0. */
static float
component_of(const otx_companion_input *in, float value)
{
    const float centred = 2.0f * value - 1.0f;
    const float step =
        in->is_float ? 0.0f : 1.0f / (float)(ldexp(1.0, in->bits) - 1.0);

    return fabsf(centred) <= 1.001f * step ? 0.0f : centred;
}

static void
decode_normal(
    const otx_companion_input *in, bool as_it_is, const float *p, float *out)
{
    float n[3], sq = 0.0f;

    for (int k = 0; k < 3; ++k)
    {
        n[k] = as_it_is ? p[k] : component_of(in, p[k]);
        sq += n[k] * n[k];
    }
    if (in->y_down)
        n[1] = -n[1];
    if (!(sq > 0.0f))
    {
        otx_companion_neutral(OTX_COMPANION_NORMAL, n);
        sq = 1.0f;
    }
    for (int k = 0; k < 3; ++k)
        out[k] = n[k] / sqrtf(sq);
}

/* The map by itself, as numbers that are looked up. */
static otx_status
decode(otx_run *run, const otx_companion_input *in, otx_image *out)
{
    const otx_image *p = &in->pixels;
    const size_t count = (size_t)p->width * (size_t)p->height;
    const bool as_it_is = is_signed(in);
    double up = 0.0;

    OTX_TRY(otx_image_create(
        run, run->scratch, p->width, p->height,
        otx_companion_channels(in->kind), out));
    for (size_t i = 0; i < count; ++i)
    {
        const float *texel = p->pixels + i * (size_t)p->channels;

        if (in->kind == OTX_COMPANION_NORMAL)
        {
            decode_normal(in, as_it_is, texel, out->pixels + 3 * i);
            up += (double)out->pixels[3 * i + 2];
            continue;
        }
        out->pixels[i] =
            in->is_inverted ? 1.0f - texel[in->channel] : texel[in->channel];
    }
    if (in->kind == OTX_COMPANION_NORMAL &&
        (in->is_gray || up < UP_MIN * (double)count))
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(in->path),
            "the picture is given as a normal map, and %s; is it a height?",
            in->is_gray ? "all its channels are alike"
                        : "its vectors do not point up (blue)");
    return OSDTEX_OK;
}

/* ---- sizes --------------------------------------------------------------- */

/* How many of one are in the other along an axis; 0 no whole number. */
static int32_t
factor_of(int32_t large, int32_t small)
{
    return small > 0 && large % small == 0 ? large / small : 0;
}

static otx_status
check_size(
    otx_run *run, const otx_companion_input *in, int32_t width, int32_t height)
{
    const otx_image *p = &in->pixels;
    const bool up = factor_of(p->width, width) > 0 &&
                    factor_of(p->width, width) == factor_of(p->height, height);
    const bool down =
        factor_of(width, p->width) > 0 &&
        factor_of(width, p->width) == factor_of(height, p->height);

    if (up || down)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(in->path),
        "the %s map has %d x %d texels and the colour %d x %d: no whole number "
        "of times as many; scale it",
        otx_companion_name(in->kind), p->width, p->height, width, height);
}

typedef struct spreading
{
    const otx_image *from;
    const otx_image *to;
    int32_t first; /* channel there */
    bool wrap_x, wrap_y;
} spreading;

/* A row of the map into its channels. */
static otx_status
spread_row(void *context, int64_t y, otx_worker *worker)
{
    const spreading *s = context;
    const double x_step = (double)s->from->width / s->to->width;
    const double at_y = ((double)y + 0.5) * s->from->height / s->to->height;
    const otx_image_view view = otx_view_of(s->from, s->wrap_x, s->wrap_y);
    const size_t bytes = (size_t)s->from->channels * sizeof(float);
    float values[OTX_IMAGE_MAX_CHANNELS];

    (void)worker;
    for (int32_t x = 0; x < s->to->width; ++x)
    {
        float *out = otx_image_at(s->to, x, (int32_t)y) + s->first;

        if (s->from->width == s->to->width)
        {
            memcpy(out, otx_image_at(s->from, x, (int32_t)y), bytes);
            continue;
        }
        otx_view_value(view, (otx_vec2){(x + 0.5) * x_step, at_y}, values);
        memcpy(out, values, bytes);
    }
    return OSDTEX_OK;
}

/* ---- the set -------------------------------------------------------------
 */

static bool
keep(otx_run *run, const char *text, const char **out)
{
    *out = text ? otx_arena_strdup(run->arena, text) : NULL;
    return !text || *out;
}

static otx_status
record(otx_run *run, const otx_companion_input *in, otx_companion *out)
{
    *out = (otx_companion){
        .is_there = true,
        .channel = in->channel,
        .y_down = in->y_down,
        .is_inverted = in->is_inverted,
        .width = in->pixels.width,
        .height = in->pixels.height};
    return keep(run, in->path, &out->path) &&
                   keep(run, in->layer, &out->layer) &&
                   keep(run, in->hash, &out->hash) &&
                   keep(run, in->type, &out->type)
               ? OSDTEX_OK
               : otx_fail_memory(run, STAGE);
}

/* Checks all, and settles size and channels. */
static otx_status
plan(
    otx_run *run, const otx_companion_input *inputs, int32_t count,
    int32_t width, int32_t height, otx_companions *out)
{
    int32_t factor = 1;

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_companion_input *in = &inputs[i];
        otx_companion *map = &out->maps[in->kind];

        if (map->is_there)
            return otx_fail(
                run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(in->path),
                "two files are given as the %s map",
                otx_companion_name(in->kind));
        OTX_TRY(check_size(run, in, width, height));
        OTX_TRY(record(run, in, map));
        if (in->pixels.width / width > factor)
            factor = in->pixels.width / width;
    }
    out->image =
        (otx_image){.width = width * factor, .height = height * factor};
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
        if (out->maps[k].is_there)
        {
            out->maps[k].first = out->image.channels;
            out->image.channels +=
                otx_companion_channels((otx_companion_kind)k);
        }
    return OSDTEX_OK;
}

otx_status
otx_companions_build(
    otx_run *run, const otx_companion_input *inputs, int32_t count,
    int32_t width, int32_t height, bool wrap_x, bool wrap_y,
    otx_companions *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_companions made = {.height_middle = 0.5};

    *out = made;
    if (count == 0)
        return OSDTEX_OK;
    OTX_TRY(plan(run, inputs, count, width, height, &made));
    OTX_TRY(otx_image_create(
        run, run->arena, made.image.width, made.image.height,
        made.image.channels, &made.image));
    for (int32_t i = 0; i < count; ++i)
    {
        otx_image map;
        spreading s = {
            &map, &made.image, made.maps[inputs[i].kind].first, wrap_x, wrap_y};

        OTX_TRY(decode(run, &inputs[i], &map));
        OTX_TRY(otx_pool_for(run->pool, made.image.height, spread_row, &s));
        otx_arena_release(run->scratch, mark);
    }
    *out = made;
    return OSDTEX_OK;
}

/* ---- cuts ---------------------------------------------------------------- */

otx_status
otx_companions_crop(
    otx_run *run, const otx_companions *from, int32_t width,
    const int32_t rectangle[4], otx_companions *out)
{
    const otx_image image = from->image;
    int32_t n;

    *out = *from;
    if (!image.pixels)
        return OSDTEX_OK;
    n = image.width / width;
    OTX_TRY(otx_image_create(
        run, run->arena, n * rectangle[2], n * rectangle[3], image.channels,
        &out->image));
    for (int32_t y = 0; y < out->image.height; ++y)
        memcpy(
            otx_image_at(&out->image, 0, y),
            otx_image_at(&image, n * rectangle[0], n * rectangle[1] + y),
            (size_t)out->image.width * (size_t)image.channels *
                sizeof *image.pixels);
    return OSDTEX_OK;
}

otx_status
otx_companions_rearrange(
    otx_run *run, const otx_companions *from, int32_t width, int32_t height,
    const int32_t *texels, otx_companions *out)
{
    const otx_image image = from->image;
    int32_t n;

    *out = *from;
    if (!image.pixels)
        return OSDTEX_OK;
    n = image.width / width;
    OTX_TRY(otx_image_create(
        run, run->arena, image.width, image.height, image.channels,
        &out->image));
    for (int32_t y = 0; y < n * height; ++y)
        for (int32_t x = 0; x < width; ++x)
        {
            const int32_t texel = texels[(ptrdiff_t)(y / n) * width + x];

            memcpy(
                otx_image_at(&out->image, n * x, y),
                otx_image_at(
                    &image, n * (texel % width), n * (texel / width) + y % n),
                (size_t)n * (size_t)image.channels * sizeof *image.pixels);
        }
    return OSDTEX_OK;
}
