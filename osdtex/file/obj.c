/* obj.c -- reads OBJ.
 *
 * Twice over the file: the first pass counts, the second fills arrays of
 * exactly that size. Nothing grows, and no count that a file claims is ever
 * believed. */
#include "file/obj.h"

#include "bridge/charconv.h"
#include "file/obj_index.h"
#include "file/obj_names.h"
#include "file/obj_origin.h"
#include "file/obj_tags.h"

#include <inttypes.h>
#include <string.h>

#define STAGE "obj"

static const size_t MAX_BYTES = (size_t)4 << 30;

enum
{
    LINES_PER_PROGRESS = 1 << 16,
    MAX_NUMBERS = 7 /* in a `v` line */
};

typedef enum element
{
    ELEMENT_POINT,
    ELEMENT_UV,
    ELEMENT_FACE,
    ELEMENT_NORMAL,
    ELEMENT_GROUP, /* the four attributes of a face are consecutive */
    ELEMENT_OBJECT,
    ELEMENT_MATERIAL,
    ELEMENT_SMOOTH,
    ELEMENT_LIBRARY,
    ELEMENT_TAG,
    ELEMENT_CREASE,
    ELEMENT_LINE, /* from here on ignored, with a warning for each kind */
    ELEMENT_FREEFORM,
    ELEMENT_DISPLAY,
    ELEMENT_UNKNOWN,
    ELEMENT_COUNT
} element;

enum
{
    ATTRIBUTE_COUNT = 4
};

typedef struct reader
{
    otx_run *run;
    otx_text text;

    /* What the first pass finds. */
    int64_t lines[ELEMENT_COUNT];
    int64_t first_line[ELEMENT_COUNT];
    otx_text_quote first_unknown;
    int64_t corners, tag_values;
    size_t point_line_bytes;

    /* What the second pass has so far. */
    int32_t vert_count, uv_count, face_count, corner_count;
    double *places; /* of the points; a temporary */
    float *points, *colors, *uvs;
    char *point_lines;
    size_t point_line_used;
    int32_t *face_first, *face_verts, *face_uvs;
    int64_t *face_line;
    int32_t *attribute[ATTRIBUTE_COUNT];
    int32_t current[ATTRIBUTE_COUNT]; /* what a face gets now */
    otx_obj_names_table names[ATTRIBUTE_COUNT];
    otx_obj_names_table libraries;
    otx_obj_tags tags;
} reader;

/* Up to `limit` numbers until the line ends; *count is limit + 1 when there
 * are more. */
static otx_status
read_numbers(
    reader *r, const char *what, int32_t limit, double *numbers, int32_t *count)
{
    otx_token token;

    for (*count = 0; otx_text_token(&r->text, &token); ++*count)
    {
        if (*count == limit)
        {
            ++*count;
            break;
        }
        OTX_TRY(otx_text_parse_double(&r->text, token, what, &numbers[*count]));
    }
    return OSDTEX_OK;
}

/* The color of the vertex that is read. The array is made when the first
 * color turns up; white is what the vertices without one get. */
static otx_status
read_color(reader *r, const double color[3])
{
    const size_t count = (size_t)r->lines[ELEMENT_POINT] * 3;

    if (!r->colors)
    {
        r->colors = OTX_NEW(r->run->arena, float, count);
        OTX_TRY(otx_run_ok(r->run));
        for (size_t i = 0; i < count; ++i)
            r->colors[i] = 1.0f;
    }
    for (size_t i = 0; i < 3; ++i)
        r->colors[3 * (size_t)r->vert_count + i] = (float)color[i];
    return OSDTEX_OK;
}

/* From its keyword, "v", to its end. */
static size_t
point_line_bytes(const reader *r)
{
    return 1 + (size_t)(r->text.rest.end - r->text.rest.begin) + 1;
}

static void
keep_point_line(reader *r)
{
    const size_t bytes = point_line_bytes(r);
    char *to = r->point_lines + r->point_line_used;

    to[0] = 'v';
    memcpy(to + 1, r->text.rest.begin, bytes - 2);
    /* Where lines were joined there is more than blanks between numbers. */
    for (size_t i = 1; i + 1 < bytes; ++i)
        to[i] = (unsigned char)to[i] < ' ' && to[i] != '\t' ? ' ' : to[i];
    to[bytes - 1] = '\n';
    r->point_line_used += bytes;
}

