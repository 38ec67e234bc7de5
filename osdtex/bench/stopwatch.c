/* stopwatch.c -- clocks, best and median. */
#include "bench/stopwatch.h"

#include "base/clock.h"

#include <stdlib.h>

enum
{
    MOST_LANES = 8,
    MOST_TURNS = 99
};

bench_time
bench_stopwatch_now(void)
{
    return (bench_time){
        otx_clock_now(), otx_clock_read(CLOCK_PROCESS_CPUTIME_ID)};
}

bench_time
bench_stopwatch_since(bench_time start)
{
    const bench_time now = bench_stopwatch_now();

    return (bench_time){now.wall - start.wall, now.cpu - start.cpu};
}

static int
compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* Sorts `turns` and takes the first and the middle one. */
static void
summarise(double *turns, int32_t count, double *best, double *median)
{
    qsort(turns, (size_t)count, sizeof *turns, compare);
    *best = turns[0];
    *median = 0.5 * (turns[(count - 1) / 2] + turns[count / 2]);
}

otx_status
bench_stopwatch_race(bench_lane *lanes, int32_t count, int32_t repeat)
{
    double wall[MOST_LANES][MOST_TURNS], cpu[MOST_LANES][MOST_TURNS];

    if (count > MOST_LANES || repeat < 1 || repeat > MOST_TURNS)
        return OSDTEX_ERROR_ARGUMENT;
    for (int32_t turn = 0; turn < repeat; ++turn)
        for (int32_t l = 0; l < count; ++l)
        {
            const bench_time start = bench_stopwatch_now();

            OTX_TRY(lanes[l].body(lanes[l].context));
            const bench_time taken = bench_stopwatch_since(start);

            wall[l][turn] = taken.wall;
            cpu[l][turn] = taken.cpu;
        }
    for (int32_t l = 0; l < count; ++l)
    {
        summarise(wall[l], repeat, &lanes[l].best.wall, &lanes[l].median.wall);
        summarise(cpu[l], repeat, &lanes[l].best.cpu, &lanes[l].median.cpu);
    }
    return OSDTEX_OK;
}
