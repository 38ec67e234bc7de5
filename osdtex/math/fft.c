/* fft.c -- two-dimensional transforms as rows, then blocks of columns.
 *
 * A mask fills a fraction of the rows of the exemplar, so its row transforms
 * are done only there. Columns are transformed BLOCK at a time, and the
 * product with the known spectrum and the inverse along the columns follow
 * while the block is in the cache: a spectrum of f is never stored. That makes
 * a masked search cheaper than the same transforms through FFTW's own
 * two-dimensional plans; docs/notes/match.md has the figures.
 *
 * A block is transposed, so that each column is contiguous: that is two to
 * three times as fast to transform as columns that lie side by side. The pitch
 * of a column is not a power of two, else the columns of a block would share
 * their cache sets.
 *
 * Plans are made with FFTW_ESTIMATE: measured plans depend on timing, and with
 * them the last bits of the results. */
#include "math/fft.h"

#include <fftw3.h>
#include <pthread.h>
#include <string.h>

enum
{
    BLOCK = 8 /* columns: one cache line of complex numbers of a row */
};

typedef struct complex_float
{
    float re, im;
} complex_float;

struct otx_fft
{
    int32_t width;
    int32_t height;
    int32_t block_count;
    size_t pitch; /* from column to column of a block, complex numbers */
    fftwf_plan row_forward;    /* real to complex, in place */
    fftwf_plan row_inverse;    /* complex to real, in a buffer to its place */
    fftwf_plan column_forward; /* BLOCK columns, from buffer to buffer */
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
plan_columns(const otx_fft *fft, fftwf_complex *buffer, int sign)
{
    const int pitch = (int)fft->pitch;

    return fftwf_plan_many_dft(
        1, &fft->height, BLOCK, buffer, NULL, 1, pitch,
        buffer + BLOCK * fft->pitch, NULL, 1, pitch, sign, FFTW_ESTIMATE);
}

/* `row` (two of them) and `buffer` (two blocks) tell the planner the
 * alignment; they are not touched. */
static bool
make_plans(otx_fft *fft, float *row, fftwf_complex *buffer)
{
    float *other = row + otx_fft_stride(fft);

    pthread_mutex_lock(&planner);
    fft->row_forward = fftwf_plan_dft_r2c_1d(
        fft->width, row, (fftwf_complex *)row, FFTW_ESTIMATE);
    fft->row_inverse = fftwf_plan_dft_c2r_1d(
        fft->width, (fftwf_complex *)row, other, FFTW_ESTIMATE);
    fft->column_forward = plan_columns(fft, buffer, FFTW_FORWARD);
    fft->column_inverse = plan_columns(fft, buffer, FFTW_BACKWARD);
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
    float *rows;
    fftwf_complex *buffer;
    bool planned;

    *out = NULL;
    if (!fft)
        return otx_fail_memory(run, "match");
    fft->width = width;
    fft->height = height;
    fft->block_count = (width / 2 + 1 + BLOCK - 1) / BLOCK;
    fft->pitch = ((size_t)height + 7) / 8 * 8 + 8;
    rows = OTX_NEW(run->scratch, float, 2 * otx_fft_stride(fft));
    buffer = OTX_NEW(run->scratch, fftwf_complex, 2 * BLOCK * fft->pitch);
    planned = rows && buffer && otx_arena_defer(arena, destroy_plans, fft) &&
              make_plans(fft, rows, buffer);
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
    return (size_t)fft->block_count * BLOCK * 2;
}

static size_t
block_floats(const otx_fft *fft)
{
    return 2 * BLOCK * fft->pitch;
}

size_t
otx_fft_spectrum_floats(const otx_fft *fft)
{
    return (size_t)fft->block_count * block_floats(fft);
}

/* Three blocks: gathered, transformed, summed; and one row. */
size_t
otx_fft_scratch_floats(const otx_fft *fft)
{
    return 3 * block_floats(fft) + otx_fft_stride(fft);
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

/* Transposes block `b` of transformed rows to columns, zero above them. */
static void
gather_block(
    const otx_fft *fft, const float *plane, int32_t row_count, int32_t b,
    float *block)
{
    const size_t stride = otx_fft_stride(fft) / 2;
    const size_t pitch = fft->pitch;
    const size_t count = (size_t)row_count;
    const complex_float *from =
        (const complex_float *)plane + (size_t)b * BLOCK;
    complex_float *to = (complex_float *)block;

    for (size_t y = 0; y < count; ++y)
        for (size_t k = 0; k < BLOCK; ++k)
            to[k * pitch + y] = from[y * stride + k];
    for (size_t k = 0; k < BLOCK; ++k)
        memset(to + k * pitch + count, 0, (pitch - count) * sizeof *to);
}

static void
scatter_block(const otx_fft *fft, const float *block, int32_t b, float *plane)
{
    const size_t stride = otx_fft_stride(fft) / 2;
    const size_t pitch = fft->pitch;
    const complex_float *from = (const complex_float *)block;
    complex_float *to = (complex_float *)plane + (size_t)b * BLOCK;

    for (size_t y = 0; y < (size_t)fft->height; ++y)
        for (size_t k = 0; k < BLOCK; ++k)
            to[y * stride + k] = from[k * pitch + y];
}

void
otx_fft_forward(
    const otx_fft *fft, float scale, float *plane, float *scratch,
    float *spectrum)
{
    const size_t floats = otx_fft_spectrum_floats(fft);

    /* The ends of columns, past the height, are multiplied too. */
    memset(spectrum, 0, floats * sizeof *spectrum);
    transform_rows(fft, plane, fft->height);
    for (int32_t b = 0; b < fft->block_count; ++b)
    {
        gather_block(fft, plane, fft->height, b, scratch);
        fftwf_execute_dft(
            fft->column_forward, (fftwf_complex *)scratch,
            (fftwf_complex *)(spectrum + (size_t)b * block_floats(fft)));
    }
    for (size_t i = 0; i < floats; ++i)
        spectrum[i] *= scale;
}

/* sum += conj(f) g */
static void
add_product(
    size_t floats, const float *restrict f, const float *restrict g,
    float *restrict sum)
{
    for (size_t i = 0; i < floats; i += 2)
    {
        sum[i] += f[i] * g[i] + f[i + 1] * g[i + 1];
        sum[i + 1] += f[i] * g[i + 1] - f[i + 1] * g[i];
    }
}

/* Each row goes through `buffer`: a transform from one place to another is a
 * third faster than one in place, even with the copy. */
static void
restore_rows(const otx_fft *fft, float *buffer, float *plane)
{
    const size_t stride = otx_fft_stride(fft);

    for (int32_t y = 0; y < fft->height; ++y)
    {
        float *row = plane + (size_t)y * stride;

        memcpy(buffer, row, stride * sizeof *row);
        fftwf_execute_dft_c2r(fft->row_inverse, (fftwf_complex *)buffer, row);
    }
}

void
otx_fft_correlate(
    const otx_fft *fft, int32_t plane_count, int32_t row_count,
    float *const planes[], const float *const spectra[], float *scratch,
    float *out)
{
    const size_t floats = block_floats(fft);
    float *gathered = scratch;
    float *transformed = gathered + floats;
    float *sum = transformed + floats;

    for (int32_t p = 0; p < plane_count; ++p)
        transform_rows(fft, planes[p], row_count);
    memset(transformed, 0, floats * sizeof *transformed);
    for (int32_t b = 0; b < fft->block_count; ++b)
    {
        memset(sum, 0, floats * sizeof *sum);
        for (int32_t p = 0; p < plane_count; ++p)
        {
            gather_block(fft, planes[p], row_count, b, gathered);
            fftwf_execute_dft(
                fft->column_forward, (fftwf_complex *)gathered,
                (fftwf_complex *)transformed);
            add_product(
                floats, transformed, spectra[p] + (size_t)b * floats, sum);
        }
        fftwf_execute_dft(
            fft->column_inverse, (fftwf_complex *)sum,
            (fftwf_complex *)gathered);
        scatter_block(fft, gathered, b, out);
    }
    restore_rows(fft, sum + floats, out);
}
