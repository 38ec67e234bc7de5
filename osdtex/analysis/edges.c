/* edges.c -- gradients by Sobel, row by row over the pool; sums in the order
 * of rows, so that they do not depend on the number of threads. */
#include "analysis/edges.h"

#include "image/view.h"

#include <math.h>
#include <string.h>

typedef struct row_sum
{
    double strength, square;
} row_sum;

typedef struct finding
{
    const otx_image *image;
    bool wrap_x, wrap_y;
    otx_image *strength;
    row_sum *sums; /* [height] */
} finding;

/* Eight times the derivative along one axis, and along the other with the
 * rows for columns. */
static double
sobel(const float *low[3], const float *high[3], int32_t channel)
{
    return ((double)high[0][channel] - low[0][channel]) +
           2.0 * ((double)high[1][channel] - low[1][channel]) +
           ((double)high[2][channel] - low[2][channel]);
}

static double
strength_at(const finding *f, int32_t x, int32_t y)
{
    const otx_image *image = f->image;
    const int32_t xs[3] = {
        otx_view_fold(x + (-1), image->width, f->wrap_x), x,
        otx_view_fold(x + (1), image->width, f->wrap_x)};
    const int32_t ys[3] = {
        otx_view_fold(y + (-1), image->height, f->wrap_y), y,
        otx_view_fold(y + (1), image->height, f->wrap_y)};
    const float *left[3], *right[3], *below[3], *above[3];
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        left[k] = otx_image_at(image, xs[0], ys[k]);
        right[k] = otx_image_at(image, xs[2], ys[k]);
        below[k] = otx_image_at(image, xs[k], ys[0]);
        above[k] = otx_image_at(image, xs[k], ys[2]);
    }
    for (int32_t c = 0; c < image->channels; ++c)
    {
        const double dx = sobel(left, right, c), dy = sobel(below, above, c);

        sum += dx * dx + dy * dy;
    }
    return sqrt(sum) / 8.0;
}

static otx_status
find_row(void *context, int64_t y, otx_worker *worker)
{
    const finding *f = context;
    row_sum *sum = &f->sums[y];

    (void)worker;
    for (int32_t x = 0; x < f->image->width; ++x)
    {
        const double strength = strength_at(f, x, (int32_t)y);

        *otx_image_at(f->strength, x, (int32_t)y) = (float)strength;
        sum->strength += strength;
        sum->square += strength * strength;
    }
    return OSDTEX_OK;
}

otx_status
otx_edges_find(
    otx_run *run, otx_arena *arena, const otx_image *image, bool wrap_x,
    bool wrap_y, otx_edges *out)
{
    const double texels = (double)image->width * image->height;
    finding f = {image, wrap_x, wrap_y, &out->strength, NULL};
    double mean = 0.0, square = 0.0;

    OTX_TRY(otx_image_create(
        run, arena, image->width, image->height, 1, &out->strength));
    f.sums = OTX_ZNEW(arena, row_sum, image->height);
    if (!f.sums)
        return otx_fail_memory(run, "colour");
    OTX_TRY(otx_pool_for(run->pool, image->height, find_row, &f));
    for (int32_t y = 0; y < image->height; ++y)
    {
        mean += f.sums[y].strength / texels;
        square += f.sums[y].square / texels;
    }
    out->sigma = sqrt(2.0 * fmax(square - mean * mean, 0.0));
    return OSDTEX_OK;
}

otx_status
otx_edges_append(
    otx_run *run, otx_arena *arena, const otx_image *image,
    const otx_edges *edges, double factor, otx_image *out)
{
    const size_t channels = (size_t)image->channels;
    const size_t texels = (size_t)image->width * (size_t)image->height;

    OTX_TRY(otx_image_create(
        run, arena, image->width, image->height, image->channels + 1, out));
    for (size_t i = 0; i < texels; ++i)
    {
        float *to = out->pixels + i * (channels + 1);

        memcpy(to, image->pixels + i * channels, channels * sizeof *to);
        to[channels] = (float)(factor * (double)edges->strength.pixels[i]);
    }
    return OSDTEX_OK;
}