/* v x y z | x y z w | x y z r g b | x y z r g b a */
static otx_status
read_point(reader *r, element kind)
{
    double n[MAX_NUMBERS];
    int32_t count;

    (void)kind;
    keep_point_line(r);
    OTX_TRY(read_numbers(r, "coordinate", MAX_NUMBERS, n, &count));
    if (count < 3 || count == 5 || count > MAX_NUMBERS)
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE, otx_text_where(&r->text),
            "a vertex has 3, 4, 6 or 7 numbers, not %s%" PRId32,
            count > MAX_NUMBERS ? "more than " : "",
            count > MAX_NUMBERS ? MAX_NUMBERS : count);
    if (count == 4 && n[3] != 1.0)
        otx_note(
            r->run, OSDTEX_SEVERITY_WARNING, STAGE, otx_text_where(&r->text),
            "a fourth number of a vertex is a weight, which is for curves, "
            "and is ignored");
    if (count >= 6)
        OTX_TRY(read_color(r, n + 3));
    for (size_t i = 0; i < 3; ++i)
        r->places[3 * (size_t)r->vert_count + i] = n[i];
    ++r->vert_count;
    return OSDTEX_OK;
}

/* vt u | u v | u v w */
static otx_status
read_uv(reader *r, element kind)
{
    double n[3] = {0};
    int32_t count;

    (void)kind;
    OTX_TRY(read_numbers(r, "texture coordinate", 3, n, &count));
    if (count < 1 || count > 3)
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE, otx_text_where(&r->text),
            "a texture vertex has 1, 2 or 3 numbers, not %s",
            count < 1 ? "none" : "more");
    r->uvs[2 * (size_t)r->uv_count] = (float)n[0];
    r->uvs[2 * (size_t)r->uv_count + 1] = (float)n[1];
    ++r->uv_count;
    return OSDTEX_OK;
}

static otx_where
where_face(const reader *r)
{
    otx_where where = otx_text_where(&r->text);

    where.face = r->face_count;
    return where;
}

/* The numbers of v, v/vt, v//vn or v/vt/vn. */
typedef struct corner
{
    int64_t number[3];
    bool present[3];
} corner;

/* False when the token is none of the four forms. A number that is too large
 * becomes one that no element has. */
static bool
cut_corner(otx_token token, corner *out)
{
    const char *at = token.begin;

    *out = (corner){{0}, {false}};
    for (int part = 0; part < 3; ++part)
    {
        otx_charconv_result result;

        if (part == 1 && at != token.end && *at == '/')
        {
            ++at;
            continue;
        }
        out->number[part] = INT64_MAX;
        out->present[part] = true;
        result = otx_charconv_read_int(at, token.end, &out->number[part], &at);
        if (result == OTX_CHARCONV_MALFORMED)
            return false;
        if (at == token.end)
            return true;
        if (*at++ != '/')
            return false;
    }
    return false;
}

static otx_status
read_corner(reader *r, otx_token token)
{
    const otx_obj_index_context vertex = {&r->text, "vertex", r->face_count};
    const otx_obj_index_context uv = {
        &r->text, "texture vertex", r->face_count};
    int32_t *index = &r->face_uvs[r->corner_count];
    corner c;

    if (!cut_corner(token, &c) || (c.present[2] && c.number[2] == 0))
    {
        const otx_text_quote quote = otx_token_quote(token);

        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE, where_face(r),
            "'%s' is no corner of a face; v, v/vt, v//vn or v/vt/vn is "
            "expected",
            quote.text);
    }
    OTX_TRY(otx_obj_index_resolve(
        &vertex, c.number[0], r->vert_count, &r->face_verts[r->corner_count]));
    *index = -1;
    if (c.present[1])
        OTX_TRY(otx_obj_index_resolve(&uv, c.number[1], r->uv_count, index));
    ++r->corner_count;
    return OSDTEX_OK;
}

/* All corners of the face that begins at corner `first` have a UV, or none. */
static otx_status
check_uvs(reader *r, int32_t first)
{
    const bool some = r->face_uvs[first] >= 0;

    for (int32_t c = first; c < r->corner_count; ++c)
    {
        if ((r->face_uvs[c] >= 0) != some)
            return otx_fail(
                r->run, OSDTEX_ERROR_FORMAT, STAGE, where_face(r),
                "some corners of the face have a texture vertex and some do "
                "not");
    }
    return OSDTEX_OK;
}

