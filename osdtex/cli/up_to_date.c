/* up_to_date.c -- hashing jobs, finding the hash again. */
#include "cli/up_to_date.h"
#include "cli/also_flags.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum
{
    HEAD_BYTES = 4096 /* of the file, where its comments are */
};

/* Flags that change what is written to the OBJ, MTL or EXR. */
static const otx_flag_id matter[] = {
    OTX_FLAG_METHOD,      OTX_FLAG_SCALE,       OTX_FLAG_LEVEL,
    OTX_FLAG_SEED,        OTX_FLAG_FIRST_PATCH, OTX_FLAG_EXEMPLAR_CLASS,
    OTX_FLAG_GENERATORS,  OTX_FLAG_SCHEME,      OTX_FLAG_BOUNDARY,
    OTX_FLAG_FVAR,        OTX_FLAG_FROM,        OTX_FLAG_TO,
    OTX_FLAG_RECEIVER,    OTX_FLAG_MATCH_SPACE, OTX_FLAG_MATCH_IN,
    OTX_FLAG_WRAP,        OTX_FLAG_TILE_LEVEL,  OTX_FLAG_BAKE,
    OTX_FLAG_BAKE_UVS,    OTX_FLAG_RESOLUTION,  OTX_FLAG_TEXELS_PER_UNIT,
    OTX_FLAG_MARGIN,      OTX_FLAG_SEAM_BLEND,  OTX_FLAG_EXTRA,
    OTX_FLAG_PREVIEW_PNG, OTX_FLAG_FOLLOW,      OTX_FLAG_SHOW};

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

static bool
put_file(FILE *out, const char *path)
{
    char hash[OSDTEX_HASH_BYTES];

    if (!hash_file(path, hash))
        return false;
    fprintf(out, "file %s\n", hash);
    return true;
}

/* Whether a name may be that of a mask's tile: anything stands for the token,
 * since which tiles are needed is not known here. */
static bool
may_be_tile(const char *name, const char *pattern)
{
    const size_t head = strcspn(pattern, "<");
    const char *tail = strrchr(pattern, '>');
    const size_t end = tail ? strlen(tail + 1) : 0;
    const size_t size = strlen(name);

    return tail && size >= head + end && strncmp(name, pattern, head) == 0 &&
           strcmp(name + size - end, tail + 1) == 0;
}

/* The files of a folder that may be tiles of a mask, in order of their names.
 */
static bool
put_tiles(FILE *out, const char *folder, const char *pattern)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, NULL, alphasort);
    bool fine = count >= 0;

    for (int i = 0; i < count; ++i)
    {
        char path[PATH_MAX];

        if (may_be_tile(entries[i]->d_name, pattern) &&
            (size_t)snprintf(
                path, sizeof path, "%s/%s", folder, entries[i]->d_name) <
                sizeof path)
        {
            fprintf(out, "tile %s\n", entries[i]->d_name);
            fine &= put_file(out, path);
        }
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    return fine;
}

/* A mask that is one file or, with a token in its name, many. */
static bool
put_mask(FILE *out, const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    char folder[PATH_MAX] = ".";

    if (!strchr(name, '<'))
        return put_file(out, path);
    if (slash && (size_t)(slash - path) >= sizeof folder)
        return false;
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", (int)(name - path), path);
    return put_tiles(out, folder, name);
}

/* The job in words. */
static bool
put_job(FILE *out, const otx_flag_values *values)
{
    const char *config = values->text[OTX_FLAG_COLORCONFIG];

    fprintf(out, "osdtex %s\n", osdtex_build());
    if (!put_file(out, values->operands[0]) ||
        !put_file(out, values->operands[1]))
        return false;
    config = config ? config : getenv("OCIO");
    if (config && *config && !put_file(out, config))
        return false;
    if (values->text[OTX_FLAG_CONSTRAINTS] &&
        !put_file(out, values->text[OTX_FLAG_CONSTRAINTS]))
        return false;
    if (values->text[OTX_FLAG_MASK] &&
        !put_mask(out, values->text[OTX_FLAG_MASK]))
        return false;
    for (int i = 0; i < values->also_count; ++i)
    {
        if (!put_file(out, otx_also_flags_file(values->also[i])))
            return false;
        fprintf(out, "--also %s\n", values->also[i]);
    }
    /* The exemplar's name can choose its colour space, by a file rule. */
    fprintf(out, "exemplar %s\n", values->operands[1]);
    for (size_t i = 0; i < sizeof matter / sizeof matter[0]; ++i)
        if (values->text[matter[i]])
            fprintf(
                out, "--%s %s\n", otx_flag_at(matter[i])->name,
                values->text[matter[i]]);
    for (int i = 0; i < values->setting_count; ++i)
        fprintf(
            out, "--set %s=%s\n", values->settings[i].key,
            values->settings[i].value);
    return true;
}

bool
otx_up_to_date_job(const otx_flag_values *values, char job[OSDTEX_HASH_BYTES])
{
    char *words = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&words, &length);
    bool known = out && put_job(out, values);

    if (out && fclose(out) != 0)
        known = false;
    if (known)
        osdtex_hash(words, length, job);
    free(words);
    return known;
}

bool
otx_up_to_date_check(const char *path, const char job[OSDTEX_HASH_BYTES])
{
    char head[HEAD_BYTES], line[128];
    FILE *file = fopen(path, "rb");
    size_t size;

    if (!file)
        return false;
    size = fread(head, 1, HEAD_BYTES, file);
    fclose(file);
    snprintf(line, sizeof line, OTX_UP_TO_DATE_COMMENT "%s", job);
    return memmem(head, size, line, strlen(line)) != NULL;
}
