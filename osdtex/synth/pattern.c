/* pattern.c -- an exemplar as windows are looked up in it. */
#include "synth/pattern.h"

#include "analysis/edges.h"
#include "image/pyramid.h"
#include "image/view.h"

static double
spread_of(const otx_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    double sum = 0.0, sum_sq = 0.0;

    for (size_t i = 0; i < count; ++i)
    {
        const double v = image->pixels[i * (size_t)image->channels];

        sum += v;
        sum_sq += v * v;
    }
    sum /= (double)count;
    sum_sq = sum_sq / (double)count - sum * sum;
    return sum_sq > 0.0 ? sqrt(sum_sq) : 0.0;
}

/* Lab, edges, guide. */
static otx_status
gather(otx_run *run, const otx_pattern_input *in, int32_t quads, otx_image *out)
{
    const otx_image *lab = in->lab;
    const size_t count = (size_t)lab->width * (size_t)lab->height;
    otx_edges edges;

    OTX_TRY(
        otx_edges_find(run, run->scratch, lab, in->wrap_x, in->wrap_y, &edges));
    OTX_TRY(otx_image_create(
        run, run->scratch, lab->width, lab->height, 4 * quads, out));

    const double of_edges = spread_of(&edges.strength);
    const double factor =
        of_edges > 0.0 ? in->edge * spread_of(lab) / of_edges : 0.0;

    for (size_t i = 0; i < count; ++i)
    {
        float *to = out->pixels + i * (size_t)(4 * quads);

        for (int c = 0; c < 3; ++c)
            to[c] = lab->pixels[3 * i + (size_t)c];
        to[3] = (float)(factor * edges.strength.pixels[i]);
        for (int c = 0; quads > 1 && c < 4; ++c)
            to[4 + c] =
                c < in->guide->channels
                    ? in->guide
                          ->pixels[i * (size_t)in->guide->channels + (size_t)c]
                    : 0.0f;
    }
    return OSDTEX_OK;
}

/* A level with its rim. */
static otx_status
pad(otx_run *run, otx_arena *arena, const otx_pattern *p,
    const otx_image *image, otx_pattern_level *out)
{
    const int32_t rim = OTX_PATTERN_RIM, rows = image->height + 2 * rim;

    *out = (otx_pattern_level){
        .width = image->width,
        .height = image->height,
        .stride = image->width + 2 * rim,
        .per_x = (float)image->width / (float)p->width,
        .per_y = (float)image->height / (float)p->height};

    otx_quad *values =
        OTX_NEW(arena, otx_quad, (int64_t)rows * out->stride * p->quads);

    if (!values)
        return otx_fail_memory(run, "synth");
    out->values = values;
    for (int32_t j = 0; j < rows; ++j)
    {
        const int32_t y = otx_view_fold(j - rim, image->height, p->wrap_y);

        for (int32_t i = 0; i < out->stride; ++i)
        {
            const float *from = otx_image_at(
                image, otx_view_fold(i - rim, image->width, p->wrap_x), y);

            for (int32_t q = 0; q < p->quads; ++q, from += 4)
                *values++ = (otx_quad){from[0], from[1], from[2], from[3]};
        }
    }
    return OSDTEX_OK;
}

static int32_t
levels_of(const otx_pattern_input *in)
{
    const int32_t side =
        in->lab->width < in->lab->height ? in->lab->width : in->lab->height;
    int32_t count = 1;

    while (count < in->levels && count < OTX_PATTERN_LEVELS &&
           side >> count >= OTX_PATTERN_MIN_SIDE)
        ++count;
    return count;
}

otx_status
otx_pattern_build(
    otx_run *run, otx_arena *arena, const otx_pattern_input *in,
    otx_pattern *out)
{
    otx_image image, smaller;

    if (in->guide && (in->guide->width != in->lab->width ||
                      in->guide->height != in->lab->height))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "synth", OTX_NOWHERE,
            "the guide has %d x %d texels, its picture %d x %d",
            in->guide->width, in->guide->height, in->lab->width,
            in->lab->height);
    *out = (otx_pattern){
        .width = in->lab->width,
        .height = in->lab->height,
        .wrap_x = in->wrap_x,
        .wrap_y = in->wrap_y,
        .quads = in->guide ? 2 : 1,
        .level_count = levels_of(in)};
    OTX_TRY(gather(run, in, out->quads, &image));
    for (int32_t l = 0; l < out->level_count; ++l)
    {
        OTX_TRY(pad(run, arena, out, &image, &out->levels[l]));
        if (l + 1 == out->level_count)
            break;
        OTX_TRY(otx_pyramid_reduce(run, run->scratch, &image, &smaller));
        image = smaller;
    }
    return OSDTEX_OK;
}
