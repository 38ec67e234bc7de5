/* bake_outputs.c -- looking for them by the tiles that the cage names. */
#include "cli/bake_outputs.h"

#include "cli/up_to_date.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum
{
    SUFFIX_BYTES = 64,
    KIND_COUNT = 6
};

/* Those of the extras have the place of their bit. */
static const char *const KINDS[KIND_COUNT] = {
    "", "_patch", "_uv", "_stretch", "_seam", "_source"};

/* What is asked for. */
typedef struct request
{
    const osdtex_bake_options *options;
    uint32_t maps;         /* bit k: that of kind k */
    const char *extension; /* of the colour */
} request;

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

/* Whether a file is there and whole and, where a hash is given, carries it. */
static bool
is_there(const char *cage, const char *suffix, const char *hash)
{
    char *path = beside(cage, suffix);
    const bool found = path && otx_up_to_date_check(path, hash);

    free(path);
    return found;
}

/* All textures of a tile. */
static bool
tile_is_done(
    const char *cage, const request *asked, long tile, const char *hash)
{
    const osdtex_bake_options *options = asked->options;
    char suffix[SUFFIX_BYTES];

    for (int kind = 0; kind < OSDTEX_MAP_KINDS; ++kind)
    {
        snprintf(
            suffix, sizeof suffix, "_%s.%ld.exr", osdtex_map_kind_name(kind),
            tile);
        if ((asked->maps & 1u << kind) && !is_there(cage, suffix, hash))
            return false;
    }

    for (int kind = 0; kind < KIND_COUNT; ++kind)
    {
        if (kind > 0 && !(options->extras & 1u << (kind - 1)))
            continue;
        snprintf(
            suffix, sizeof suffix, "%s.%ld%s", KINDS[kind], tile,
            kind == 0 ? asked->extension : ".exr");
        if (!is_there(cage, suffix, hash))
            return false;
    }
    snprintf(suffix, sizeof suffix, ".%ld.png", tile);
    return !options->preview_png || is_there(cage, suffix, hash);
}

/* The tiles that a line lists, all of them done and at least one. */
static bool
tiles_are_done(
    const char *cage, const request *asked, const char *line, const char *hash)
{
    char *end;
    long tile = strtol(line, &end, 10);
    bool found = false;

    for (; end != line; tile = strtol(line, &end, 10))
    {
        if (!tile_is_done(cage, asked, tile, hash))
            return false;
        found = true;
        line = end;
    }
    return found;
}

/* The same for the comment at the head of the cage. */
static bool
named_tiles_are_done(const char *cage, const request *asked, const char *hash)
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
        done = tiles_are_done(cage, asked, line + strlen(LEAD), hash);
        break;
    }
    free(line);
    if (file)
        fclose(file);
    return done;
}

bool
otx_bake_outputs_are_done(
    const char *cage, const osdtex_bake_options *options, uint32_t maps,
    const char *extension, const char hash[OSDTEX_HASH_BYTES])
{
    const request asked = {options, maps, extension};
    const char *of_all = options->udim ? NULL : hash;

    return is_there(cage, "_cage.obj", of_all) &&
           is_there(cage, "_cage.mtl", of_all) &&
           is_there(cage, ".usda", of_all) && is_there(cage, ".mtlx", of_all) &&
           (!options->preview_png || is_there(cage, "_preview.mtl", of_all)) &&
           (options->udim ? tile_is_done(cage, &asked, options->udim, hash)
                          : named_tiles_are_done(cage, &asked, hash));
}

/* ---- names ----------------------------------------------------------------
 */

/* ".1001.exr", or the like of a PNG. */
static bool
is_tile(const char *text)
{
    const size_t number = *text == '.' ? strspn(text + 1, "0123456789") : 0;

    if (number < 4)
        return false;
    text += 1 + number;
    return strcasecmp(text, ".exr") == 0 || strcasecmp(text, ".png") == 0;
}

static const char *
base_of(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash ? slash + 1 : path;
}

/* Whether a file beside the cage is called as a texture of a bake is, be it
 * asked for this time or not. */
static bool
is_texture(const char *cage, const char *file)
{
    const size_t size = strlen(base_of(cage)) - strlen("_cage.obj");

    if (strncasecmp(file, base_of(cage), size) != 0)
        return false;
    file += size;
    for (int kind = 0; kind < KIND_COUNT; ++kind)
    {
        const size_t length = strlen(KINDS[kind]);

        if (strncasecmp(file, KINDS[kind], length) == 0 &&
            is_tile(file + length))
            return true;
    }
    for (int kind = 0; *file == '_' && kind < OSDTEX_MAP_KINDS; ++kind)
    {
        const char *name = osdtex_map_kind_name(kind);

        if (strncasecmp(file + 1, name, strlen(name)) == 0 &&
            is_tile(file + 1 + strlen(name)))
            return true;
    }
    return false;
}

static void
add(otx_path_list *list, const char *cage, const char *suffix)
{
    char *path = beside(cage, suffix);

    list->out_of_memory |= !path;
    otx_path_list_add(list, path);
    free(path);
}

/* Which tiles there will be is not known yet; what matters is which are there.
 */
static void
add_textures(otx_path_list *list, const char *cage)
{
    char *folder = strndup(cage, (size_t)(base_of(cage) - cage));
    const size_t base = strlen(base_of(cage)) - strlen("_cage.obj");
    struct dirent **entries = NULL;
    const int count =
        folder ? scandir(*folder ? folder : ".", &entries, NULL, alphasort)
               : -1;

    list->out_of_memory |= !folder;
    for (int i = 0; i < count; ++i)
    {
        if (is_texture(cage, entries[i]->d_name))
            add(list, cage, entries[i]->d_name + base);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    free(folder);
}

void
otx_bake_outputs_list(
    const char *cage, const osdtex_bake_options *options, otx_path_list *out)
{
    add(out, cage, "_cage.obj");
    add(out, cage, "_cage.mtl");
    add(out, cage, ".usda");
    add(out, cage, ".mtlx");
    if (options->preview_png)
        add(out, cage, "_preview.mtl");
    add_textures(out, cage);
}

bool
otx_bake_outputs_may_be(const char *cage, const char *path)
{
    otx_path_list pair = {0};
    bool same;

    if (!path || !is_texture(cage, base_of(path)))
        return false;
    otx_path_list_add(&pair, cage);
    otx_path_list_add(&pair, path);
    same = pair.count == 2 && !strchr(pair.items[0].rest, '/') &&
           !strchr(pair.items[1].rest, '/') &&
           pair.items[0].folder_device == pair.items[1].folder_device &&
           pair.items[0].folder_inode == pair.items[1].folder_inode;
    otx_path_list_free(&pair);
    return same;
}
