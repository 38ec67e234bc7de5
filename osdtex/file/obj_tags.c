/* obj_tags.c -- subdivision tags in an OBJ file.
 *
 * The counts of a `t` line are claims. They are held against the tokens that
 * are there before anything is read, and memory was reserved by tokens, so a
 * file can lie as it likes. */
#include "file/obj_tags.h"

#include "bridge/charconv.h"
#include "file/obj_index.h"

#include <inttypes.h>

typedef struct tag_kind tag_kind;

/* One `t` line while it is read. */
typedef struct tag_line
{
    otx_obj_tags *tags;
    otx_text *text;
    const tag_kind *kind;
    int64_t ints, floats, strings;
} tag_line;

struct tag_kind
{
    const char *name;
    otx_status (*read)(const tag_line *line);
    size_t target;        /* offset in otx_obj_tags */
    int32_t width;        /* lists: integers an item; rules: how many values */
    const char *words[2]; /* rules given as words */
};

static otx_status
create_list(
    otx_run *run, int64_t items, int32_t width, bool sharp,
    otx_obj_tags_list *out)
{
    *out = (otx_obj_tags_list){
        .indices = OTX_NEW(run->arena, int32_t, items * width),
        .line = OTX_NEW(run->arena, int64_t, items)};
    if (sharp)
        out->sharpness = OTX_NEW(run->arena, float, items);
    OTX_TRY(otx_run_ok(run));
    return OSDTEX_OK;
}

otx_status
otx_obj_tags_create(otx_run *run, int64_t values, otx_obj_tags *out)
{
    *out = (otx_obj_tags){
        .boundary = OTX_OBJ_NO_RULE,
        .fvar = OTX_OBJ_NO_RULE,
        .crease_method = OTX_OBJ_NO_RULE,
        .triangles = OTX_OBJ_NO_RULE};
    OTX_TRY(create_list(run, values / 2, 2, true, &out->creases));
    OTX_TRY(create_list(run, values, 1, true, &out->corners));
    return create_list(run, values, 1, false, &out->holes);
}

static otx_status
fail_shape(const tag_line *line, const char *expected)
{
    return otx_fail(
        line->text->run, OSDTEX_ERROR_FORMAT, line->text->stage,
        otx_text_where(line->text),
        "tag %s with %" PRId64 "/%" PRId64 "/%" PRId64
        " values; %s are expected",
        line->kind->name, line->ints, line->floats, line->strings, expected);
}

/* The next integer of the line, in [0, limit]. */
static otx_status
read_int(const tag_line *line, int32_t limit, int32_t *value)
{
    otx_token token;
    int64_t number = 0;

    /* There is one: read_counts has looked. */
    otx_text_token(line->text, &token);
    OTX_TRY(otx_text_parse_int(line->text, token, line->kind->name, &number));
    if (number < 0 || number > limit)
        return otx_fail(
            line->text->run, OSDTEX_ERROR_FORMAT, line->text->stage,
            otx_text_where(line->text),
            "tag %s: %" PRId64 " is not between 0 and %" PRId32,
            line->kind->name, number, limit);
    *value = (int32_t)number;
    return OSDTEX_OK;
}

/* Indices, `width` for each item, then one sharpness for all or one each. */
static otx_status
read_sharp(const tag_line *line)
{
    char *base = (char *)line->tags + line->kind->target;
    otx_obj_tags_list *list = (otx_obj_tags_list *)(void *)base;
    const int32_t width = line->kind->width;
    const int64_t items = line->ints / width;
    float sharpness = 0;

    if (line->ints % width != 0 || items == 0 || line->strings != 0 ||
        (line->floats != 1 && line->floats != items))
        return fail_shape(
            line, width == 2 ? "2n/1/0 or 2n/n/0" : "n/1/0 or n/n/0");
    for (int64_t i = 0; i < line->ints; ++i)
        OTX_TRY(read_int(
            line, INT32_MAX, &list->indices[(int64_t)list->count * width + i]));
    for (int64_t i = 0; i < items; ++i)
    {
        if (i < line->floats)
            OTX_TRY(otx_text_float(line->text, "sharpness", &sharpness));
        list->sharpness[list->count] = sharpness;
        list->line[list->count++] = line->text->line;
    }
    return OSDTEX_OK;
}

