/* square.c -- the middle of a picture, as it is analysed. */
#include "image/square.h"

enum
{
    SIDE_MAX = 512
};

/* One pass of a Gaussian along x from `from` to the transposed of `to`;
 * normalised by what of the kernel lies inside. */
static void
blur_rows(const float *from, float *to, int32_t n, const float *k, int32_t r)
{
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
        {
            const int32_t low = x < r ? -x : -r;
            const int32_t high = x + r >= n ? n - 1 - x : r;
            float sum = 0.0f, weight = 0.0f;

            for (int32_t i = low; i <= high; ++i)
            {
                sum += k[i] * from[(size_t)y * (size_t)n + (size_t)(x + i)];
                weight += k[i];
            }
            to[(size_t)x * (size_t)n + (size_t)y] = sum / weight;
        }
}

otx_status
otx_square_blur(
    otx_run *run, const float *from, float *to, int32_t n, double sigma)
{
    const int32_t r = (int32_t)ceil(2.5 * sigma);
    float *kernel = OTX_NEW(run->scratch, float, 2 * r + 1);
    float *temp = OTX_NEW(run->scratch, float, (int64_t)n *n);

    if (!kernel || !temp)
        return otx_fail_memory(run, "exemplar");
    for (int32_t i = -r; i <= r; ++i)
        kernel[r + i] = (float)exp(-0.5 * i * i / (sigma * sigma));
    blur_rows(from, temp, n, kernel + r, r);
    blur_rows(temp, to, n, kernel + r, r);
    return OSDTEX_OK;
}

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
    if (!slow || !out->f)
        return otx_fail_memory(run, "exemplar");
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
