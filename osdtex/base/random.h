/* random.h -- random numbers as a hash of what they are for.
 *
 * There is no generator and no sequence: a number depends only on (seed,
 * stage, element), so the order in which threads ask does not matter. The
 * mixer is the finaliser of SplitMix64 [Steele14], applied twice. */
#ifndef OTX_BASE_RANDOM_H
#define OTX_BASE_RANDOM_H

#include <stdint.h>

static inline uint64_t
otx_random_mix(uint64_t x)
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/* 64 bits that depend on nothing but the arguments. */
static inline uint64_t
otx_random_bits(uint64_t seed, uint32_t stage, uint64_t element)
{
    return otx_random_mix(
        otx_random_mix(seed ^ ((uint64_t)stage << 32)) + element);
}

/* Uniform in [0, 1). */
static inline double
otx_random_unit(uint64_t seed, uint32_t stage, uint64_t element)
{
    return (double)(otx_random_bits(seed, stage, element) >> 11) * 0x1.0p-53;
}

#endif
