/* regress.c -- the three tiers over all cases.
 *
 * Exact: the same content of every OBJ and EXR, on the same class of machine.
 * Tolerance: a picture that looks the same, anywhere. Metric: figures that may
 * move as far as stated. See docs/nightly.md. */
#include "regress/regress.h"
#include "regress/compare.h"
#include "regress/history.h"
#include "regress/metric.h"
#include "regress/process.h"
#include "regress/reference.h"
#include "regress/report_page.h"
#include "regress/trial.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum
{
    TIME_TRIES = 3 /* a slow time is measured again before it counts */
};

typedef struct bench
{
    const otx_regress_options *options;
    otx_suite suite;
    otx_reference reference;
    char machine[OTX_REFERENCE_MACHINE_BYTES];
} bench;

/* ---------------------------------------------------------------------- */
/* The tiers: an object with a status each.                                */

static const char *
judge_file(const json_t *now, const json_t *was)
{
    if (!was)
        return "missing";
    return now && json_equal(now, was) ? "pass" : "fail";
}

/* The worse of two statuses, in the order of this list. */
static const char *
worse(const char *a, const char *b)
{
    static const char *const order[] = {"fail", "missing", "skipped", "pass"};

    for (int i = 0; i < 4; ++i)
        if (strcmp(a, order[i]) == 0 || strcmp(b, order[i]) == 0)
            return order[i];
    return a;
}

static json_t *
exact_tier(const bench *b, const char *name, const json_t *result)
{
    const json_t *was = json_object_get(b->reference.exact, name);
    const json_t *old = json_object_get(was, "files");
    json_t *files = json_object_get(result, "files");
    json_t *rows = json_array(), *hash;
    const char *machine = otx_suite_text(was, "machine");
    const char *file, *status = "pass";

    json_object_foreach(files, file, hash)
    {
        const char *one = judge_file(hash, json_object_get(old, file));

        json_array_append_new(
            rows, json_pack("{s:s,s:s}", "name", file, "status", one));
        status = worse(status, one);
    }
    json_object_foreach((json_t *)(uintptr_t)old, file, hash)
    {
        if (json_object_get(files, file))
            continue;
        json_array_append_new(
            rows, json_pack("{s:s,s:s}", "name", file, "status", "fail"));
        status = "fail";
    }
    if (!was)
        status = "missing";
    else if (!machine || strcmp(machine, b->machine) != 0)
        status = "skipped";
    return json_pack(
        "{s:s,s:o,s:s,s:s?}", "status", status, "files", rows, "machine",
        b->machine, "reference_machine", machine);
}

static json_t *
tolerance_tier(const bench *b, const char *name, const json_t *result)
{
    char reference[OTX_SUITE_PATH_BYTES];
    otx_compare_difference d;

    otx_reference_picture(&b->reference, name, reference);
    if (access(reference, F_OK) != 0)
        return json_pack("{s:s}", "status", "missing");
    otx_compare_pictures(
        b->options->context, otx_suite_text(result, "picture"), reference, &d);
    if (!d.has_pixels)
        return json_pack(
            "{s:s,s:s,s:s}", "status", "fail", "reference", reference, "text",
            "the pictures are not of one size, or cannot be read");
    return json_pack(
        "{s:s,s:s,s:f,s:I,s:I,s:I,s:[i,i]}", "status",
        d.passes ? "pass" : "fail", "reference", reference, "worst", d.worst,
        "over", (json_int_t)d.over, "differing", (json_int_t)d.differing,
        "pixels", (json_int_t)d.pixels, "at", d.x, d.y);
}

static json_t *
metric_tier(const bench *b, const char *name, const json_t *result)
{
    json_t *rows = otx_metric_judge(
        json_object_get(result, "metrics"),
        json_object_get(b->reference.metrics, name),
        json_object_get(b->suite.table, "tolerances"));
    const char *status = "pass";
    json_t *row;
    size_t i;

    json_array_foreach(rows, i, row)
    {
        status = worse(status, otx_suite_text(row, "status"));
    }
    return json_pack("{s:s,s:o}", "status", status, "rows", rows);
}

