/* report_table.c -- Markdown and JSON from the same rows. */
#include "bench/report_table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

void
bench_report_begin(
    bench_report *report, const char *title, const char *const *columns)
{
    json_t *table = json_object();

    report->columns = columns;
    report->column_count = 0;
    printf("\n%s\n\n|", title);
    for (; columns[report->column_count]; ++report->column_count)
        printf(" %s |", columns[report->column_count]);
    printf("\n|");
    for (int32_t c = 0; c < report->column_count; ++c)
        printf(c ? "---:|" : "---|");
    printf("\n");
    fflush(stdout);
    if (!report->tables)
        report->tables = json_array();
    json_object_set_new(table, "title", json_string(title));
    json_object_set_new(table, "rows", json_array());
    json_array_append_new(report->tables, table);
}

/* Three digits, and never fewer than a whole number has. */
static void
print_number(double value)
{
    const double size = fabs(value);
    const int digits = size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2;

    if (!isfinite(value))
        printf(" |");
    else if (value == floor(value) && size < 1e15)
        printf(" %.0f |", value);
    else
        printf(" %.*f |", size < 0.0995 ? 4 : digits, value);
}

void
bench_report_row(bench_report *report, const char *label, const double *values)
{
    json_t *row = json_object();
    json_t *table =
        json_array_get(report->tables, json_array_size(report->tables) - 1);

    printf("| %s |", label);
    json_object_set_new(row, report->columns[0], json_string(label));
    for (int32_t c = 1; c < report->column_count; ++c)
    {
        const double value = values[c - 1];

        print_number(value);
        json_object_set_new(
            row, report->columns[c],
            isfinite(value) ? json_real(value) : json_null());
    }
    printf("\n");
    fflush(stdout);
    json_array_append_new(json_object_get(table, "rows"), row);
}

void
bench_report_note(const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    printf("\n");
    vprintf(format, arguments);
    printf("\n");
    va_end(arguments);
    fflush(stdout);
}
