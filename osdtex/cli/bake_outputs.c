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
    KIND_COUNT = 7
};

/* Those of the extras have the place of their bit. */
static const char *const KINDS[KIND_COUNT] = {
    "", "_patch", "_uv", "_stretch", "_seam", "_source", "_slice"};

/* What is asked for. */
typedef struct request
{
    const osdtex_bake_options *options;
    uint32_t maps; /* bit k: that of kind k */
    osdtex_texture_type type;
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
            suffix, sizeof suffix, "_%s.%ld%s", osdtex_map_kind_name(kind),
            tile, osdtex_texture_extension(asked->type, kind));
        if ((asked->maps & 1u << kind) && !is_there(cage, suffix, hash))
            return false;
    }

    for (int kind = 0; kind < KIND_COUNT; ++kind)
    {
        if (kind > 0 && !(options->extras & 1u << (kind - 1)))
            continue;
        snprintf(
            suffix, sizeof suffix, "%s.%ld%s", KINDS[kind], tile,
            kind == 0 ? osdtex_texture_extension(asked->type, -1) : ".exr");
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
    osdtex_texture_type type, const char hash[OSDTEX_HASH_BYTES])
{
    const request asked = {options, maps, type};
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

/* The number of the tile in ".1001.exr", for that extension; 0 none. */
static long
tile_of(const char *text, const char *extension)
{
    const size_t digits = *text == '.' ? strspn(text + 1, "0123456789") : 0;
    const bool is_tile =
        digits >= 4 && strcasecmp(text + 1 + digits, extension) == 0;

    return is_tile ? strtol(text + 1, NULL, 10) : 0;
}

static bool
is_asked_for(const osdtex_bake_options *options, long tile)
{
    return tile > 0 && (options->udim == 0 || tile == options->udim);
}

static const char *
base_of(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash ? slash + 1 : path;
}

/* Whether "_NAME.1001.exr" is of a kind called that. */
static bool
is_tile_of(
    const osdtex_bake_options *options, const char *text, const char *name,
    const char *extension)
{
    return *text == '_' && strncasecmp(text + 1, name, strlen(name)) == 0 &&
           is_asked_for(options, tile_of(text + 1 + strlen(name), extension));
}

/* Whether a file beside the cage has the name of a texture that the bake is
 * asked for. */
static bool
is_texture(const char *cage, const request *asked, const char *file)
{
    const osdtex_bake_options *options = asked->options;
    const size_t size = strlen(base_of(cage)) - strlen("_cage.obj");

    if (strncasecmp(file, base_of(cage), size) != 0)
        return false;
    file += size;
    if (is_asked_for(
            options,
            tile_of(file, osdtex_texture_extension(asked->type, -1))) ||
        (options->preview_png && is_asked_for(options, tile_of(file, ".png"))))
        return true;
    for (int kind = 1; kind < KIND_COUNT; ++kind)
        if (options->extras & 1u << (kind - 1) &&
            is_tile_of(options, file, KINDS[kind] + 1, ".exr"))
            return true;
    for (int kind = 0; kind < OSDTEX_MAP_KINDS; ++kind)
        if (asked->maps & 1u << kind &&
            is_tile_of(
                options, file, osdtex_map_kind_name(kind),
                osdtex_texture_extension(asked->type, kind)))
            return true;
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
add_textures(otx_path_list *list, const char *cage, const request *asked)
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
        if (is_texture(cage, asked, entries[i]->d_name))
            add(list, cage, entries[i]->d_name + base);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    free(folder);
}

void
otx_bake_outputs_list(
    const char *cage, const osdtex_bake_options *options, uint32_t maps,
    osdtex_texture_type type, otx_path_list *out)
{
    const request asked = {options, maps, type};

    add(out, cage, "_cage.obj");
    add(out, cage, "_cage.mtl");
    add(out, cage, ".usda");
    add(out, cage, ".mtlx");
    if (options->preview_png)
        add(out, cage, "_preview.mtl");
    add_textures(out, cage, &asked);
}

bool
otx_bake_outputs_may_be(
    const char *cage, const osdtex_bake_options *options, uint32_t maps,
    osdtex_texture_type type, const char *path)
{
    const request asked = {options, maps, type};
    otx_path_list pair = {0};
    bool same;

    if (!path || !is_texture(cage, &asked, base_of(path)))
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
