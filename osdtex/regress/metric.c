/* metric.c -- which figures, taken and judged. */
#include "regress/metric.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* A figure may move by `relative` of its reference plus `absolute`. Quality is
 * deterministic on one machine class and may differ a little between them; it
 * is held both ways, since a better figure is a new reference, too. Time and
 * memory may only not grow. */
typedef struct rule
{
    const char *name;        /* ending in "." : of all that begin so */
    const char *group, *key; /* in the report; NULL: taken otherwise */
    double unit;
    double relative, absolute;
    bool may_fall;
} rule;

static const rule rules[] = {
    {"seam_energy", "seams", "energy", 1.0, 0.02, 1e-6, false},
    {"seam_visible_share", "seams", "visible_share", 1.0, 0.02, 1e-3, false},
    {"flips", "distortion", "flips", 1.0, 0.0, 0.0, false},
    {"folds", "distortion", "folds", 1.0, 0.0, 0.0, false},
    {"uncovered", "distortion", "uncovered", 1.0, 0.0, 0.0, false},
    {"stretch_mean", "distortion", "stretch_l2_mean", 1.0, 0.01, 0.0, false},
    {"stretch_p95", "distortion", "stretch_l2_p95", 1.0, 0.02, 0.0, false},
    {"patches", "mapping", "patches", 1.0, 0.02, 0.0, false},
    {"coverage", "exemplar", "coverage", 1.0, 0.02, 0.0, false},
    {"memory.heap_mib", "memory", "peak_bytes", 1.0 / 1048576, 0.10, 0.5, true},
    {"memory.resident_mib", "memory", "peak_resident_bytes", 1.0 / 1048576,
     0.25, 16.0, true},
    {"time.", NULL, NULL, 1.0, 0.5, 0.5, true},
};

enum
{
    RULE_COUNT = sizeof rules / sizeof rules[0],
    NAME_BYTES = 64
};

bool
otx_metric_is_time(const char *name)
{
    return strncmp(name, "time.", 5) == 0;
}

static void
put_time(json_t *values, const char *stage, double seconds, double calibration)
{
    char name[NAME_BYTES];

    snprintf(name, sizeof name, "time.%s", stage);
    json_object_set_new(values, name, json_real(seconds / calibration));
}

/* Wall seconds of all calls; more than 0. */
static double
sum_of(json_t *seconds)
{
    double sum = 1e-9;
    const char *call;
    json_t *value;

    json_object_foreach(seconds, call, value)
    {
        sum += json_number_value(value); /* 0 for what is no number */
    }
    return sum;
}

/* The report has wall seconds, which grow with whatever else the machine does.
 * A stage is given its share of the CPU seconds instead. */
json_t *
otx_metric_take(const json_t *report, double cpu, double calibration)
{
    json_t *seconds = json_object_get(report, "seconds");
    json_t *values = json_object(), *value;
    double wall;
    const char *stage;

    for (int i = 0; i < RULE_COUNT; ++i)
    {
        const rule *r = &rules[i];

        value = r->group
                    ? json_object_get(json_object_get(report, r->group), r->key)
                    : NULL;
        if (json_is_number(value))
            json_object_set_new(
                values, r->name, json_real(json_number_value(value) * r->unit));
    }
    if (!(calibration > 0.0))
        return values;
    put_time(values, "cpu", cpu, calibration);
    wall = sum_of(seconds);
    json_object_foreach(json_object_get(seconds, "map_stages"), stage, value)
    {
        put_time(
            values, stage, cpu * json_number_value(value) / wall, calibration);
    }
    return values;
}

void
otx_metric_keep_faster(json_t *into, const json_t *other)
{
    const char *name;
    json_t *value;

    json_object_foreach(into, name, value)
    {
        const json_t *second = json_object_get(other, name);

        if (otx_metric_is_time(name) && json_is_number(second))
            json_real_set(
                value,
                fmin(json_number_value(value), json_number_value(second)));
    }
}

/* ---------------------------------------------------------------------- */