static otx_status
read_holes(const tag_line *line)
{
    otx_obj_tags_list *list = &line->tags->holes;

    if (line->floats != 0 || line->strings != 0)
        return fail_shape(line, "n/0/0");
    for (int64_t i = 0; i < line->ints; ++i)
    {
        OTX_TRY(read_int(line, INT32_MAX, &list->indices[list->count]));
        list->line[list->count++] = line->text->line;
    }
    return OSDTEX_OK;
}

static otx_obj_rule *
rule_of(const tag_line *line)
{
    char *base = (char *)line->tags + line->kind->target;

    return (otx_obj_rule *)(void *)base;
}

static otx_status
read_number(const tag_line *line)
{
    otx_obj_rule *rule = rule_of(line);

    if (line->ints != 1 || line->floats != 0 || line->strings != 0)
        return fail_shape(line, "1/0/0");
    OTX_TRY(read_int(line, line->kind->width - 1, &rule->value));
    rule->line = line->text->line;
    return OSDTEX_OK;
}

static otx_status
read_word(const tag_line *line)
{
    const tag_kind *kind = line->kind;
    otx_obj_rule *rule = rule_of(line);
    otx_text_quote quote;
    otx_token word;

    if (line->ints != 0 || line->floats != 0 || line->strings != 1)
        return fail_shape(line, "0/0/1");
    otx_text_token(line->text, &word);
    for (int32_t i = 0; i < kind->width; ++i)
    {
        if (!otx_token_is(word, kind->words[i]))
            continue;
        *rule = (otx_obj_rule){i, line->text->line};
        return OSDTEX_OK;
    }
    quote = otx_token_quote(word);
    return otx_fail(
        line->text->run, OSDTEX_ERROR_FORMAT, line->text->stage,
        otx_text_where(line->text), "tag %s knows %s and %s, not '%s'",
        kind->name, kind->words[0], kind->words[1], quote.text);
}

#define TARGET(member) offsetof(otx_obj_tags, member)

static const tag_kind tag_kinds[] = {
    {"crease", read_sharp, TARGET(creases), 2, {NULL, NULL}},
    {"corner", read_sharp, TARGET(corners), 1, {NULL, NULL}},
    {"hole", read_holes, TARGET(holes), 1, {NULL, NULL}},
    {"interpolateboundary", read_number, TARGET(boundary), 3, {NULL, NULL}},
    {"facevaryinginterpolateboundary",
     read_number,
     TARGET(fvar),
     6,
     {NULL, NULL}},
    {"creasemethod",
     read_word,
     TARGET(crease_method),
     2,
     {"normal", "chaikin"}},
    {"smoothtriangles",
     read_word,
     TARGET(triangles),
     2,
     {"catmark", "smooth"}}};

static const tag_kind *
find_kind(otx_token name)
{
    for (size_t i = 0; i < sizeof tag_kinds / sizeof *tag_kinds; ++i)
    {
        if (otx_token_is(name, tag_kinds[i].name))
            return &tag_kinds[i];
    }
    return NULL;
}

static bool
parse_counts(otx_token token, int64_t counts[3])
{
    const char *at = token.begin;

    for (int i = 0; i < 3; ++i)
    {
        if (i > 0 && (at == token.end || *at++ != '/'))
            return false;
        if (otx_charconv_read_int(at, token.end, &counts[i], &at) !=
                OTX_CHARCONV_OK ||
            counts[i] < 0)
            return false;
    }
    return at == token.end;
}

