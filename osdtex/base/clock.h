/* clock.h -- seconds. */
#ifndef OTX_BASE_CLOCK_H
#define OTX_BASE_CLOCK_H

#include <time.h>

/* Seconds of a POSIX clock. */
static inline double
otx_clock_read(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Wall seconds of a clock that never goes back. */
static inline double
otx_clock_now(void)
{
    return otx_clock_read(CLOCK_MONOTONIC);
}

#endif