static otx_status
read_face(reader *r, element kind)
{
    const int32_t first = r->corner_count;
    otx_token token;

    (void)kind;
    while (otx_text_token(&r->text, &token))
        OTX_TRY(read_corner(r, token));
    if (r->corner_count - first < 3)
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE, where_face(r),
            "a face needs at least 3 corners, and this one has %" PRId32,
            r->corner_count - first);
    OTX_TRY(check_uvs(r, first));
    for (int i = 0; i < ATTRIBUTE_COUNT; ++i)
        r->attribute[i][r->face_count] = r->current[i];
    r->face_line[r->face_count] = r->text.line;
    r->face_first[++r->face_count] = r->corner_count;
    return OSDTEX_OK;
}

static otx_status
read_name(reader *r, element kind)
{
    const int i = (int)kind - ELEMENT_GROUP;

    return otx_obj_names_add(
        r->run, &r->names[i], otx_text_remainder(&r->text), &r->current[i]);
}

static otx_status
read_library(reader *r, element kind)
{
    int32_t index;

    (void)kind;
    return otx_obj_names_add(
        r->run, &r->libraries, otx_text_remainder(&r->text), &index);
}

static otx_status
read_tag(reader *r, element kind)
{
    if (kind == ELEMENT_CREASE)
        return otx_obj_tags_read_edge(&r->tags, &r->text, r->vert_count);
    return otx_obj_tags_read(&r->tags, &r->text);
}

/* What a line can begin with. Frequent words come first. `read` NULL: nothing
 * that this library has a use for. */
typedef struct keyword
{
    const char *word;
    element kind;
    otx_status (*read)(reader *r, element kind);
} keyword;

static const keyword unknown_keyword = {"", ELEMENT_UNKNOWN, NULL};

static const keyword keywords[] = {
    {"v", ELEMENT_POINT, read_point},
    {"vt", ELEMENT_UV, read_uv},
    {"f", ELEMENT_FACE, read_face},
    {"vn", ELEMENT_NORMAL, NULL},
    {"g", ELEMENT_GROUP, read_name},
    {"o", ELEMENT_OBJECT, read_name},
    {"usemtl", ELEMENT_MATERIAL, read_name},
    {"s", ELEMENT_SMOOTH, read_name},
    {"mtllib", ELEMENT_LIBRARY, read_library},
    {"t", ELEMENT_TAG, read_tag},
    {"ec", ELEMENT_CREASE, read_tag},
    {"l", ELEMENT_LINE, NULL},
    {"p", ELEMENT_LINE, NULL},
    {"vp", ELEMENT_FREEFORM, NULL},
    {"cstype", ELEMENT_FREEFORM, NULL},
    {"deg", ELEMENT_FREEFORM, NULL},
    {"bmat", ELEMENT_FREEFORM, NULL},
    {"step", ELEMENT_FREEFORM, NULL},
    {"curv", ELEMENT_FREEFORM, NULL},
    {"curv2", ELEMENT_FREEFORM, NULL},
    {"surf", ELEMENT_FREEFORM, NULL},
    {"parm", ELEMENT_FREEFORM, NULL},
    {"trim", ELEMENT_FREEFORM, NULL},
    {"hole", ELEMENT_FREEFORM, NULL},
    {"scrv", ELEMENT_FREEFORM, NULL},
    {"sp", ELEMENT_FREEFORM, NULL},
    {"end", ELEMENT_FREEFORM, NULL},
    {"con", ELEMENT_FREEFORM, NULL},
    {"mg", ELEMENT_FREEFORM, NULL},
    {"bevel", ELEMENT_DISPLAY, NULL},
    {"c_interp", ELEMENT_DISPLAY, NULL},
    {"d_interp", ELEMENT_DISPLAY, NULL},
    {"lod", ELEMENT_DISPLAY, NULL},
    {"maplib", ELEMENT_DISPLAY, NULL},
    {"usemap", ELEMENT_DISPLAY, NULL},
    {"shadow_obj", ELEMENT_DISPLAY, NULL},
    {"trace_obj", ELEMENT_DISPLAY, NULL},
    {"ctech", ELEMENT_DISPLAY, NULL},
    {"stech", ELEMENT_DISPLAY, NULL}};

