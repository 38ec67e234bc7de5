/* statistics.c -- sums over rows, added in the order of rows. */
#include "exemplar/statistics.h"

#include <math.h>

typedef struct row_sums
{
    double sum[3], sum_sq, step_sq;
} row_sums;

typedef struct survey
{
    const otx_image *image;
    row_sums *rows;
} survey;

/* Deviations from the first texel: a constant picture sums to exact zeros. */
static otx_status
survey_row(void *context, int64_t y, otx_worker *worker)
{
    const survey *s = context;
    const otx_image *image = s->image;
    row_sums r = {0};
    (void)worker;

    for (int32_t x = 0; x < image->width; ++x)
    {
        const float *texel = otx_image_at(image, x, (int32_t)y);

        for (int k = 0; k < 3; ++k)
        {
            const double d = (double)texel[k] - (double)image->pixels[k];
            const double right = x + 1 < image->width
                                     ? (double)texel[k + 3] - (double)texel[k]
                                     : 0.0;
            const double above =
                y + 1 < image->height
                    ? (double)texel[k + 3 * (size_t)image->width] -
                          (double)texel[k]
                    : 0.0;

            r.sum[k] += d;
            r.sum_sq += d * d;
            r.step_sq += right * right + above * above;
        }
    }
    s->rows[y] = r;
    return OSDTEX_OK;
}

/* sigma = sqrt(2 Var): the RMS distance of two texels drawn at random. */
static otx_status
measure(
    otx_run *run, row_sums *rows, const otx_image *image, double *sigma,
    double *step)
{
    survey s = {image, rows};
    row_sums all = {0};
    const double width = image->width;
    const double height = image->height;
    const double texels = width * height;

    OTX_TRY(otx_pool_for(run->pool, image->height, survey_row, &s));
    for (int32_t y = 0; y < image->height; ++y)
    {
        for (int k = 0; k < 3; ++k)
            all.sum[k] += s.rows[y].sum[k];
        all.sum_sq += s.rows[y].sum_sq;
        all.step_sq += s.rows[y].step_sq;
    }

    double variance = all.sum_sq / texels;

    for (int k = 0; k < 3; ++k)
        variance -= all.sum[k] / texels * (all.sum[k] / texels);
    *sigma = sqrt(2.0 * fmax(variance, 0.0));
    *step =
        sqrt(all.step_sq / ((width - 1.0) * height + width * (height - 1.0)));
    return OSDTEX_OK;
}

otx_status
otx_exemplar_measure(otx_run *run, otx_exemplar *e)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    row_sums *rows;

    if (!e->lab.pixels)
        return OSDTEX_OK;
    rows = OTX_NEW(run->scratch, row_sums, e->match.height);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(measure(run, rows, &e->match, &e->match_sigma, &e->match_step));
    OTX_TRY(measure(run, rows, &e->lab, &e->lab_sigma, &e->lab_step));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}
