/* square.c -- the middle of a picture, as it is analysed. */
#include "analysis/square.h"

#include <string.h>

enum
{
    SIDE_MAX = 512,
    STRIP = 32 /* values of a row that are blurred together */
};

/* -- blur ---------------------------------------------------------------- */

/* One pass of a Gaussian over n x n values. */
typedef struct blur
{
    int32_t n;
    const float *kernel; /* of [-radius, radius] */
    int32_t radius;
    const float *from;
    float *to;
} blur;

/* A strip of one row of the mean over rows: neighbours are summed at the same
 * time, each in the order of the rows, so that the processor's lanes are full
 * whatever the order of a sum may not be. */
static void
blur_strip(const blur *b, int32_t row, int32_t first, int32_t width)
{
    const int32_t low = row < b->radius ? -row : -b->radius;
    const int32_t last = b->n - 1 - row;
    const int32_t high = last < b->radius ? last : b->radius;
    float sum[STRIP] = {0.0f}, weight = 0.0f;

    for (int32_t i = low; i <= high; ++i)
    {
        const float *from =
            b->from + (size_t)(row + i) * (size_t)b->n + (size_t)first;
        const float k = b->kernel[i];

        weight += k;
        if (width == STRIP)
            for (int32_t x = 0; x < STRIP; ++x)
                sum[x] += k * from[x];
        else
            for (int32_t x = 0; x < width; ++x)
                sum[x] += k * from[x];
    }
    for (int32_t x = 0; x < width; ++x)
        b->to[(size_t)row * (size_t)b->n + (size_t)(first + x)] =
            sum[x] / weight;
}

/* Normalised by what of the kernel lies inside. */
static otx_status
blur_row(void *context, int64_t row, otx_worker *worker)
{
    const blur *b = context;

    (void)worker;
    for (int32_t x = 0; x < b->n; x += STRIP)
        blur_strip(b, (int32_t)row, x, b->n - x < STRIP ? b->n - x : STRIP);
    return OSDTEX_OK;
}

static void
transpose(float *f, int32_t n)
{
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < y; ++x)
        {
            const float above = f[(size_t)x * (size_t)n + (size_t)y];

            f[(size_t)x * (size_t)n + (size_t)y] =
                f[(size_t)y * (size_t)n + (size_t)x];
            f[(size_t)y * (size_t)n + (size_t)x] = above;
        }
}

otx_status
otx_square_blur(
    otx_run *run, const float *from, float *to, int32_t n, double sigma)
{
    const int32_t r = (int32_t)ceil(2.5 * sigma);
    float *kernel = OTX_NEW(run->scratch, float, 2 * r + 1);
    float *temp = OTX_NEW(run->scratch, float, (int64_t)n *n);
    blur b = {n, NULL, r, to, temp};

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = -r; i <= r; ++i)
        kernel[r + i] = (float)exp(-0.5 * i * i / (sigma * sigma));
    b.kernel = kernel + r;
    /* Along x, which is across the rows of what is transposed, then along y. */
    memcpy(to, from, (size_t)n * (size_t)n * sizeof *to);
    transpose(to, n);
    OTX_TRY(otx_pool_for(run->pool, n, blur_row, &b));
    transpose(temp, n);
    b.from = temp;
    b.to = to;
    return otx_pool_for(run->pool, n, blur_row, &b);
}

/* -- square -------------------------------------------------------------- */

/* Mean luminance of a texel of the square. */
static float
box_mean(const otx_square *s, const otx_image *lab, int32_t x, int32_t y)
{
    float sum = 0.0f;

    for (int32_t j = 0; j < s->texel; ++j)
        for (int32_t i = 0; i < s->texel; ++i)
            sum += *otx_image_at(
                lab, s->x0 + x * s->texel + i, s->y0 + y * s->texel + j);
    return sum / (float)(s->texel * s->texel);
}

otx_status
otx_square_cut(otx_run *run, const otx_image *lab, otx_square *out)
{
    const int32_t shorter = lab->width < lab->height ? lab->width : lab->height;
    const int32_t texel = (shorter + SIDE_MAX - 1) / SIDE_MAX;
    const int32_t n = shorter / texel;
    const size_t texels = (size_t)n * (size_t)n;
    float *slow = OTX_NEW(run->scratch, float, texels);
    double sum = 0.0;

    *out = (otx_square){
        run,
        n,
        (lab->width - n * texel) / 2,
        (lab->height - n * texel) / 2,
        texel,
        OTX_NEW(run->scratch, float, texels)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
            out->f[y * n + x] = box_mean(out, lab, x, y);
    OTX_TRY(otx_square_blur(run, out->f, slow, n, n / 6.0));
    for (size_t i = 0; i < texels; ++i)
        slow[i] = out->f[i] - slow[i];
    OTX_TRY(otx_square_blur(run, slow, out->f, n, fmax(0.7, n / 400.0)));
    for (size_t i = 0; i < texels; ++i)
        sum += out->f[i];
    for (size_t i = 0; i < texels; ++i)
        out->f[i] -= (float)(sum / (double)texels);
    return OSDTEX_OK;
}
