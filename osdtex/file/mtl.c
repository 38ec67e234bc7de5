/* mtl.c -- material libraries.
 *
 * A library holds much that a picture of ours does not need, and much that no
 * two programs agree about. So whatever is not `newmtl`, `Kd`, `map_Kd` or one
 * of the maps that we write is passed over without a word. */
#include "file/mtl.h"

#include "bridge/charconv.h"
#include "file/text.h"
#include "file/text_out.h"

#include <string.h>

#define STAGE "mtl"

enum
{
    MAX_BYTES = 64 << 20
};

typedef struct reader
{
    otx_run *run;
    otx_text text;
    otx_mtl_material *materials;
    int32_t count;
} reader;

/* Options of a map and how many words follow. */
typedef struct option
{
    const char *word;
    int32_t least, most; /* the optional ones are numbers */
} option;

static const option options[] = {
    {"-o", 1, 3},      {"-s", 1, 3},         {"-t", 1, 3},
    {"-mm", 2, 2},     {"-bm", 1, 1},        {"-boost", 1, 1},
    {"-blendu", 1, 1}, {"-blendv", 1, 1},    {"-cc", 1, 1},
    {"-clamp", 1, 1},  {"-imfchan", 1, 1},   {"-texres", 1, 1},
    {"-type", 1, 1},   {"-colorspace", 1, 1}};

static const option *
find_option(otx_token word)
{
    for (size_t i = 0; i < sizeof options / sizeof *options; ++i)
    {
        if (otx_token_is(word, options[i].word))
            return &options[i];
    }
    return NULL;
}

static bool
is_number(otx_token token)
{
    const char *rest = token.begin;
    float value;

    return otx_charconv_read_float(token.begin, token.end, &value, &rest) !=
               OTX_CHARCONV_MALFORMED &&
           rest == token.end;
}

/* Takes options until something else stands there: the file name, which is
 * the rest of the line, blanks included. */
static void
skip_options(otx_text *text)
{
    for (;;)
    {
        otx_token before = text->rest, word;
        const option *found = NULL;

        if (otx_text_token(text, &word))
            found = find_option(word);
        if (!found)
        {
            text->rest = before;
            return;
        }
        for (int32_t i = 0; i < found->most; ++i)
        {
            before = text->rest;
            if (!otx_text_token(text, &word))
                return;
            if (i < found->least || is_number(word))
                continue;
            text->rest = before;
            break;
        }
    }
}

/* Kd r g b | r, which stands for all three. Colors by spectral file or as XYZ
 * are not read. */
static otx_status
read_diffuse(reader *r, otx_mtl_material *material)
{
    otx_token token;
    float *kd = material->diffuse;

    if (!otx_text_token(&r->text, &token) || otx_token_is(token, "xyz") ||
        otx_token_is(token, "spectral"))
        return OSDTEX_OK;
    OTX_TRY(otx_text_parse_float(&r->text, token, "color", &kd[0]));
    kd[1] = kd[2] = kd[0];
    material->has_diffuse = true;
    if (otx_text_count(&r->text) == 0)
        return OSDTEX_OK;
    OTX_TRY(otx_text_float(&r->text, "green", &kd[1]));
    return otx_text_float(&r->text, "blue", &kd[2]);
}

/* Where the file of a map goes; NULL for other words. */
static const char **
map_of(otx_mtl_material *material, otx_token word)
{
    otx_data_maps *maps = &material->maps;
    const struct
    {
        const char *word;
        const char **file;
    } all[] = {
        {"map_Kd", &material->map_kd}, {"map_Pr", &maps->roughness},
        {"map_Pm", &maps->metalness},  {"norm", &maps->normal},
        {"disp", &maps->height},       {"map_d", &material->map_d},
    };

    for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
        if (otx_token_is(word, all[i].word))
            return all[i].file;
    return NULL;
}

static otx_status
read_map(reader *r, const char **out)
{
    otx_token name;

    skip_options(&r->text);
    name = otx_text_remainder(&r->text);
    if (name.begin == name.end)
        return OSDTEX_OK;
    *out = otx_token_copy(r->run->arena, name);
    return otx_run_ok(r->run);
}

static otx_status
begin_material(reader *r)
{
    otx_mtl_material *material = &r->materials[r->count];

    *material = (otx_mtl_material){
        .name = otx_token_copy(r->run->arena, otx_text_remainder(&r->text)),
        .diffuse = {1, 1, 1},
        .line = r->text.line};
    OTX_TRY(otx_run_ok(r->run));
    ++r->count;
    return OSDTEX_OK;
}