/* Whether nothing but times is over. */
static bool
only_times_fail(const json_t *tier)
{
    bool any = false;
    json_t *row;
    size_t i;

    json_array_foreach(json_object_get(tier, "rows"), i, row)
    {
        if (strcmp(otx_suite_text(row, "status"), "fail") != 0)
            continue;
        if (!otx_metric_is_time(otx_suite_text(row, "name")))
            return false;
        any = true;
    }
    return any;
}

/* ---------------------------------------------------------------------- */

static json_t *
run_once(const bench *b, const char *name, const json_t *item)
{
    const otx_trial_options how = {
        .context = b->options->context,
        .program = b->options->program,
        .output = b->options->output,
        .stop = b->options->stop,
    };

    return otx_trial_run(&b->suite, name, item, &how);
}

/* Other work of the machine makes a time longer, never shorter: the least of
 * a few is taken before a time is said to be over. */
static json_t *
settle_times(
    const bench *b, const char *name, const json_t *item, json_t *result)
{
    json_t *tier = metric_tier(b, name, result);

    for (int i = 1; i < TIME_TRIES && only_times_fail(tier); ++i)
    {
        json_t *again = run_once(b, name, item);

        otx_metric_keep_faster(
            json_object_get(result, "metrics"),
            json_object_get(again, "metrics"));
        json_decref(again);
        json_decref(tier);
        tier = metric_tier(b, name, result);
    }
    return tier;
}

static void
judge(const bench *b, const char *name, const json_t *item, json_t *result)
{
    json_t *exact = exact_tier(b, name, result);
    json_t *tolerance = tolerance_tier(b, name, result);
    json_t *metric = settle_times(b, name, item, result);
    const char *status = worse(
        worse(
            otx_suite_text(exact, "status"),
            otx_suite_text(tolerance, "status")),
        otx_suite_text(metric, "status"));

    json_object_set_new(
        result, "status",
        json_string(strcmp(status, "skipped") == 0 ? "pass" : status));
    json_object_set_new(result, "exact", exact);
    json_object_set_new(result, "tolerance", tolerance);
    json_object_set_new(result, "metric", metric);
}

/* Makes what came out the reference. */
static bool
adopt(bench *b, const char *name, const json_t *result, char *error)
{
    char picture[OTX_SUITE_PATH_BYTES];

    json_object_set_new(
        b->reference.exact, name,
        json_pack(
            "{s:s,s:O}", "machine", b->machine, "files",
            json_object_get(result, "files")));
    json_object_set(
        b->reference.metrics, name, json_object_get(result, "metrics"));
    if (!otx_reference_write(&b->reference, error))
        return false;
    otx_reference_picture(&b->reference, name, picture);
    if (otx_reference_copy(otx_suite_text(result, "picture"), picture))
        return true;
    snprintf(error, OTX_SUITE_ERROR_BYTES, "%.400s cannot be written", picture);
    return false;
}

