/* material_files.c -- the files of a material, told by their names. */
#include "file/material_files.h"

#include "file/mark.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const char STAGE[] = "material";

enum
{
    TOKENS_MAX = 32,
    TOKEN_BYTES = 256,
    WORD_BYTES = 64,
    WORD_TOKENS = 3 /* that a map's word is made of, at most */
};

/* Words as they are without separators and case. Where two files are one map,
 * that of the higher rank is taken. */
static const struct
{
    const char *word;
    otx_material_role role;
    int32_t rank;
} WORDS[] = {
    {"color", OTX_MATERIAL_COLOR, 1},
    {"colour", OTX_MATERIAL_COLOR, 1},
    {"col", OTX_MATERIAL_COLOR, 1},
    {"basecolor", OTX_MATERIAL_COLOR, 1},
    {"basecolour", OTX_MATERIAL_COLOR, 1},
    {"albedo", OTX_MATERIAL_COLOR, 1},
    {"alb", OTX_MATERIAL_COLOR, 1},
    {"diff", OTX_MATERIAL_COLOR, 1},
    {"diffuse", OTX_MATERIAL_COLOR, 1},
    {"normal", OTX_MATERIAL_NORMAL, 1},
    {"normals", OTX_MATERIAL_NORMAL, 1},
    {"norm", OTX_MATERIAL_NORMAL, 1},
    {"nor", OTX_MATERIAL_NORMAL, 1},
    {"nrm", OTX_MATERIAL_NORMAL, 1},
    {"nrm16", OTX_MATERIAL_NORMAL, 2},
    {"normal16", OTX_MATERIAL_NORMAL, 2},
    {"normalgl", OTX_MATERIAL_NORMAL, 3},
    {"normalopengl", OTX_MATERIAL_NORMAL, 3},
    {"norgl", OTX_MATERIAL_NORMAL, 3},
    {"nrmgl", OTX_MATERIAL_NORMAL, 3},
    {"normaldx", OTX_MATERIAL_NORMAL_DX, 1},
    {"normaldirectx", OTX_MATERIAL_NORMAL_DX, 1},
    {"nordx", OTX_MATERIAL_NORMAL_DX, 1},
    {"nrmdx", OTX_MATERIAL_NORMAL_DX, 1},
    {"roughness", OTX_MATERIAL_ROUGHNESS, 1},
    {"rough", OTX_MATERIAL_ROUGHNESS, 1},
    {"rgh", OTX_MATERIAL_ROUGHNESS, 1},
    {"gloss", OTX_MATERIAL_GLOSS, 1},
    {"glossiness", OTX_MATERIAL_GLOSS, 1},
    {"displacement", OTX_MATERIAL_HEIGHT, 1},
    {"disp", OTX_MATERIAL_HEIGHT, 1},
    {"disp16", OTX_MATERIAL_HEIGHT, 2},
    {"height", OTX_MATERIAL_HEIGHT, 1},
    {"height16", OTX_MATERIAL_HEIGHT, 2},
    {"heightmap", OTX_MATERIAL_HEIGHT, 1},
    {"metalness", OTX_MATERIAL_METALNESS, 1},
    {"metallic", OTX_MATERIAL_METALNESS, 1},
    {"metal", OTX_MATERIAL_METALNESS, 1},
    {"ambientocclusion", OTX_MATERIAL_OCCLUSION, 1},
    {"occlusion", OTX_MATERIAL_OCCLUSION, 1},
    {"mixedao", OTX_MATERIAL_OCCLUSION, 1},
    {"ao", OTX_MATERIAL_OCCLUSION, 1},
    {"arm", OTX_MATERIAL_PACKED, 1},
    {"orm", OTX_MATERIAL_PACKED, 1},
    {"occlusionroughnessmetallic", OTX_MATERIAL_PACKED, 1},
};

/* ---- names ----------------------------------------------------------------
 */

typedef struct tokens
{
    char text[TOKEN_BYTES]; /* in small letters, each with a 0 behind it */
    const char *items[TOKENS_MAX];
    int32_t count;
} tokens;

static bool
is_separator(char c)
{
    return c == '-' || c == '_' || c == ' ' || c == '.';
}