static otx_status
read_line(reader *r, otx_token word)
{
    otx_mtl_material none,
        *material = r->count > 0 ? &r->materials[r->count - 1] : &none;
    const bool is_diffuse = otx_token_is(word, "Kd");
    const char **map = map_of(material, word);

    if (otx_token_is(word, "newmtl"))
        return begin_material(r);
    if (!is_diffuse && !map)
        return OSDTEX_OK;
    if (r->count == 0)
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE, otx_text_where(&r->text),
            "a material has to begin with 'newmtl' before this line");
    return is_diffuse ? read_diffuse(r, material) : read_map(r, map);
}

static otx_status
create_materials(reader *r)
{
    int64_t count = 0;
    otx_token word;

    while (otx_text_next(&r->text))
        count +=
            otx_text_token(&r->text, &word) && otx_token_is(word, "newmtl");
    r->materials = OTX_NEW(r->run->arena, otx_mtl_material, count);
    return otx_run_ok(r->run);
}

static otx_status
read_mtl(reader *r, otx_mtl *out)
{
    const char *path = otx_arena_strdup(r->run->arena, r->text.name);
    otx_token word;

    OTX_TRY(otx_run_ok(r->run));
    OTX_TRY(create_materials(r));
    otx_text_rewind(&r->text);
    while (otx_text_next(&r->text))
    {
        if (otx_text_token(&r->text, &word))
            OTX_TRY(read_line(r, word));
    }
    *out = (otx_mtl){path, r->count, r->materials};
    return OSDTEX_OK;
}

otx_status
otx_mtl_read(otx_run *run, const char *path, otx_mtl *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    reader r = {.run = run};
    otx_status status = otx_text_read(run, STAGE, path, MAX_BYTES, &r.text);

    if (status == OSDTEX_OK)
        status = read_mtl(&r, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_mtl_parse(
    otx_run *run, const char *name, const char *bytes, size_t size,
    otx_mtl *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    reader r = {.run = run};
    otx_status status = otx_text_open(run, STAGE, name, bytes, size, &r.text);

    if (status == OSDTEX_OK)
        status = read_mtl(&r, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

static char
without_blank(char c)
{
    return c == ' ' || c == '\t' ? '_' : c;
}

static bool
same_name(const char *a, const char *b)
{
    while (*a && without_blank(*a) == without_blank(*b))
    {
        ++a;
        ++b;
    }
    return *a == *b;
}

int32_t
otx_mtl_find(const otx_mtl *mtl, const char *name)
{
    int32_t alike = -1;

    for (int32_t i = mtl->count - 1; i >= 0; --i)
    {
        if (strcmp(mtl->materials[i].name, name) == 0)
            return i;
        if (alike < 0 && same_name(mtl->materials[i].name, name))
            alike = i;
    }
    return alike;
}

static void
write_map(otx_text_out *out, const char *key, const char *file)
{
    if (!file)
        return;
    otx_text_out_string(out, key);
    otx_text_out_char(out, ' ');
    otx_text_out_name(out, file, true);
    otx_text_out_char(out, '\n');
}

static bool
is_shiny(const otx_data_maps *maps)
{
    return maps->roughness || maps->metalness;
}

static void
write_material(otx_text_out *out, const otx_mtl_material *material)
{
    const otx_data_maps *maps = &material->maps;

    otx_text_out_string(out, "newmtl ");
    otx_text_out_name(out, material->name, false);
    otx_text_out_string(out, "\nKd");
    for (int i = 0; i < 3; ++i)
    {
        otx_text_out_char(out, ' ');
        otx_text_out_float(out, material->diffuse[i]);
    }
    otx_text_out_string(out, is_shiny(maps) ? "\nillum 2\n" : "\nillum 1\n");
    write_map(out, "map_Kd", material->map_kd);
    write_map(out, "map_d", material->map_d);
    write_map(out, "map_Pr", maps->roughness);
    write_map(out, "map_Pm", maps->metalness);
    write_map(out, "norm", maps->normal);
    write_map(out, "map_Bump", maps->normal ? maps->normal : maps->height);
    write_map(out, "disp", maps->height);
}

otx_status
otx_mtl_write(
    otx_run *run, const otx_mtl *mtl, const char *path, const char *title)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_text_out *out;
    otx_status status = otx_text_out_open(run, STAGE, path, title, &out);

    if (status == OSDTEX_OK)
        otx_text_out_mark(out, run->mark, "# ", "\n");
    for (int32_t i = 0; status == OSDTEX_OK && i < mtl->count; ++i)
        write_material(out, &mtl->materials[i]);
    if (status == OSDTEX_OK)
        status = otx_text_out_close(run, out);
    otx_arena_release(run->scratch, mark);
    return status;
}
