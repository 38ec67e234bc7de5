/* bench_match.h -- the masked search against the transforms it is made of. */
#ifndef OTX_BENCH_BENCH_MATCH_H
#define OTX_BENCH_BENCH_MATCH_H

/* Times one fit over 19 orientations at 128, 256 and 512 texels: at full
 * resolution against the bare FFTW transforms of the same job, and as it is
 * done by default, coarse to fine. Prints one row per size.
 *
 *   verify  checks error maps against direct sums instead
 *
 * Returns 0, or 1 when something failed or was wrong. */
int bench_match(int verify);

#endif
