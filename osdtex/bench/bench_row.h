/* bench_row.h -- what can be timed and verified. */
#ifndef OTX_BENCH_BENCH_ROW_H
#define OTX_BENCH_BENCH_ROW_H

#include "bench/report_table.h"

typedef struct bench_options
{
    int32_t threads; /* of the runs that are not in one thread, >= 1 */
    int32_t repeat;  /* 0: as the row thinks fit */
    bool large;      /* also what takes minutes and gigabytes */
    const char *cage, *exemplar; /* files for "map"; NULL: none */
} bench_options;

/* `time` fills tables, `verify` prints a line for each thing it has compared.
 * Both return false when something failed or was wrong. */
typedef struct bench_row
{
    const char *name;
    const char *summary; /* one sentence */
    bool (*time)(const bench_options *options, bench_report *report);
    bool (*verify)(const bench_options *options);
} bench_row;

extern const bench_row bench_row_match;
extern const bench_row bench_row_scipy;
extern const bench_row bench_row_surface;
extern const bench_row bench_row_stages;
extern const bench_row bench_row_map;
extern const bench_row bench_row_tile;
extern const bench_row bench_row_general;
extern const bench_row bench_row_growth;
extern const bench_row bench_row_write;
extern const bench_row bench_row_exr;
extern const bench_row bench_row_field;
extern const bench_row bench_row_edit;
extern const bench_row bench_row_bake;

static inline int32_t
bench_row_repeat(const bench_options *options, int32_t usual)
{
    return options->repeat > 0 ? options->repeat : usual;
}

/* Prints "ok" or "WRONG" with what was compared; returns `right`. */
bool bench_row_check(bool right, const char *format, ...) OTX_PRINTF(2, 3);

#endif