/* The last of them, where there are more than can be held. */
static void
split(const char *name, tokens *out)
{
    const size_t length = strlen(name);
    const char *from =
        length < TOKEN_BYTES ? name : name + length - (TOKEN_BYTES - 1);
    char *to = out->text;

    out->count = 0;
    for (bool inside = false; *from; ++from)
    {
        *to++ =
            is_separator(*from) ? '\0' : (char)tolower((unsigned char)*from);
        if (is_separator(*from))
            inside = false;
        else if (!inside)
        {
            if (out->count == TOKENS_MAX)
                memmove(
                    out->items, out->items + 1,
                    (size_t)--out->count * sizeof *out->items);
            out->items[out->count++] = to - 1;
            inside = true;
        }
    }
    *to = '\0';
}

/* "4k", "2048", "8bit", "jpg": how a map is stored, not what it is. */
static bool
is_format(const char *token)
{
    static const char *const words[] = {
        "jpg",     "jpeg",   "png",   "exr",   "tif",   "tiff", "k",
        "bit",     "b",      "x2048", "x4096", "lod0",  "lod",  "var1",
        "highres", "lowres", "raw",   "srgb",  "linear"};
    const char *rest = token + strspn(token, "0123456789");

    if (rest > token && *rest == '\0')
        return true;
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
        if (strcmp(rest, words[i]) == 0)
            return true;
    return false;
}

/* The longest word of the table that the last tokens before `end` are. */
static otx_material_role
find_word(const tokens *t, int32_t end, int32_t *rank)
{
    for (int32_t count = WORD_TOKENS; count > 0; --count)
    {
        char word[WORD_BYTES] = "";

        /* A material needs a name of its own before it, or a prefix. */
        if (count > end)
            continue;
        for (int32_t i = end - count; i < end; ++i)
            strncat(word, t->items[i], sizeof word - strlen(word) - 1);
        for (size_t i = 0; i < sizeof WORDS / sizeof *WORDS; ++i)
            if (strcmp(WORDS[i].word, word) == 0)
            {
                *rank = WORDS[i].rank;
                return WORDS[i].role;
            }
    }
    return OTX_MATERIAL_ROLE_COUNT;
}

otx_material_role
otx_material_files_role(const char *name, int32_t *rank)
{
    otx_material_role role;
    int32_t end;
    tokens t;

    *rank = 0;
    split(name, &t);
    end = t.count;
    while (end > 0 && is_format(t.items[end - 1]))
        --end;
    role = find_word(&t, end, rank);
    /* Behind a resolution stands for which kind of shading the set is: the
     * map's own word is before that. */
    if (end > 2 && is_format(t.items[end - 2]) &&
        (strcmp(t.items[end - 1], "metalness") == 0 ||
         strcmp(t.items[end - 1], "specular") == 0))
    {
        int32_t inner = end - 1, inner_rank;
        otx_material_role before;

        while (inner > 0 && is_format(t.items[inner - 1]))
            --inner;
        before = find_word(&t, inner, &inner_rank);
        if (before != OTX_MATERIAL_ROLE_COUNT)
        {
            *rank = inner_rank;
            return before;
        }
    }
    return role;
}

/* ---- folders --------------------------------------------------------------
 */

typedef struct search
{
    otx_run *run;
    const char *folder; /* with its slash; "" the current one */
    const char *prefix;
    otx_material_files *out;
    int32_t ranks[OTX_MATERIAL_ROLE_COUNT];
    int32_t pictures; /* that the prefix fits */
} search;

