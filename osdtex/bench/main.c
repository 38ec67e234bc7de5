/* main.c -- osdtex-bench: times stages, or verifies them against slow
 * references.
 *
 *     osdtex-bench [-s | -y | -l] [ROW ...] [--threads N] [--repeat N]
 *                  [--large] [--cage OBJ] [--exemplar PICTURE] [--json FILE]
 */
#include "bench/bench_row.h"

#include "base/pool.h"

#include <math.h>
#include <osdtex/version.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const bench_row *const ROWS[] = {
    &bench_row_match, &bench_row_scipy,   &bench_row_surface, &bench_row_stages,
    &bench_row_map,   &bench_row_general, &bench_row_growth,  &bench_row_tile,
    &bench_row_write, &bench_row_exr,     &bench_row_field,   &bench_row_edit,
    &bench_row_bake,
};

#ifdef NDEBUG
static const char ASSERTIONS[] = "off";
#else
static const char ASSERTIONS[] = "ON: these are not the figures of a release";
#endif

enum
{
    ROW_COUNT = sizeof ROWS / sizeof ROWS[0]
};

typedef struct command
{
    char mode; /* s, y or l */
    bool chosen[ROW_COUNT];
    bool any_chosen;
    const char *json;
    bench_options options;
} command;

bool
bench_row_check(bool right, const char *format, ...)
{
    va_list arguments;

    printf("%-5s ", right ? "ok" : "WRONG");
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
    fflush(stdout);
    return right;
}

static int
usage(void)
{
    fprintf(
        stderr,
        "usage: osdtex-bench [-s | -y | -l] [ROW ...] [--threads N] "
        "[--repeat N]\n"
        "                    [--large] [--cage OBJ] [--exemplar PICTURE] "
        "[--json FILE]\n"
        "  -s         time (the default)\n"
        "  -y         verify against slow references\n"
        "  -l         list the rows\n"
        "  --threads  of what does not run in one thread; default: the cores\n"
        "  --repeat   measure N times, 1 .. 99; default: the row's own\n"
        "  --large    also sizes that take minutes and gigabytes\n"
        "  --cage, --exemplar  files for the row 'map'\n"
        "  --json     the figures once more, for programs\n");
    return 1;
}

static bool
choose_row(command *c, const char *name)
{
    for (int r = 0; r < ROW_COUNT; ++r)
        if (strcmp(ROWS[r]->name, name) == 0)
            return c->any_chosen = c->chosen[r] = true;
    fprintf(
        stderr, "osdtex-bench: there is no row '%s'; -l lists them\n", name);
    return false;
}

static bool
parse_number(const char *text, int32_t *out)
{
    char *end;
    const long value = text ? strtol(text, &end, 10) : 0;

    if (!text || *end || value < 1 || value > 99)
        return false;
    *out = (int32_t)value;
    return true;
}

/* An option that takes a value. */
static bool
parse_value(command *c, const char *name, const char *value)
{
    if (strcmp(name, "--threads") == 0)
        return parse_number(value, &c->options.threads);
    if (strcmp(name, "--repeat") == 0)
        return parse_number(value, &c->options.repeat);
    if (strcmp(name, "--json") == 0)
        return (c->json = value) != NULL;
    if (strcmp(name, "--cage") == 0)
        return (c->options.cage = value) != NULL;
    if (strcmp(name, "--exemplar") == 0)
        return (c->options.exemplar = value) != NULL;
    return false;
}

static bool
parse(command *c, int argc, char **argv)
{
    for (int a = 1; a < argc; ++a)
    {
        const char *word = argv[a];

        if (word[0] != '-')
        {
            if (!choose_row(c, word))
                return false;
        }
        else if (strlen(word) == 2 && strchr("syl", word[1]))
            c->mode = word[1];
        else if (strcmp(word, "--large") == 0)
            c->options.large = true;
        /* argv[argc] is NULL: a value that is missing. */
        else if (!parse_value(c, word, argv[a + 1]))
            return false;
        else
            ++a;
    }
    return true;
}

/* What the figures depend on, above them. */
static void
introduce(const command *c)
{
    double load[1] = {NAN};

    if (getloadavg(load, 1) != 1)
        load[0] = NAN;
    printf(
        "osdtex %s, %d threads of %ld cores, load %.2f before the start, "
        "assertions %s\n",
        osdtex_version(), c->options.threads, sysconf(_SC_NPROCESSORS_ONLN),
        load[0], ASSERTIONS);
}

static bool
write_json(const command *c, const bench_report *report)
{
    json_t *root = json_object();
    bool written;

    json_object_set_new(root, "version", json_string(osdtex_version()));
    json_object_set_new(root, "threads", json_integer(c->options.threads));
    json_object_set_new(
        root, "tables",
        report->tables ? json_incref(report->tables) : json_array());
    written = json_dump_file(root, c->json, JSON_INDENT(1)) == 0;
    json_decref(root);
    if (!written)
        fprintf(stderr, "osdtex-bench: cannot write '%s'\n", c->json);
    return written;
}

static bool
run_row(const command *c, int r, bench_report *report)
{
    const bench_row *row = ROWS[r];
    const bool skipped = c->any_chosen && !c->chosen[r];
    bool right = true;

    if (c->mode == 'l')
        printf("%-8s  %s\n", row->name, row->summary);
    else if (!skipped && c->mode == 'y' && row->verify)
        right = row->verify(&c->options);
    else if (!skipped && c->mode == 's')
        right = row->time(&c->options, report);
    if (!right)
        fprintf(stderr, "osdtex-bench: row '%s' failed\n", row->name);
    return right;
}

int
main(int argc, char **argv)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    command c = {
        .mode = 's',
        .options = {
            .threads = cores < 1    ? 1
                       : cores > 99 ? 99
                                    : (int32_t)cores}};
    bench_report report = {0};
    bool right = true;

    if (!parse(&c, argc, argv))
        return usage();
    if (c.mode == 's')
        introduce(&c);
    for (int r = 0; r < ROW_COUNT; ++r)
        right &= run_row(&c, r, &report);
    if (c.json)
        right &= write_json(&c, &report);
    json_decref(report.tables);
    return !right;
}