static void say(const bench *b, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void
say(const bench *b, const char *format, ...)
{
    char line[1024];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    b->options->say(b->options->user, line);
}

static bool
is_asked_for(const otx_regress_options *options, const char *name)
{
    if (options->update && strcmp(options->update, "all") != 0)
        return strcmp(options->update, name) == 0;
    for (int i = 0; i < options->name_count; ++i)
        if (strcmp(options->names[i], name) == 0)
            return true;
    return options->name_count == 0;
}

/* What makes the case's new results the reference, for a shell. */
static json_t *
update_command(const bench *b, const char *name)
{
    const char *const words[] = {
        "osdtex",   "regress", b->options->folder, "-o", b->options->output,
        "--update", name};
    otx_process_words list = {0};
    json_t *text = NULL;
    char *line;

    for (size_t i = 0; i < sizeof words / sizeof words[0]; ++i)
        otx_process_add(&list, words[i]);
    line = otx_process_line(&list);
    if (line)
        text = json_string(line);
    free(line);
    otx_process_free(&list);
    return text;
}

static otx_regress_end
run_case(
    bench *b, const char *name, const json_t *item, json_t *results,
    char *error)
{
    json_t *result = run_once(b, name, item);
    const char *crash = otx_suite_text(result, "crash");

    json_object_set_new(results, name, result);
    if (json_object_get(result, "stopped"))
    {
        snprintf(error, OTX_SUITE_ERROR_BYTES, "stopped");
        return OTX_REGRESS_STOPPED;
    }
    json_object_set_new(result, "update", update_command(b, name));
    if (crash)
        json_object_set_new(result, "status", json_string("crashed"));
    if (!crash && b->options->update && !adopt(b, name, result, error))
        return OTX_REGRESS_UNWRITTEN;
    if (!crash)
        judge(b, name, item, result);
    say(b, "%-8s %s%s%s", otx_suite_text(result, "status"), name,
        crash ? ": " : "", crash ? crash : "");
    return strcmp(otx_suite_text(result, "status"), "pass") == 0
               ? OTX_REGRESS_PASSED
               : OTX_REGRESS_DIFFERS;
}

/* A name that is none of the cases is a mistake, not an empty run. */
static bool
names_are_known(const bench *b, char *error)
{
    const otx_regress_options *o = b->options;
    const char *unknown = NULL;

    if (o->update && strcmp(o->update, "all") != 0 &&
        !json_object_get(b->suite.cases, o->update))
        unknown = o->update;
    for (int i = 0; i < o->name_count; ++i)
        if (!json_object_get(b->suite.cases, o->names[i]))
            unknown = o->names[i];
    if (unknown)
        snprintf(
            error, OTX_SUITE_ERROR_BYTES,
            "the table of %.200s has no case '%.200s'", o->folder, unknown);
    return !unknown;
}

static otx_regress_end
run_cases(bench *b, json_t *results, char *error)
{
    otx_regress_end end = OTX_REGRESS_PASSED;
    const char *name;
    json_t *item;

    json_object_foreach(b->suite.cases, name, item)
    {
        otx_regress_end one;

        if (!is_asked_for(b->options, name))
            continue;
        one = run_case(b, name, item, results, error);
        if (one > OTX_REGRESS_DIFFERS)
            return one;
        if (one == OTX_REGRESS_DIFFERS)
            end = one;
    }
    return end;
}

/* ---------------------------------------------------------------------- */

static json_t *
metrics_of(const json_t *results)
{
    json_t *all = json_object(), *result;
    const char *name;

    json_object_foreach((json_t *)(uintptr_t)results, name, result)
    {
        json_object_set(all, name, json_object_get(result, "metrics"));
    }
    return all;
}

static json_t *
run_as_json(const bench *b, json_t *results)
{
    char when[32];
    const time_t now = time(NULL);
    struct tm utc;

    strftime(when, sizeof when, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    return json_pack(
        "{s:s,s:s,s:s,s:s,s:s,s:O}", "suite", b->options->folder, "version",
        osdtex_version(), "build", osdtex_build(), "machine", b->machine,
        "time", when, "cases", results);
}

static bool
write_results(const bench *b, json_t *results, char *error)
{
    json_t *run = run_as_json(b, results), *metrics = metrics_of(results);
    char path[3][OTX_SUITE_PATH_BYTES];
    const char *made[3] = {"", "", ""};
    json_t *trend;
    bool good = true;

    for (int i = 0; i < 3; ++i)
    {
        snprintf(
            path[i], sizeof path[i], "%.3900s/%s", b->options->output,
            ((const char *const[]){
                "results.json", "results.csv", "report.html"})[i]);
        good = good && osdtex_outputs_add(
                           b->options->context, path[i], &made[i]) == OSDTEX_OK;
    }
    good = good && otx_history_append(b->options->history, run);
    trend = otx_history_read(b->options->history);
    good = good && json_dump_file(run, made[0], JSON_INDENT(1)) == 0 &&
           otx_reference_put_csv(metrics, made[1]) &&
           otx_report_page_write(made[2], run, trend) &&
           osdtex_outputs_commit(b->options->context) == OSDTEX_OK;
    if (good)
        say(b, "wrote %s", path[2]);
    else
        snprintf(
            error, OTX_SUITE_ERROR_BYTES,
            "results in %.200s or history %.200s cannot be written",
            b->options->output, b->options->history);
    json_decref(trend);
    json_decref(metrics);
    json_decref(run);
    return good;
}

/* ---- places ---------------------------------------------------------------
 */

/* Whether a path is a folder or in it, be it there yet or not. */
static bool
is_within(const char *path, const char *folder)
{
    char text[OTX_SUITE_PATH_BYTES];
    struct stat wanted, found;
    char *real = NULL, *slash;
    bool within = false;

    if (stat(folder, &wanted) != 0)
        return false;
    snprintf(text, sizeof text, "%s%s", *path == '/' ? "" : "./", path);
    for (real = realpath(text, NULL); !real; real = realpath(text, NULL))
    {
        slash = strrchr(text, '/');
        if (!slash || slash == text)
            return false;
        *slash = '\0';
    }
    for (slash = real; slash && !within; slash = strrchr(real, '/'))
    {
        within = stat(real, &found) == 0 && found.st_dev == wanted.st_dev &&
                 found.st_ino == wanted.st_ino;
        slash = strrchr(real, '/');
        if (!slash || slash == real)
            break;
        *slash = '\0';
    }
    free(real);
    return within;
}

static bool
is_utf8(const char *text)
{
    json_t *string = json_string(text);

    json_decref(string);
    return string != NULL;
}

/* Results must not get among the references, nor the history into the table. */
static bool
places_are_fine(const otx_regress_options *o, char *error)
{
    char path[2][OTX_SUITE_PATH_BYTES];
    const char *what = NULL, *where = o->output;

    for (int i = 0; i < 2; ++i)
        snprintf(
            path[i], sizeof path[i], "%.3900s/%s", o->folder,
            i == 0 ? "reference" : "table.json");
    if (!is_utf8(o->folder) || !is_utf8(o->output))
        what = "is not UTF-8, as results are";
    else if (is_within(o->output, path[0]))
        what = "is within the references of the suite";
    else if (is_within(o->history, path[0]) || is_within(o->history, path[1]))
    {
        what = "is a file of the suite, and no history";
        where = o->history;
    }
    if (what)
        snprintf(
            error, OTX_SUITE_ERROR_BYTES, "'%.300s' %s; choose another place",
            where, what);
    return !what;
}

otx_regress_end
otx_regress_run(
    const otx_regress_options *options, char error[OTX_SUITE_ERROR_BYTES])
{
    bench b = {.options = options};
    otx_regress_end end = OTX_REGRESS_REFUSED;
    json_t *results;

    error[0] = '\0';
    if (!places_are_fine(options, error))
        return OTX_REGRESS_REFUSED;
    otx_reference_machine(b.machine);
    if (!otx_suite_read(options->folder, &b.suite, error))
        return OTX_REGRESS_REFUSED;
    results = json_object();
    if (names_are_known(&b, error) &&
        otx_reference_read(options->folder, &b.reference, error))
    {
        end = run_cases(&b, results, error);
        if (end <= OTX_REGRESS_DIFFERS && !write_results(&b, results, error))
            end = OTX_REGRESS_UNWRITTEN;
        otx_reference_free(&b.reference);
    }
    json_decref(results);
    otx_suite_free(&b.suite);
    return end;
}