static bool
is_folder(const char *path)
{
    struct stat info;

    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static bool
is_picture(const char *name)
{
    static const char *const ends[] = {
        ".exr", ".png", ".tif", ".tiff", ".jpg", ".jpeg"};
    const char *dot = strrchr(name, '.');

    for (size_t i = 0; dot && i < sizeof ends / sizeof *ends; ++i)
        if (strcasecmp(dot, ends[i]) == 0)
            return true;
    return false;
}

/* A prefix ends where a part of the name does. */
static bool
has_prefix(const char *name, const char *prefix)
{
    const size_t length = strlen(prefix);

    return strncmp(name, prefix, length) == 0 &&
           (length == 0 || is_separator(prefix[length - 1]) ||
            !isalnum((unsigned char)name[length]));
}

static otx_status
take(search *s, const char *name)
{
    const char *dot = strrchr(name, '.');
    const size_t bytes = strlen(s->folder) + strlen(name) + 1;
    char *path = OTX_NEW(s->run->arena, char, bytes);
    char *stem = otx_arena_strdup(s->run->scratch, name);
    otx_material_role role;
    int32_t rank;

    if (!path || !stem)
        return otx_fail_memory(s->run, STAGE);
    ++s->pictures;
    snprintf(path, bytes, "%s%s", s->folder, name);
    stem[dot - name] = '\0';
    role = otx_material_files_role(stem, &rank);
    if (role == OTX_MATERIAL_ROLE_COUNT || rank < s->ranks[role])
        return OSDTEX_OK;
    if (s->out->paths[role] && rank == s->ranks[role])
        return otx_fail(
            s->run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(path),
            "this file and '%s' could both be the same map of the material; "
            "give the part of the name that only one has, FOLDER/NAME_2K, or "
            "name the maps one by one",
            s->out->paths[role]);
    s->out->paths[role] = path;
    s->ranks[role] = rank;
    return OSDTEX_OK;
}

/* Whether osdtex wrote it, from another file. */
static bool
is_made(const search *s, const char *name)
{
    const size_t bytes = strlen(s->folder) + strlen(name) + 1;
    char *path = malloc(bytes);
    otx_mark_found found;
    bool made;

    if (!path)
        return false;
    snprintf(path, bytes, "%s%s", s->folder, name);
    made = otx_mark_read(path, false, &found);
    free(path);
    return made;
}

static otx_status
look_through(search *s, struct dirent **entries, int count, bool with_made)
{
    for (int i = 0; i < count; ++i)
        if (has_prefix(entries[i]->d_name, s->prefix) &&
            is_picture(entries[i]->d_name) &&
            (with_made || !is_made(s, entries[i]->d_name)))
            OTX_TRY(take(s, entries[i]->d_name));
    return OSDTEX_OK;
}

/* What osdtex wrote into the folder of a material is not of the material,
 * unless there is no other. */
static otx_status
look_twice(search *s, struct dirent **entries, int count)
{
    OTX_TRY(look_through(s, entries, count, false));
    if (s->out->paths[OTX_MATERIAL_COLOR])
        return OSDTEX_OK;
    memset(s->out, 0, sizeof *s->out);
    memset(s->ranks, 0, sizeof s->ranks);
    s->pictures = 0;
    return look_through(s, entries, count, true);
}

static otx_status
search_folder(search *s)
{
    struct dirent **entries = NULL;
    const int count =
        scandir(*s->folder ? s->folder : ".", &entries, NULL, alphasort);
    otx_status status;

    if (count < 0)
        return otx_fail(
            s->run, OSDTEX_ERROR_IO, STAGE, otx_where_file(s->folder),
            "the folder of the material cannot be read: %s", strerror(errno));
    status = look_twice(s, entries, count);
    for (int i = 0; i < count; ++i)
        free(entries[i]);
    free(entries);
    return status;
}

/* The folder of `text`, and what names in it begin with. */
static otx_status
divide(search *s, const char *text)
{
    const char *slash = strrchr(text, '/');
    const bool whole = is_folder(text);
    const size_t length = whole   ? strlen(text)
                          : slash ? (size_t)(slash - text) + 1
                                  : 0;
    char *folder = OTX_NEW(s->run->scratch, char, length + 2);

    if (!folder)
        return otx_fail_memory(s->run, STAGE);
    memcpy(folder, text, length);
    folder[length] = '\0';
    if (whole && text[length - 1] != '/')
        strcpy(folder + length, "/");
    s->folder = folder;
    s->prefix = whole ? "" : text + length;
    return OSDTEX_OK;
}

otx_status
otx_material_files_find(otx_run *run, const char *text, otx_material_files *out)
{
    search s = {.run = run, .out = out};

    *out = (otx_material_files){{NULL}};
    OTX_TRY(divide(&s, text));
    OTX_TRY(search_folder(&s));
    if (out->paths[OTX_MATERIAL_COLOR])
        return OSDTEX_OK;
    if (s.pictures == 0)
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(text),
            "there is no picture of that name, nor in a folder of that name");
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(text),
        "none of the %d pictures is called as the colour of a material is "
        "(NAME_Color, NAME_BaseColor, NAME_Albedo, NAME_diff); name the colour "
        "and the maps one by one",
        (int)s.pictures);
}
