/* fft.c -- two-dimensional transforms as rows, then blocks of columns.
 *
 * A mask fills a fraction of the rows of the exemplar, so its row transforms
 * are done only there. Columns are transformed BLOCK at a time, and the
 * product with the known spectrum and the inverse along the columns follow
 * while the block is in the cache: a spectrum of f is never stored. That makes
 * a masked search cheaper than the same transforms through FFTW's own
 * two-dimensional plans; docs/notes/match.md has the figures.
 *
 * Plans are made with FFTW_ESTIMATE: measured plans depend on timing, and with
 * them the last bits of the results. */
#include "math/fft.h"

#include <fftw3.h>
#include <pthread.h>
#include <string.h>

enum
{
    BLOCK = 8, /* columns: one cache line of complex numbers */
    BLOCK_FLOATS = 2 * BLOCK
};

struct otx_fft
{
    int32_t width;
    int32_t height;
    int32_t block_count;
    fftwf_plan row_forward;    /* in place, real to complex */
    fftwf_plan row_inverse;    /* in place, complex to real */
    fftwf_plan column_forward; /* in place, BLOCK columns */
    fftwf_plan column_inverse;
};

/* FFTW's planner and the destruction of plans share hidden state, and two
 * contexts may be at work in two threads. This lock is the only mutable
 * global of the library; it guards nothing of ours. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

static void
destroy_plans(void *object)
{
    otx_fft *fft = object;
    const fftwf_plan plans[] = {
        fft->row_forward, fft->row_inverse, fft->column_forward,
        fft->column_inverse};

    pthread_mutex_lock(&planner);
    for (int i = 0; i < 4; ++i)
        if (plans[i])
            fftwf_destroy_plan(plans[i]);
    pthread_mutex_unlock(&planner);
}

static fftwf_plan
plan_columns(const otx_fft *fft, fftwf_complex *block, int sign)
{
    return fftwf_plan_many_dft(
        1, &fft->height, BLOCK, block, NULL, BLOCK, 1, block, NULL, BLOCK, 1,
        sign, FFTW_ESTIMATE);
}

/* `row` and `block` tell the planner the alignment; they are not touched. */
static bool
make_plans(otx_fft *fft, float *row, fftwf_complex *block)
{
    pthread_mutex_lock(&planner);
    fft->row_forward = fftwf_plan_dft_r2c_1d(
        fft->width, row, (fftwf_complex *)row, FFTW_ESTIMATE);
    fft->row_inverse = fftwf_plan_dft_c2r_1d(
        fft->width, (fftwf_complex *)row, row, FFTW_ESTIMATE);
    fft->column_forward = plan_columns(fft, block, FFTW_FORWARD);
    fft->column_inverse = plan_columns(fft, block, FFTW_BACKWARD);
    pthread_mutex_unlock(&planner);
    return fft->row_forward && fft->row_inverse && fft->column_forward &&
           fft->column_inverse;
}

otx_status
otx_fft_create(
    otx_run *run, otx_arena *arena, int32_t width, int32_t height,
    otx_fft **out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_fft *fft = OTX_ZNEW(arena, otx_fft, 1);
    float *row;
    fftwf_complex *block;

    *out = NULL;
    if (!fft)
        return otx_fail_memory(run, "match");
    fft->width = width;
    fft->height = height;
    fft->block_count = (width / 2 + 1 + BLOCK - 1) / BLOCK;
    row = OTX_NEW(run->scratch, float, otx_fft_stride(fft));
    block = OTX_NEW(run->scratch, fftwf_complex, (size_t)height * BLOCK);
    if (!row || !block || !otx_arena_defer(arena, destroy_plans, fft))
    {
        otx_arena_release(run->scratch, mark);
        return otx_fail_memory(run, "match");
    }
    const bool planned = make_plans(fft, row, block);

    otx_arena_release(run->scratch, mark);
    if (!planned)
        return otx_fail_memory(run, "match");
    *out = fft;
    return OSDTEX_OK;
}

static bool
is_smooth(int32_t n)
{
    for (int32_t prime = 2; prime <= 7; ++prime)
        while (n % prime == 0)
            n /= prime;
    return n == 1;
}

int32_t
otx_fft_good_size(int32_t size)
{
    int32_t good = size < 2 ? 2 : size + size % 2;

    while (!is_smooth(good))
        good += 2;
    return good;
}

size_t
otx_fft_stride(const otx_fft *fft)
{
    return (size_t)fft->block_count * BLOCK_FLOATS;
}

