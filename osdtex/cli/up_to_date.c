/* up_to_date.c -- hashing jobs, finding the hash again. */
#include "cli/up_to_date.h"

#include "cli/guard.h"
#include "cli/value.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Flags that say how the work is done and where its results go, not what they
 * are: all others are part of the job. --colorconfig is, by what it holds. */
static const otx_flag_id apart[] = {
    OTX_FLAG_OUTPUT,      OTX_FLAG_PREVIEW, OTX_FLAG_JSON_REPORT,
    OTX_FLAG_SAVE,        OTX_FLAG_THREADS, OTX_FLAG_MEMORY_LIMIT,
    OTX_FLAG_COLORCONFIG, OTX_FLAG_DRY_RUN, OTX_FLAG_UPDATE,
    OTX_FLAG_REPLACE,     OTX_FLAG_VERBOSE, OTX_FLAG_QUIET,
    OTX_FLAG_HELP,        OTX_FLAG_VERSION, OTX_FLAG_UDIM};

bool
otx_up_to_date_is_part(otx_flag_id id)
{
    for (size_t i = 0; i < sizeof apart / sizeof apart[0]; ++i)
        if (apart[i] == id)
            return false;
    return true;
}

static bool
hash_file(const char *path, char text[OSDTEX_HASH_BYTES])
{
    struct stat status;
    char *bytes;
    size_t size;
    FILE *file;
    bool whole;

    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode))
        return false;
    size = (size_t)status.st_size;
    file = fopen(path, "rb");
    bytes = malloc(size + 1);
    whole = file && bytes && fread(bytes, 1, size, file) == size;
    if (whole)
        osdtex_hash(bytes, size, text);
    free(bytes);
    if (file)
        fclose(file);
    return whole;
}

/* Files by their bytes and names, in the order of the command line. */
static bool
put_files(FILE *out, osdtex_context *context, const otx_flag_values *values)
{
    otx_path_list files = {0};
    char hash[OSDTEX_HASH_BYTES];
    bool known = otx_guard_named(context, values, false, &files) == OSDTEX_OK &&
                 !files.out_of_memory;

    for (int i = 0; known && i < files.count; ++i)
    {
        const char *slash = strrchr(files.items[i].name, '/');

        known = hash_file(files.items[i].name, hash);
        fprintf(
            out, "file %s %s\n", hash, slash ? slash + 1 : files.items[i].name);
    }
    otx_path_list_free(&files);
    return known;
}

/* Where results go does not count, but for what its suffix says of textures. */
static void
put_suffix(FILE *out, const otx_flag_values *values)
{
    static const char *const suffixes[] = {".exr", ".png", ".tif", ".jpg"};

    for (int i = 0; values->text[OTX_FLAG_OUTPUT] && i < 4; ++i)
        if (otx_value_has_extension(values->text[OTX_FLAG_OUTPUT], suffixes[i]))
            fprintf(out, "textures %s\n", suffixes[i]);
}

static void
put_flags(FILE *out, const otx_flag_values *values)
{
    put_suffix(out, values);
    for (const otx_flag_id *id = values->ids; *id != OTX_FLAG_COUNT; ++id)
        if (values->text[*id] && otx_up_to_date_is_part(*id))
            fprintf(
                out, "--%s %s\n", otx_flag_at(*id)->name, values->text[*id]);
    for (int i = 0; i < values->setting_count; ++i)
        fprintf(
            out, "--set %s=%s\n", values->settings[i].key,
            values->settings[i].value);
    for (int i = 0; i < values->also_count; ++i)
        fprintf(out, "--also %s\n", values->also[i]);
    for (int i = 0; i < values->edge_count; ++i)
        fprintf(out, "--edge-template %s\n", values->edges[i]);
}

/* The job in words. */
static bool
put_job(FILE *out, osdtex_context *context, const otx_flag_values *values)
{
    char colour[OSDTEX_HASH_BYTES];

    fprintf(out, "osdtex %s\n", osdtex_build());
    if (!put_files(out, context, values) ||
        osdtex_colour_hash(context, colour) != OSDTEX_OK)
        return false;
    fprintf(out, "colour %s\n", colour);
    /* A file rule may look at all of the exemplar's name. */
    fprintf(
        out, "exemplar %s\n", values->operands[1] ? values->operands[1] : "");
    put_flags(out, values);
    return true;
}

bool
otx_up_to_date_job(
    osdtex_context *context, const otx_flag_values *values,
    char job[OSDTEX_HASH_BYTES])
{
    char *words = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&words, &length);
    bool known = out && put_job(out, context, values);

    if (out && fclose(out) != 0)
        known = false;
    if (known)
        osdtex_hash(words, length, job);
    free(words);
    return known;
}

bool
otx_up_to_date_check(const char *path, const char *job)
{
    osdtex_output_mark mark;

    osdtex_outputs_inspect(path, false, &mark);
    if (!mark.is_ours || (job && strcmp(mark.job, job) != 0))
        return false;
    osdtex_outputs_inspect(path, true, &mark);
    return mark.is_whole;
}
