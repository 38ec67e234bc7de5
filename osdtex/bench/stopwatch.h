/* stopwatch.h -- times of alternatives that run by turns.
 *
 * On a machine that others use too, two measurements an hour apart say nothing
 * about each other. So whatever is to be compared is run in one go, A B C A B
 * C ..., and what is reported is a ratio of that one run. */
#ifndef OTX_BENCH_STOPWATCH_H
#define OTX_BENCH_STOPWATCH_H

#include "base/status.h"

/* Seconds. The processor time is that of all threads of the process. */
typedef struct bench_time
{
    double wall, cpu;
} bench_time;

bench_time bench_stopwatch_now(void);

/* Time since `start`. */
bench_time bench_stopwatch_since(bench_time start);

typedef struct bench_lane
{
    otx_status (*body)(void *context);
    void *context;
    bench_time best;   /* smallest wall and smallest processor time */
    bench_time median; /* of each */
} bench_lane;

/* Runs the bodies of all lanes in turn, `repeat` (1 .. 99) times over. The
 * first failure ends it. */
otx_status
bench_stopwatch_race(bench_lane *lanes, int32_t count, int32_t repeat);

#endif