static const keyword *
find_keyword(otx_token word)
{
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; ++i)
    {
        if (otx_token_is(word, keywords[i].word))
            return &keywords[i];
    }
    return &unknown_keyword;
}

static void
count_line(reader *r, otx_token word)
{
    const element kind = find_keyword(word)->kind;

    if (r->lines[kind]++ == 0)
    {
        r->first_line[kind] = r->text.line;
        if (kind == ELEMENT_UNKNOWN)
            r->first_unknown = otx_token_quote(word);
    }
    if (kind == ELEMENT_POINT)
        r->point_line_bytes += point_line_bytes(r);
    if (kind == ELEMENT_FACE)
        r->corners += otx_text_count(&r->text);
    if (kind == ELEMENT_TAG || kind == ELEMENT_CREASE)
        r->tag_values += otx_text_count(&r->text);
}

/* The first pass. */
static otx_status
count_elements(reader *r)
{
    int64_t largest;
    otx_token word;

    while (otx_text_next(&r->text))
    {
        if (otx_text_token(&r->text, &word))
            count_line(r, word);
    }
    largest = r->corners > r->tag_values ? r->corners : r->tag_values;
    for (int kind = 0; kind < ELEMENT_COUNT; ++kind)
        largest = r->lines[kind] > largest ? r->lines[kind] : largest;
    if (largest > INT32_MAX)
        return otx_fail(
            r->run, OSDTEX_ERROR_LIMIT, STAGE, otx_text_where(&r->text),
            "the file has %" PRId64 " elements of one kind, and no more than "
            "%" PRId32 " can be numbered",
            largest, INT32_MAX);
    return OSDTEX_OK;
}

/* One finding for each kind of ignored element: where it first is, and how
 * often it occurs. */
static void
note_ignored(const reader *r)
{
    static const char *const formats[ELEMENT_COUNT] = {
        [ELEMENT_LINE] = "points and lines ('p', 'l') are no faces and are "
                         "ignored; their number is %" PRId64,
        [ELEMENT_FREEFORM] =
            "curves and free-form surfaces are ignored; convert them to "
            "polygons; the number of their lines is %" PRId64,
        [ELEMENT_DISPLAY] = "display and render attributes are ignored; the "
                            "number of their lines is %" PRId64,
        [ELEMENT_UNKNOWN] = "lines that begin with no known word are ignored; "
                            "their number is %" PRId64 ", and the first is "
                            "'%s'"};

    for (int kind = ELEMENT_LINE; kind < ELEMENT_COUNT; ++kind)
    {
        otx_where where = otx_text_where(&r->text);

        where.line = r->first_line[kind];
        if (r->lines[kind] > 0)
            otx_note(
                r->run, OSDTEX_SEVERITY_WARNING, STAGE, where, formats[kind],
                r->lines[kind], r->first_unknown.text);
    }
}

static otx_status
create_arrays(reader *r)
{
    otx_arena *arena = r->run->arena;
    const int64_t faces = r->lines[ELEMENT_FACE];

    r->places = OTX_NEW(r->run->scratch, double, 3 * r->lines[ELEMENT_POINT]);
    r->points = OTX_NEW(arena, float, 3 * r->lines[ELEMENT_POINT]);
    r->uvs = OTX_NEW(arena, float, 2 * r->lines[ELEMENT_UV]);
    r->face_first = OTX_ZNEW(arena, int32_t, faces + 1);
    r->face_verts = OTX_NEW(arena, int32_t, r->corners);
    r->face_uvs = OTX_NEW(arena, int32_t, r->corners);
    r->face_line = OTX_NEW(arena, int64_t, faces);
    r->point_lines = OTX_NEW(arena, char, r->point_line_bytes);
    OTX_TRY(otx_run_ok(r->run));
    for (int i = 0; i < ATTRIBUTE_COUNT; ++i)
    {
        r->current[i] = -1;
        r->attribute[i] = OTX_NEW(arena, int32_t, faces);
        OTX_TRY(otx_run_ok(r->run));
        OTX_TRY(otx_obj_names_create(
            r->run, (int32_t)r->lines[ELEMENT_GROUP + i], &r->names[i]));
    }
    OTX_TRY(otx_obj_names_create(
        r->run, (int32_t)r->lines[ELEMENT_LIBRARY], &r->libraries));
    return otx_obj_tags_create(r->run, r->tag_values, &r->tags);
}

