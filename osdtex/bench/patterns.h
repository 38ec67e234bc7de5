/* patterns.h -- exemplars made by rule. */
#ifndef OTX_BENCH_PATTERNS_H
#define OTX_BENCH_PATTERNS_H

#include "exemplar/exemplar.h"

/* Smooth coloured blobs of three sizes, tiling, n x n (n a multiple of 16).
 * RGB in [0, 1]; in run->arena. */
otx_status bench_patterns_blobs(otx_run *run, int32_t n, otx_image *out);

/* Rounded pebbles with dark joints and a grain of their own, tiling. */
otx_status bench_patterns_pebbles(otx_run *run, int32_t n, otx_image *out);

/* The exemplar made of it, read as sRGB. */
otx_status bench_patterns_exemplar(
    otx_run *run, const otx_image *pixels, otx_exemplar *out);

/* The exemplar of a picture file. */
otx_status
bench_patterns_read(otx_run *run, const char *path, otx_exemplar *out);

#endif
