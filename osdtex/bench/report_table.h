/* report_table.h -- figures as Markdown tables on the terminal, and as JSON. */
#ifndef OTX_BENCH_REPORT_TABLE_H
#define OTX_BENCH_REPORT_TABLE_H

#include "base/status.h"

#include <jansson.h>

typedef struct bench_report
{
    json_t *tables;             /* array; NULL while nothing is recorded */
    const char *const *columns; /* of the table that is being written */
    int32_t column_count;
} bench_report;

/* Starts a table.
 *
 *   title    one line above it
 *   columns  NULL-terminated, the label's heading first; borrowed until the
 *            next table */
void bench_report_begin(
    bench_report *report, const char *title, const char *const *columns);

/* One row: the label and a number for each column behind it, to three digits;
 * what is not finite is left empty (null in the JSON). */
void
bench_report_row(bench_report *report, const char *label, const double *values);

/* A sentence below the table. */
void bench_report_note(const char *format, ...) OTX_PRINTF(1, 2);

#endif