static otx_status
report_progress(const reader *r)
{
    const double done = (double)(r->text.next - r->text.bytes);

    return otx_progress(
        r->run, STAGE, done / (double)(r->text.end - r->text.bytes));
}

/* The second pass. */
static otx_status
read_elements(reader *r)
{
    otx_token word;

    otx_text_rewind(&r->text);
    for (int64_t i = 1; otx_text_next(&r->text); ++i)
    {
        const keyword *found;

        if (i % LINES_PER_PROGRESS == 0)
            OTX_TRY(report_progress(r));
        if (!otx_text_token(&r->text, &word))
            continue;
        found = find_keyword(word);
        if (found->read)
            OTX_TRY(found->read(r, found->kind));
    }
    return OSDTEX_OK;
}

/* Faces may refer to what comes after them, so that only the whole file can
 * say whether their indices exist. */
static otx_status
check_face(const reader *r, int32_t face)
{
    const otx_obj_index_context vertex = {&r->text, "vertex", face};
    const otx_obj_index_context uv = {&r->text, "texture vertex", face};

    for (int32_t c = r->face_first[face]; c < r->face_first[face + 1]; ++c)
    {
        OTX_TRY(otx_obj_index_check(
            &vertex, r->face_line[face], r->face_verts[c], r->vert_count));
        OTX_TRY(otx_obj_index_check(
            &uv, r->face_line[face], r->face_uvs[c], r->uv_count));
    }
    return OSDTEX_OK;
}

static void
take_origin(const reader *r, otx_obj *obj)
{
    const otx_obj_places places = {r->text.name,  r->places,     r->vert_count,
                                   r->face_count, r->face_first, r->face_verts};

    otx_obj_origin_take(r->run, &places, r->points, obj->origin);
}

static otx_status
finish(const reader *r, otx_obj *out)
{
    otx_obj obj = {
        .path = otx_arena_strdup(r->run->arena, r->text.name),
        .vert_count = r->vert_count,
        .uv_count = r->uv_count,
        .face_count = r->face_count,
        .corner_count = r->corner_count,
        .points = r->points,
        .colors = r->colors,
        .point_lines = r->point_lines,
        .point_line_bytes = r->point_line_used,
        .uvs = r->uvs,
        .face_first = r->face_first,
        .face_verts = r->face_verts,
        .face_uvs = r->face_uvs,
        .face_line = r->face_line,
        .face_group = r->attribute[0],
        .face_object = r->attribute[1],
        .face_material = r->attribute[2],
        .face_smooth = r->attribute[3],
        .groups = otx_obj_names_view(&r->names[0]),
        .objects = otx_obj_names_view(&r->names[1]),
        .materials = otx_obj_names_view(&r->names[2]),
        .smooths = otx_obj_names_view(&r->names[3]),
        .libraries = otx_obj_names_view(&r->libraries)};

    OTX_TRY(otx_run_ok(r->run));
    for (int32_t face = 0; face < r->face_count; ++face)
        OTX_TRY(check_face(r, face));
    take_origin(r, &obj);
    OTX_TRY(otx_obj_tags_finish(&r->tags, &r->text, &obj));
    *out = obj;
    return OSDTEX_OK;
}

static otx_status
read_obj(reader *r, otx_obj *out)
{
    OTX_TRY(count_elements(r));
    note_ignored(r);
    OTX_TRY(create_arrays(r));
    OTX_TRY(read_elements(r));
    return finish(r, out);
}

otx_status
otx_obj_read(otx_run *run, const char *path, otx_obj *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    reader r = {.run = run};
    otx_status status = otx_text_read(run, STAGE, path, MAX_BYTES, &r.text);

    if (status == OSDTEX_OK)
        status = read_obj(&r, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_obj_parse(
    otx_run *run, const char *name, const char *bytes, size_t size,
    otx_obj *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    reader r = {.run = run};
    otx_status status = otx_text_open(run, STAGE, name, bytes, size, &r.text);

    if (status == OSDTEX_OK)
        status = read_obj(&r, out);
    otx_arena_release(run->scratch, mark);
    return status;
}