/* Reads INTS/FLOATS/STRINGS, and holds their sum against what is there. */
static otx_status
read_counts(tag_line *line)
{
    const otx_text *text = line->text;
    int64_t counts[3] = {0}, present;
    otx_token token;

    if (!otx_text_token(line->text, &token) || !parse_counts(token, counts))
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
            "tag %s needs the numbers of its values first, as in 2/1/0",
            line->kind->name);
    present = otx_text_count(text);
    /* One by one first, so that the sum cannot overflow. */
    if (counts[0] > present || counts[1] > present || counts[2] > present ||
        counts[0] + counts[1] + counts[2] != present)
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
            "tag %s announces %" PRId64 "/%" PRId64 "/%" PRId64
            " values, and %" PRId64 " follow",
            line->kind->name, counts[0], counts[1], counts[2], present);
    line->ints = counts[0];
    line->floats = counts[1];
    line->strings = counts[2];
    return OSDTEX_OK;
}

otx_status
otx_obj_tags_read(otx_obj_tags *tags, otx_text *text)
{
    tag_line line = {.tags = tags, .text = text};
    otx_text_quote quote;
    otx_token name;

    if (!otx_text_token(text, &name))
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
            "the tag has no name");
    line.kind = find_kind(name);
    if (line.kind)
    {
        OTX_TRY(read_counts(&line));
        return line.kind->read(&line);
    }
    quote = otx_token_quote(name);
    otx_note(
        text->run, OSDTEX_SEVERITY_WARNING, text->stage, otx_text_where(text),
        "tag '%s' is not supported and has no effect", quote.text);
    return OSDTEX_OK;
}

otx_status
otx_obj_tags_read_edge(otx_obj_tags *tags, otx_text *text, int32_t verts_so_far)
{
    const otx_obj_index_context context = {text, "vertex", -1};
    otx_obj_tags_list *list = &tags->creases;
    int64_t number = 0;
    otx_token token;

    if (otx_text_count(text) != 3)
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
            "'ec' takes a sharpness and two vertices");
    OTX_TRY(otx_text_float(text, "sharpness", &list->sharpness[list->count]));
    for (int32_t i = 0; i < 2; ++i)
    {
        otx_text_token(text, &token);
        OTX_TRY(otx_text_parse_int(text, token, "vertex", &number));
        OTX_TRY(otx_obj_index_resolve(
            &context, number, verts_so_far,
            &list->indices[2 * (int64_t)list->count + i]));
    }
    list->line[list->count++] = text->line;
    return OSDTEX_OK;
}

static otx_status
check_exist(
    const otx_obj_tags_list *list, int32_t width, const otx_text *text,
    const char *what, int32_t count)
{
    for (int64_t i = 0; i < (int64_t)list->count * width; ++i)
    {
        otx_where where = otx_text_where(text);

        if (list->indices[i] < count)
            continue;
        where.line = list->line[i / width];
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, where,
            "the tag names %s %" PRId32 ", counted from 0, and the file has "
            "%" PRId32,
            what, list->indices[i], count);
    }
    return OSDTEX_OK;
}

static otx_obj_creases
sharp_view(const otx_obj_tags_list *list)
{
    return (otx_obj_creases){
        list->count, list->indices, list->sharpness, list->line};
}

otx_status
otx_obj_tags_finish(
    const otx_obj_tags *tags, const otx_text *text, otx_obj *out)
{
    OTX_TRY(check_exist(&tags->creases, 2, text, "vertex", out->vert_count));
    OTX_TRY(check_exist(&tags->corners, 1, text, "vertex", out->vert_count));
    OTX_TRY(check_exist(&tags->holes, 1, text, "face", out->face_count));
    out->creases = sharp_view(&tags->creases);
    out->corners = sharp_view(&tags->corners);
    out->hole_count = tags->holes.count;
    out->hole_faces = tags->holes.indices;
    out->hole_line = tags->holes.line;
    out->boundary = tags->boundary;
    out->fvar = tags->fvar;
    out->crease_method = tags->crease_method;
    out->triangles = tags->triangles;
    return OSDTEX_OK;
}
