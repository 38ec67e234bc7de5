/* bake_outputs.c -- looking for them by the tiles that the cage names. */
#include "cli/bake_outputs.h"

#include "cli/up_to_date.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    SUFFIX_BYTES = 64,
    KIND_COUNT = 5
};

/* Those of the extras have the place of their bit. */
static const char *const KINDS[KIND_COUNT] = {
    "", "_patch", "_uv", "_stretch", "_seam"};

/* FOLDER/NAMEsuffix; NULL when memory is out. */
static char *
beside(const char *cage, const char *suffix)
{
    const size_t base = strlen(cage) - strlen("_cage.obj");
    char *path = malloc(base + strlen(suffix) + 1);

    if (path)
    {
        memcpy(path, cage, base);
        strcpy(path + base, suffix);
    }
    return path;
}

/* Whether a file is there and, where a hash is given, carries it. */
static bool
is_there(const char *cage, const char *suffix, const char *hash)
{
    char *path = beside(cage, suffix);
    const bool found = path && (hash ? otx_up_to_date_check(path, hash)
                                     : access(path, F_OK) == 0);

    free(path);
    return found;
}

/* All textures of a tile. */
static bool
tile_is_done(
    const char *cage, const osdtex_bake_options *options, long tile,
    const char *hash)
{
    char suffix[SUFFIX_BYTES];

    for (int kind = 0; kind < KIND_COUNT; ++kind)
    {
        if (kind > 0 && !(options->extras & 1u << (kind - 1)))
            continue;
        snprintf(suffix, sizeof suffix, "%s.%ld.exr", KINDS[kind], tile);
        if (!is_there(cage, suffix, hash))
            return false;
    }
    snprintf(suffix, sizeof suffix, ".%ld.png", tile);
    return !options->preview_png || is_there(cage, suffix, NULL);
}

/* The tiles that a line lists, all of them done and at least one. */
static bool
tiles_are_done(
    const char *cage, const osdtex_bake_options *options, const char *line,
    const char *hash)
{
    char *end;
    long tile = strtol(line, &end, 10);
    bool found = false;

    for (; end != line; tile = strtol(line, &end, 10))
    {
        if (!tile_is_done(cage, options, tile, hash))
            return false;
        found = true;
        line = end;
    }
    return found;
}

/* The same for the comment at the head of the cage. */
static bool
named_tiles_are_done(
    const char *cage, const osdtex_bake_options *options, const char *hash)
{
    static const char LEAD[] = "# " OTX_BAKE_OUTPUTS_TILES;
    FILE *file = fopen(cage, "rb");
    size_t bytes = 0;
    char *line = NULL;
    bool done = false;

    while (file && getline(&line, &bytes, file) > 0 && line[0] == '#')
    {
        if (strncmp(line, LEAD, strlen(LEAD)) != 0)
            continue;
        done = tiles_are_done(cage, options, line + strlen(LEAD), hash);
        break;
    }
    free(line);
    if (file)
        fclose(file);
    return done;
}

bool
otx_bake_outputs_are_done(
    const char *cage, const osdtex_bake_options *options,
    const char hash[OSDTEX_HASH_BYTES])
{
    return is_there(cage, "_cage.obj", options->udim ? NULL : hash) &&
           is_there(cage, "_cage.mtl", NULL) &&
           is_there(cage, ".usda", options->udim ? NULL : hash) &&
           is_there(cage, ".mtlx", NULL) &&
           (!options->preview_png || is_there(cage, "_preview.mtl", NULL)) &&
           (options->udim ? tile_is_done(cage, options, options->udim, hash)
                          : named_tiles_are_done(cage, options, hash));
}

/* -- inputs that look like outputs ---------------------------------------- */

/* Whether two paths are of one folder. */
static bool
share_folder(const char *a, const char *b)
{
    const char *const paths[2] = {a, b};
    struct stat found[2];

    for (int k = 0; k < 2; ++k)
    {
        const char *slash = strrchr(paths[k], '/');
        char *folder = slash ? strndup(paths[k], (size_t)(slash - paths[k]) + 1)
                             : strdup(".");
        const bool fine = folder && stat(folder, &found[k]) == 0;

        free(folder);
        if (!fine)
            return false;
    }
    return found[0].st_dev == found[1].st_dev &&
           found[0].st_ino == found[1].st_ino;
}

/* ".1001.exr" or ".<UDIM>.exr", or the like of a PNG. */
static bool
is_tile(const char *text)
{
    const size_t number = *text == '.' ? strspn(text + 1, "0123456789") : 0;
    const char *end = text + 1 + number;

    if (*text == '.' && text[1] == '<')
        end = strchr(text, '>') ? strchr(text, '>') + 1 : "";
    else if (number != 4)
        return false;
    return strcmp(end, ".exr") == 0 || strcmp(end, ".png") == 0;
}

bool
otx_bake_outputs_may_replace(const char *cage, const char *path)
{
    const char *slash = strrchr(cage, '/');
    const char *name = slash ? slash + 1 : cage;
    const size_t size = strlen(name) - strlen("_cage.obj");
    const char *file;

    if (!path || !share_folder(cage, path))
        return false;
    slash = strrchr(path, '/');
    file = slash ? slash + 1 : path;
    if (strncmp(file, name, size) != 0)
        return false;
    for (int kind = 0; kind < KIND_COUNT; ++kind)
        if (strncmp(file + size, KINDS[kind], strlen(KINDS[kind])) == 0 &&
            is_tile(file + size + strlen(KINDS[kind])))
            return true;
    return false;
}