size_t
otx_fft_spectrum_floats(const otx_fft *fft)
{
    return (size_t)fft->height * otx_fft_stride(fft);
}

/* Two blocks of columns: the transform in hand and the running sum. */
size_t
otx_fft_scratch_floats(const otx_fft *fft)
{
    return 2 * (size_t)fft->height * BLOCK_FLOATS;
}

static void
transform_rows(const otx_fft *fft, float *plane, int32_t row_count)
{
    const size_t stride = otx_fft_stride(fft);
    const size_t used = 2 * ((size_t)fft->width / 2 + 1);

    for (int32_t y = 0; y < row_count; ++y)
    {
        float *row = plane + (size_t)y * stride;

        fftwf_execute_dft_r2c(fft->row_forward, row, (fftwf_complex *)row);
        /* What pads the last block takes part in transforms: no stray NaN. */
        memset(row + used, 0, (stride - used) * sizeof *row);
    }
}

/* Gathers block `b` of transformed rows, zero above them, and transforms its
 * columns. */
static void
transform_block(
    const otx_fft *fft, const float *plane, int32_t row_count, int32_t b,
    float *block)
{
    const size_t stride = otx_fft_stride(fft);
    const float *from = plane + (size_t)b * BLOCK_FLOATS;

    for (size_t y = 0; y < (size_t)row_count; ++y)
        memcpy(
            block + y * BLOCK_FLOATS, from + y * stride,
            BLOCK_FLOATS * sizeof *block);
    memset(
        block + (size_t)row_count * BLOCK_FLOATS, 0,
        (size_t)(fft->height - row_count) * BLOCK_FLOATS * sizeof *block);
    fftwf_execute_dft(
        fft->column_forward, (fftwf_complex *)block, (fftwf_complex *)block);
}

void
otx_fft_forward(const otx_fft *fft, float scale, float *plane, float *spectrum)
{
    const size_t block_floats = (size_t)fft->height * BLOCK_FLOATS;
    const size_t floats = otx_fft_spectrum_floats(fft);

    transform_rows(fft, plane, fft->height);
    for (int32_t b = 0; b < fft->block_count; ++b)
        transform_block(
            fft, plane, fft->height, b, spectrum + (size_t)b * block_floats);
    for (size_t i = 0; i < floats; ++i)
        spectrum[i] *= scale;
}

/* sum += conj(f) g, or sum = conj(f) g for the first. */
static void
add_product(
    size_t floats, bool first, const float *restrict f, const float *restrict g,
    float *restrict sum)
{
    if (first)
        memset(sum, 0, floats * sizeof *sum);
    for (size_t i = 0; i < floats; i += 2)
    {
        const float re = f[i] * g[i] + f[i + 1] * g[i + 1];
        const float im = f[i] * g[i + 1] - f[i + 1] * g[i];

        sum[i] += re;
        sum[i + 1] += im;
    }
}

/* Transforms the columns of `sum` back and scatters them to rows. */
static void
restore_block(const otx_fft *fft, float *sum, int32_t b, float *out)
{
    const size_t stride = otx_fft_stride(fft);
    float *to = out + (size_t)b * BLOCK_FLOATS;

    fftwf_execute_dft(
        fft->column_inverse, (fftwf_complex *)sum, (fftwf_complex *)sum);
    for (size_t y = 0; y < (size_t)fft->height; ++y)
        memcpy(
            to + y * stride, sum + y * BLOCK_FLOATS,
            BLOCK_FLOATS * sizeof *sum);
}

void
otx_fft_correlate(
    const otx_fft *fft, int32_t plane_count, int32_t row_count,
    float *const planes[], const float *const spectra[], float *scratch,
    float *out)
{
    const size_t block_floats = (size_t)fft->height * BLOCK_FLOATS;
    float *block = scratch;
    float *sum = scratch + block_floats;

    for (int32_t p = 0; p < plane_count; ++p)
        transform_rows(fft, planes[p], row_count);
    for (int32_t b = 0; b < fft->block_count; ++b)
    {
        for (int32_t p = 0; p < plane_count; ++p)
        {
            transform_block(fft, planes[p], row_count, b, block);
            add_product(
                block_floats, p == 0, block,
                spectra[p] + (size_t)b * block_floats, sum);
        }
        restore_block(fft, sum, b, out);
    }
    for (int32_t y = 0; y < fft->height; ++y)
    {
        float *row = out + (size_t)y * otx_fft_stride(fft);

        fftwf_execute_dft_c2r(fft->row_inverse, (fftwf_complex *)row, row);
    }
}
