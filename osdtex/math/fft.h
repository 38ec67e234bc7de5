/* fft.h -- circular correlation of pictures through FFTW.
 *
 * One kind of question is asked, many times a second: the sum over planes of
 *
 *   (f * g)(x0) = sum_x f(x) g(x + x0) = F^-1(conj(F f) F g)(x0)
 *
 * where the spectra of g are known and f fills few rows. The conjugate belongs
 * to f: on the wrong side it mirrors x0.
 *
 * Rows lie `otx_fft_stride` floats apart, so that they can be transformed in
 * place. Spectra are opaque: blocks of columns, see fft.c. */
#ifndef OTX_MATH_FFT_H
#define OTX_MATH_FFT_H

#include "base/run.h"

/* Plans for one size; immutable, shared by threads. */
typedef struct otx_fft otx_fft;

/* Plans in `arena`, destroyed with it. Any size from 1 x 1; products of small
 * primes are fast. MEMORY. */
otx_status otx_fft_create(
    otx_run *run, otx_arena *arena, int32_t width, int32_t height,
    otx_fft **out);

/* The smallest even 2^a 3^b 5^c 7^d that is at least `size` (and 2). */
int32_t otx_fft_good_size(int32_t size);

/* Floats from row to row of every plane given to the functions below. */
size_t otx_fft_stride(const otx_fft *fft);

/* Floats of one spectrum, and of the `scratch` below. */
size_t otx_fft_spectrum_floats(const otx_fft *fft);
size_t otx_fft_scratch_floats(const otx_fft *fft);

/* Spectrum of `scale` times a plane of [height * stride], whose contents are
 * lost. All buffers here and below come from arenas (aligned to 64). */
void otx_fft_forward(
    const otx_fft *fft, float scale, float *plane, float *scratch,
    float *spectrum);

/* Sum of the correlations of `planes` with the pictures of `spectra`, times
 * width * height (FFTW's inverse is not normalised).
 *
 *   planes   [plane_count] of [row_count * stride], row_count <= height, the
 *            rows above count as zero; contents are lost
 *   spectra  [plane_count]
 *   scratch  [otx_fft_scratch_floats]
 *   out      [height * stride]; x0 = (x, y) at out[y * stride + x] */
void otx_fft_correlate(
    const otx_fft *fft, int32_t plane_count, int32_t row_count,
    float *const planes[], const float *const spectra[], float *scratch,
    float *out);

#endif
