/* reference.c -- references, read and written. */
#include "regress/reference.h"

#include <errno.h>
#include <gnu/libc-version.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    LINE_BYTES = 1024
};

void
otx_reference_machine(char text[OTX_REFERENCE_MACHINE_BYTES])
{
    const char *set = "";

#if defined(__x86_64__)
    __builtin_cpu_init();
    set = __builtin_cpu_supports("avx512f") ? "x86_64 avx512"
          : __builtin_cpu_supports("avx2")  ? "x86_64 avx2"
                                            : "x86_64";
#elif defined(__aarch64__)
    set = "aarch64";
#endif
    snprintf(
        text, OTX_REFERENCE_MACHINE_BYTES, "%s, glibc %s", set,
        gnu_get_libc_version());
}

static bool
fail(char *error, const char *path)
{
    snprintf(
        error, OTX_SUITE_ERROR_BYTES, "%.400s: %.80s", path, strerror(errno));
    return false;
}

/* Cut when too long: then it is no file, and is reported as one. */
void
otx_reference_picture(
    const otx_reference *reference, const char *name,
    char path[OTX_SUITE_PATH_BYTES])
{
    snprintf(
        path, OTX_SUITE_PATH_BYTES, "%.3800s/%.200s.png", reference->folder,
        name);
}

/* case,metric,value */
static void
take_line(json_t *metrics, char *line)
{
    char *metric = strchr(line, ',');
    char *value = metric ? strchr(metric + 1, ',') : NULL;
    json_t *of_case;

    if (!value)
        return;
    *metric++ = '\0';
    *value++ = '\0';
    of_case = json_object_get(metrics, line);
    if (!of_case)
    {
        of_case = json_object();
        json_object_set_new(metrics, line, of_case);
    }
    json_object_set_new(of_case, metric, json_real(strtod(value, NULL)));
}

static bool
read_csv(json_t *metrics, const char *path, char *error)
{
    char line[LINE_BYTES];
    FILE *in = fopen(path, "r");
    bool whole;

    if (!in)
        return errno == ENOENT || fail(error, path);
    if (!fgets(line, sizeof line, in)) /* the title */
        line[0] = '\0';
    while (fgets(line, sizeof line, in))
        take_line(metrics, line);
    whole = !ferror(in);
    fclose(in);
    return whole || fail(error, path);
}

static void
put_lines(FILE *out, const json_t *metrics)
{
    const char *name, *metric;
    json_t *of_case, *value;

    fprintf(out, "case,metric,value\n");
    json_object_foreach((json_t *)(uintptr_t)metrics, name, of_case)
    {
        json_object_foreach(of_case, metric, value)
        {
            fprintf(
                out, "%s,%s,%.9g\n", name, metric, json_number_value(value));
        }
    }
}

/* Objects keep the order in which they were filled, so a sorted text read
 * back is in order. */
bool
otx_reference_put_csv(const json_t *metrics, const char *path)
{
    char *sorted = json_dumps(metrics, JSON_SORT_KEYS);
    json_t *in_order = sorted ? json_loads(sorted, 0, NULL) : NULL;
    FILE *out = in_order ? fopen(path, "w") : NULL;
    bool whole = out != NULL;

    if (out)
    {
        put_lines(out, in_order);
        whole = !ferror(out);
        whole = fclose(out) == 0 && whole;
    }
    json_decref(in_order);
    free(sorted);
    return whole;
}

static bool
read_exact(otx_reference *reference, const char *path, char *error)
{
    json_error_t wrong;

    if (access(path, F_OK) != 0)
        return (reference->exact = json_object()) != NULL;
    reference->exact = json_load_file(path, 0, &wrong);
    if (reference->exact)
        return true;
    snprintf(
        error, OTX_SUITE_ERROR_BYTES, "%.300s:%d: %.150s", path, wrong.line,
        wrong.text);
    return false;
}

bool
otx_reference_read(
    const char *suite_folder, otx_reference *out,
    char error[OTX_SUITE_ERROR_BYTES])
{
    char exact[OTX_SUITE_PATH_BYTES], csv[OTX_SUITE_PATH_BYTES];

    *out = (otx_reference){.metrics = json_object()};
    snprintf(
        out->folder, sizeof out->folder, "%.3800s/reference", suite_folder);
    snprintf(exact, sizeof exact, "%.3900s/exact.json", out->folder);
    snprintf(csv, sizeof csv, "%.3900s/results.csv", out->folder);
    if (read_exact(out, exact, error) && read_csv(out->metrics, csv, error))
        return true;
    otx_reference_free(out);
    return false;
}

/* Written beside and renamed: a reader sees the old text or the new one. */
static bool
put_beside(
    const otx_reference *reference, const char *name, bool is_csv, char *error)
{
    char path[OTX_SUITE_PATH_BYTES], beside[OTX_SUITE_PATH_BYTES];
    bool good;

    snprintf(path, sizeof path, "%.3900s/%s", reference->folder, name);
    snprintf(beside, sizeof beside, "%.4000s.new", path);
    good = is_csv ? otx_reference_put_csv(reference->metrics, beside)
                  : json_dump_file(
                        reference->exact, beside,
                        JSON_INDENT(1) | JSON_SORT_KEYS) == 0;
    return (good && rename(beside, path) == 0) || fail(error, path);
}

bool
otx_reference_write(
    const otx_reference *reference, char error[OTX_SUITE_ERROR_BYTES])
{
    if (mkdir(reference->folder, 0777) != 0 && errno != EEXIST)
        return fail(error, reference->folder);
    return put_beside(reference, "exact.json", false, error) &&
           put_beside(reference, "results.csv", true, error);
}

bool
otx_reference_copy(const char *from, const char *to)
{
    char buffer[1 << 14], beside[OTX_SUITE_PATH_BYTES];
    FILE *in = fopen(from, "rb"), *out;
    size_t bytes;
    bool whole;

    snprintf(beside, sizeof beside, "%.4000s.new", to);
    out = in ? fopen(beside, "wb") : NULL;
    whole = out != NULL;
    while (whole && (bytes = fread(buffer, 1, sizeof buffer, in)) > 0)
        whole = fwrite(buffer, 1, bytes, out) == bytes;
    whole = whole && !ferror(in);
    if (in)
        fclose(in);
    if (out && fclose(out) != 0)
        whole = false;
    return whole && rename(beside, to) == 0;
}

void
otx_reference_free(otx_reference *reference)
{
    json_decref(reference->exact);
    json_decref(reference->metrics);
    *reference = (otx_reference){0};
}
