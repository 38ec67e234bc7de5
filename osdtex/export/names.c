/* names.c -- which files a model is made of. */
#include "export/names.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char STAGE[] = "export";
static const char SUFFIX[] = ".obj";

static bool
is_split_by_readers(char c)
{
    return (unsigned char)c <= ' ' || c == 127 || c == '#' || c == '\\';
}

/* Bytes of the UTF-8 character at `text`, 0 when it is none: texts of USD and
 * MaterialX are UTF-8 as a whole. */
static size_t
utf8_length(const char *text)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char *c = (const unsigned char *)text;
    const size_t length = c[0] < 0x80             ? 1
                          : (c[0] & 0xE0) == 0xC0 ? 2
                          : (c[0] & 0xF0) == 0xE0 ? 3
                          : (c[0] & 0xF8) == 0xF0 ? 4
                                                  : 0;
    uint32_t value = c[0] & (0xFFu >> (length + 1));

    for (size_t i = 1; i < length; ++i)
    {
        if ((c[i] & 0xC0) != 0x80)
            return 0;
        value = value << 6 | (c[i] & 0x3F);
    }
    if (length < 2)
        return length;
    /* Overlong forms, halves of UTF-16 pairs, XML's forbidden ones. */
    return value < least[length] || value > 0x10FFFF ||
                   (value >= 0xD800 && value < 0xE000) ||
                   (value >= 0x80 && value < 0xA0) || (value & 0xFFFE) == 0xFFFE
               ? 0
               : length;
}

bool
otx_names_make_word(char *stem)
{
    bool changed = false;

    for (char *c = stem; *c;)
    {
        const size_t length = utf8_length(c);

        if (length == 0 || is_split_by_readers(*c) || (c == stem && *c == '-'))
        {
            *c = '_';
            changed = true;
        }
        c += length > 0 ? length : 1;
    }
    return changed;
}

/* folder + stem + suffix; NULL when memory is out. */
static const char *
join(
    otx_arena *arena, const char *folder, size_t folder_bytes, const char *stem,
    const char *suffix)
{
    const size_t stem_bytes = strlen(stem);
    const size_t suffix_bytes = strlen(suffix) + 1;
    char *out = OTX_NEW(arena, char, folder_bytes + stem_bytes + suffix_bytes);

    if (!out)
        return NULL;
    memcpy(out, folder, folder_bytes);
    memcpy(out + folder_bytes, stem, stem_bytes);
    memcpy(out + folder_bytes + stem_bytes, suffix, suffix_bytes);
    return out;
}

otx_status
otx_names_derive(
    otx_run *run, otx_arena *arena, const char *path, otx_names *out)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const size_t folder_bytes = (size_t)(name - path);
    const size_t suffix_bytes = sizeof SUFFIX - 1;
    const size_t name_bytes = strlen(name);
    otx_where where = OTX_NOWHERE;
    char *stem;

    where.file = path;
    if (name_bytes <= suffix_bytes ||
        strcasecmp(name + name_bytes - suffix_bytes, SUFFIX) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "the output must be called NAME.obj");
    stem = otx_arena_strdup(arena, name);
    if (!stem)
        return otx_fail_memory(run, STAGE);
    stem[name_bytes - suffix_bytes] = '\0';
    if (otx_names_make_word(stem))
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "readers split names at blanks and know UTF-8 only, so the "
            "material file and the texture are called %s.mtl and %s.exr",
            stem, stem);
    *out = (otx_names){
        .obj = otx_arena_strdup(arena, path),
        .mtl = join(arena, path, folder_bytes, stem, ".mtl"),
        .exr = join(arena, path, folder_bytes, stem, ".exr"),
        .mtl_name = join(arena, "", 0, stem, ".mtl"),
        .exr_name = join(arena, "", 0, stem, ".exr"),
        .stem = stem,
    };
    if (!out->obj || !out->mtl || !out->exr || !out->mtl_name || !out->exr_name)
        return otx_fail_memory(run, STAGE);
    out->texture_count = 1;
    out->textures[0] = out->exr;
    out->texture_names[0] = out->exr_name;
    return OSDTEX_OK;
}

otx_status
otx_names_number(
    otx_run *run, otx_arena *arena, int32_t count, const char *extension,
    otx_names *names)
{
    const size_t folder_bytes = strlen(names->mtl) - strlen(names->mtl_name);

    for (int32_t k = 0; k < count; ++k)
    {
        char suffix[32];

        snprintf(suffix, sizeof suffix, "%s", extension);
        if (count > 1)
            snprintf(suffix, sizeof suffix, "_%d%s", (int)k + 1, extension);
        names->textures[k] =
            join(arena, names->mtl, folder_bytes, names->stem, suffix);
        names->texture_names[k] = join(arena, "", 0, names->stem, suffix);
        if (!names->textures[k] || !names->texture_names[k])
            return otx_fail_memory(run, STAGE);
    }
    names->texture_count = count;
    return OSDTEX_OK;
}

int32_t
otx_names_find(const char *const *list, int32_t count, const char *name)
{
    for (int32_t i = 0; i < count; ++i)
        if (strcmp(list[i], name) == 0)
            return i;
    return -1;
}