static double
cpu_now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Some of what textures cost: sums over arrays that fit the cache, and reads
 * all over an array that does not. About a tenth of a second. */
static float
work(float *cells, uint32_t count)
{
    float sum = 0.0f;
    uint32_t at = 1;

    for (uint32_t i = 0; i < count; ++i)
        cells[i] = (float)(i % 251) * 0.004f;
    for (int round = 0; round < 1500; ++round)
        for (uint32_t i = 1; i < 16384; ++i)
            cells[i] = 0.5f * cells[i] + 0.25f * (cells[i - 1] + 1.0f);
    for (uint32_t i = 0; i < 3 * count; ++i)
    {
        at = at * 1664525u + 1013904223u;
        sum += cells[at % count];
    }
    return sum;
}

double
otx_metric_calibrate(void)
{
    const uint32_t count = 1u << 22;
    float *cells = malloc(count * sizeof *cells);
    volatile float sink;
    double least = 0.0;

    if (!cells)
        return 0.0;
    for (int i = 0; i < 3; ++i)
    {
        const double begun = cpu_now();
        double seconds;

        sink = work(cells, count);
        (void)sink;
        seconds = cpu_now() - begun;
        least = i == 0 ? seconds : fmin(least, seconds);
    }
    free(cells);
    return least;
}

/* ---------------------------------------------------------------------- */

static rule
rule_of(const char *name, const json_t *tolerances)
{
    /* A figure that no rule knows comes from another version: hold it. */
    rule found = {.name = name};
    const json_t *given;

    for (int i = 0; i < RULE_COUNT; ++i)
    {
        const size_t length = strlen(rules[i].name);

        if (strcmp(name, rules[i].name) == 0 ||
            (rules[i].name[length - 1] == '.' &&
             strncmp(name, rules[i].name, length) == 0))
            found = rules[i];
    }
    given = json_object_get(tolerances, name);
    if (!given && otx_metric_is_time(name))
        given = json_object_get(tolerances, "time.*");
    if (json_is_number(given))
        found.relative = json_number_value(given);
    return found;
}

static bool
is_within(const rule *r, double value, double reference)
{
    const double room = r->relative * fabs(reference) + r->absolute +
                        1e-7 * fabs(reference); /* digits of the CSV */

    return value <= reference + room &&
           (r->may_fall || value >= reference - room);
}

static json_t *
allowed(const rule *r)
{
    const char *sign = r->may_fall ? "+" : "±";

    if (r->relative == 0.0 && r->absolute == 0.0)
        return json_string("equal");
    if (r->absolute == 0.0)
        return json_sprintf("%s%g %%", sign, 100.0 * r->relative);
    if (r->relative == 0.0)
        return json_sprintf("%s%g", sign, r->absolute);
    return json_sprintf(
        "%s%g %% %s%g", sign, 100.0 * r->relative, sign, r->absolute);
}

static json_t *
judge(
    const char *name, json_t *value, json_t *reference,
    const json_t *tolerances)
{
    const rule r = rule_of(name, tolerances);
    const char *status = "missing";

    if (reference)
        status = value && is_within(
                              &r, json_number_value(value),
                              json_number_value(reference))
                     ? "pass"
                     : "fail";
    return json_pack(
        "{s:s,s:O?,s:O?,s:o,s:s}", "name", name, "value", value, "reference",
        reference, "allowed", allowed(&r), "status", status);
}

json_t *
otx_metric_judge(
    const json_t *values, const json_t *reference, const json_t *tolerances)
{
    json_t *rows = json_array(), *value;
    const char *name;

    json_object_foreach((json_t *)(uintptr_t)values, name, value)
    {
        json_array_append_new(
            rows,
            judge(name, value, json_object_get(reference, name), tolerances));
    }
    json_object_foreach((json_t *)(uintptr_t)reference, name, value)
    {
        if (!json_object_get(values, name))
            json_array_append_new(rows, judge(name, NULL, value, tolerances));
    }
    return rows;
}
