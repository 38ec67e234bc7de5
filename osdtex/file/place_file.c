/* place_file.c -- pictures that are to be placed, as JSON or CSV. */
#include "file/place_file.h"

#include "bridge/charconv.h"
#include "file/text.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

static const char STAGE[] = "place";

enum
{
    BYTES_MAX = 64 << 20,
    NAME_BYTES = 4096
};

/* A file as it is read. */
typedef struct reader
{
    otx_run *run;
    otx_place_file *out;
    int32_t capacity;
} reader;

static const otx_place_line EMPTY = {
    .face = -1, .opacity = 1.0, .anchor = {0.5, 0.5}};

static otx_status
refuse(const reader *r, int32_t number, const char *key, const char *what)
{
    return otx_fail(
        r->run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(r->out->path),
        "placed %d: \"%.40s\" %s", (int)number, key, what);
}

static otx_status
append(reader *r, const otx_place_line *line)
{
    otx_place_file *f = r->out;

    if (f->count == r->capacity)
    {
        const int32_t capacity = 2 * r->capacity + 16;
        otx_place_line *grown =
            OTX_NEW(r->run->arena, otx_place_line, capacity);

        if (!grown)
            return otx_fail_memory(r->run, STAGE);
        if (f->count > 0)
            memcpy(grown, f->lines, (size_t)f->count * sizeof *grown);
        f->lines = grown;
        r->capacity = capacity;
    }
    f->lines[f->count++] = *line;
    return OSDTEX_OK;
}

/* A picture's name is from the file's folder, unless it is from the root. */
static otx_status
find_picture(reader *r, const char *name, const char **out)
{
    static const char PIPE[] = "/proc/self/fd/";
    const char *slash = strrchr(r->out->path, '/');
    const bool as_it_is = name[0] == '/' || !slash ||
                          strncmp(r->out->path, PIPE, sizeof PIPE - 1) == 0;
    const size_t folder = as_it_is ? 0 : (size_t)(slash + 1 - r->out->path);
    const size_t length = strlen(name);
    char *path = OTX_NEW(r->run->arena, char, folder + length + 1);

    if (!path)
        return otx_fail_memory(r->run, STAGE);
    memcpy(path, r->out->path, folder);
    memcpy(path + folder, name, length + 1);
    *out = path;
    return OSDTEX_OK;
}

/* ---- what is asked of an item, however it is written ---- */

/* Numbers by their names in both formats; what is wrong with one, or NULL. */
static const char *
set_number(otx_place_line *line, const char *key, double value)
{
    if (!isfinite(value))
        return "is not finite";
    if (strcmp(key, "face") == 0)
    {
        line->face = (int32_t)fmin(fmax(value, -1.0), INT32_MAX - 1);
        return value >= 0.0 && value == floor(value) && value < INT32_MAX
                   ? NULL
                   : "is a face of the cage, from 0";
    }
    if (strcmp(key, "scatter") == 0)
    {
        line->scatter = (int32_t)fmin(fmax(value, 0.0), OTX_PLACE_SCATTER_MAX);
        return value >= 1.0 && value == floor(value) &&
                       value <= OTX_PLACE_SCATTER_MAX
                   ? NULL
                   : "is how many are to lie anywhere, 1 to 10000";
    }
    if (strcmp(key, "width") == 0 || strcmp(key, "height") == 0)
    {
        *(key[0] == 'w' ? &line->width : &line->height) = value;
        return value > 0.0 ? NULL : "is a positive number of scene units";
    }
    if (strcmp(key, "opacity") == 0)
    {
        line->opacity = value;
        return value >= 0.0 && value <= 1.0 ? NULL : "is a number from 0 to 1";
    }
    line->turn = value; /* the only one that is left */
    return NULL;
}

static bool
is_number_key(const char *key)
{
    static const char *const keys[] = {
        "face", "scatter", "width", "height", "opacity", "turn"};

    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
        if (strcmp(key, keys[i]) == 0)
            return true;
    return false;
}

static otx_status
check_line(const reader *r, const otx_place_line *line, int places)
{
    if (!line->picture)
        return refuse(
            r, line->number, "picture", "is needed: the name of a file");
    if (!(line->width > 0.0))
        return refuse(r, line->number, "width", "is needed, in scene units");
    if (places != 1)
        return refuse(
            r, line->number, "face",
            "or \"point\", \"faces\", \"points\" or \"scatter\" is needed, one "
            "of them");
    return OSDTEX_OK;
}

/* ---- JSON ---- */

static bool
read_numbers(const json_t *value, size_t count, double *out)
{
    if (!json_is_array(value) || json_array_size(value) != count)
        return false;
    for (size_t i = 0; i < count; ++i)
    {
        const json_t *number = json_array_get(value, i);

        out[i] = json_number_value(number);
        if (!json_is_number(number) || !isfinite(out[i]))
            return false;
    }
    return true;
}

/* The members that are not plain numbers; what is wrong with one, or NULL. */
static const char *
set_member(otx_place_line *line, const char *key, const json_t *value)
{
    if (strcmp(key, "point") == 0)
        return read_numbers(value, 3, line->point) ? NULL : "is three numbers";
    if (strcmp(key, "up") == 0)
    {
        line->has_up = true;
        return read_numbers(value, 3, line->up) &&
                       hypot(hypot(line->up[0], line->up[1]), line->up[2]) > 0.0
                   ? NULL
                   : "is a direction: three numbers that are not all 0";
    }
    if (strcmp(key, "anchor") == 0)
        return read_numbers(value, 2, line->anchor) && line->anchor[0] >= 0.0 &&
                       line->anchor[0] <= 1.0 && line->anchor[1] >= 0.0 &&
                       line->anchor[1] <= 1.0
                   ? NULL
                   : "is two numbers from 0 to 1: what of the picture lies at "
                     "the place, from its lower left";
    if (strcmp(key, "mirror") == 0)
    {
        line->mirror = json_is_true(value);
        return json_is_boolean(value) ? NULL : "is true or false";
    }
    return "is not known; there are picture, from, face, faces, point, points, "
           "scatter, width, height, up, turn, anchor, mirror and opacity";
}

static otx_status
set_text(reader *r, const json_t *value, const char *key, otx_place_line *line)
{
    const char *text = json_string_value(value);

    if (!text || !*text)
        return refuse(
            r, line->number, key,
            key[0] == 'p' ? "is the name of a file" : "is a colour space");
    if (key[0] == 'p')
        return find_picture(r, text, &line->picture);
    line->from = otx_arena_strdup(r->run->arena, text);
    return otx_run_ok(r->run);
}

/* As many lines as there are places. */
static otx_status
append_places(reader *r, const json_t *item, otx_place_line line)
{
    const json_t *faces = json_object_get(item, "faces");
    const json_t *points = json_object_get(item, "points");
    const json_t *list = faces ? faces : points;

    if (!list)
        return append(r, &line);
    if (!json_is_array(list) || json_array_size(list) == 0)
        return refuse(
            r, line.number, faces ? "faces" : "points",
            "is a list of one or more");
    for (size_t i = 0; i < json_array_size(list); ++i)
    {
        const json_t *value = json_array_get(list, i);

        if (faces &&
            (!json_is_integer(value) ||
             set_number(&line, "face", (double)json_integer_value(value))))
            return refuse(
                r, line.number, "faces", "holds faces of the cage, from 0");
        if (points && !read_numbers(value, 3, line.point))
            return refuse(
                r, line.number, "points", "holds lists of three numbers");
        OTX_TRY(append(r, &line));
    }
    return OSDTEX_OK;
}

static otx_status
read_item(reader *r, int32_t number, json_t *item)
{
    static const char *const places[] = {
        "face", "faces", "point", "points", "scatter"};
    otx_place_line line = EMPTY;
    const char *key;
    json_t *value;
    int count = 0;

    line.number = number;
    if (!json_is_object(item))
        return refuse(r, number, "placed", "holds objects");
    json_object_foreach(item, key, value)
    {
        const char *wrong = NULL;

        if (strcmp(key, "picture") == 0 || strcmp(key, "from") == 0)
            OTX_TRY(set_text(r, value, key, &line));
        else if (is_number_key(key))
            wrong = json_is_number(value)
                        ? set_number(&line, key, json_number_value(value))
                        : "is a number";
        else if (strcmp(key, "faces") != 0 && strcmp(key, "points") != 0)
            wrong = set_member(&line, key, value);
        if (wrong)
            return refuse(r, number, key, wrong);
    }
    for (int i = 0; i < 5; ++i)
        count += json_object_get(item, places[i]) != NULL;
    OTX_TRY(check_line(r, &line, count));
    return append_places(r, item, line);
}

static otx_status
read_root(reader *r, json_t *root)
{
    json_t *list = json_object_get(root, "placed");

    if (!json_is_object(root) || json_object_size(root) != 1 ||
        !json_is_array(list))
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(r->out->path),
            "the file is an object with one member, \"placed\", which is a "
            "list");
    for (size_t i = 0; i < json_array_size(list); ++i)
        OTX_TRY(read_item(r, (int32_t)i + 1, json_array_get(list, i)));
    return OSDTEX_OK;
}

static void
drop(void *root)
{
    json_decref(root);
}

static otx_status
read_json(reader *r, const otx_text *text)
{
    json_error_t error;
    json_t *root = json_loadb(
        text->bytes, (size_t)(text->end - text->bytes), JSON_REJECT_DUPLICATES,
        &error);

    if (!root)
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE,
            (otx_where){r->out->path, error.line, -1, -1}, "no JSON: %.100s",
            error.text);
    if (!otx_arena_defer(r->run->scratch, drop, root))
    {
        json_decref(root);
        return otx_fail_memory(r->run, STAGE);
    }
    return read_root(r, root);
}

/* ---- CSV ---- */

enum
{
    COLUMNS_MAX = 16
};

/* The columns that there are, in the order of their bits. */
static const char *const COLUMNS[] = {
    "picture", "face", "x",  "y",    "z",      "width",   "height",
    "ux",      "uy",   "uz", "turn", "mirror", "opacity", "scatter"};

enum
{
    COLUMN_COUNT = sizeof COLUMNS / sizeof *COLUMNS
};

/* Takes what is before the next comma, without blanks around it; false at the
 * end of the line. */
static bool
next_cell(otx_token *rest, otx_token *out)
{
    const char *comma;

    if (!rest->begin)
        return false;
    comma = memchr(rest->begin, ',', (size_t)(rest->end - rest->begin));
    *out = (otx_token){rest->begin, comma ? comma : rest->end};
    rest->begin = comma ? comma + 1 : NULL;
    while (out->begin < out->end && (*out->begin == ' ' || *out->begin == '\t'))
        ++out->begin;
    while (out->end > out->begin &&
           (out->end[-1] == ' ' || out->end[-1] == '\t'))
        --out->end;
    return true;
}

static otx_status
refuse_row(const reader *r, const otx_text *text, const char *what)
{
    return otx_fail(
        r->run, OSDTEX_ERROR_FORMAT, STAGE, otx_text_where(text), "%s", what);
}

/* Which of the columns each cell of the first line names. */
static otx_status
read_names(
    const reader *r, const otx_text *text, otx_token line,
    int columns[COLUMNS_MAX], int *count)
{
    otx_token cell;

    *count = 0;
    while (next_cell(&line, &cell))
    {
        int c = 0;

        while (c < COLUMN_COUNT && !otx_token_is(cell, COLUMNS[c]))
            ++c;
        if (c == COLUMN_COUNT || *count == COLUMNS_MAX)
            return refuse_row(
                r, text,
                "the first line names the columns: picture, width, and of "
                "face, x, y, z, height, ux, uy, uz, turn, mirror, opacity and "
                "scatter what is needed");
        columns[(*count)++] = c;
    }
    return OSDTEX_OK;
}

/* A number of one of the columns; what is wrong with it, or NULL. */
static const char *
set_cell(otx_place_line *line, const char *name, double value)
{
    if (!isfinite(value))
        return "is not finite";
    if (strcmp(name, "mirror") == 0)
    {
        line->mirror = value != 0.0;
        return NULL;
    }
    if (name[0] == 'u')
    {
        line->has_up = true;
        line->up[name[1] - 'x'] = value;
        return NULL;
    }
    if (name[1] == '\0')
    {
        line->point[name[0] - 'x'] = value;
        return NULL;
    }
    return set_number(line, name, value);
}

/* Cells that are empty say nothing. */
static otx_status
read_cell(
    reader *r, const otx_text *text, int column, otx_token cell,
    otx_place_line *line)
{
    const char *end = cell.end, *wrong;
    double value;

    if (cell.begin == cell.end)
        return OSDTEX_OK;
    if (column == 0)
    {
        const char *name = otx_token_copy(r->run->scratch, cell);

        return name ? find_picture(r, name, &line->picture)
                    : otx_fail_memory(r->run, STAGE);
    }
    if (otx_charconv_read_double(cell.begin, cell.end, &value, &end) !=
            OTX_CHARCONV_OK ||
        end != cell.end)
        return refuse_row(r, text, "a cell is no number");
    wrong = set_cell(line, COLUMNS[column], value);
    if (wrong)
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, STAGE, otx_text_where(text), "%s %s",
            COLUMNS[column], wrong);
    return OSDTEX_OK;
}

static otx_status
read_row(
    reader *r, const otx_text *text, otx_token rest, const int *columns,
    int count)
{
    otx_place_line line = EMPTY;
    uint32_t given = 0;
    otx_token cell;
    int c = 0;

    line.number = r->out->count + 1;
    for (; next_cell(&rest, &cell); ++c)
    {
        if (c == count)
            return refuse_row(
                r, text, "the line has more cells than the first one");
        OTX_TRY(read_cell(r, text, columns[c], cell, &line));
        if (cell.begin < cell.end)
            given |= 1u << columns[c];
    }
    if (line.has_up &&
        !(hypot(hypot(line.up[0], line.up[1]), line.up[2]) > 0.0))
        line.has_up = false;
    OTX_TRY(check_line(
        r, &line,
        (int)((given >> 1 & 1) + ((given >> 2 & 7) == 7) + (given >> 13 & 1))));
    return append(r, &line);
}

static otx_status
read_csv(reader *r, otx_text *text)
{
    int columns[COLUMNS_MAX], count = 0;

    while (otx_text_next(text))
    {
        const otx_token line = otx_text_remainder(text);

        if (line.begin == line.end || *line.begin == '#')
            continue;
        if (count == 0)
            OTX_TRY(read_names(r, text, line, columns, &count));
        else
            OTX_TRY(read_row(r, text, line, columns, count));
    }
    return OSDTEX_OK;
}

static bool
is_csv(const char *path)
{
    const size_t length = strlen(path);

    return length > 4 && strcmp(path + length - 4, ".csv") == 0;
}

otx_status
otx_place_file_read(otx_run *run, const char *path, otx_place_file *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    reader r = {.run = run, .out = out};
    otx_text text;
    otx_status status;

    *out = (otx_place_file){.path = otx_arena_strdup(run->arena, path)};
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_text_read(run, STAGE, path, BYTES_MAX, &text));
    status = is_csv(path) ? read_csv(&r, &text) : read_json(&r, &text);
    otx_arena_release(run->scratch, mark);
    return status;
}
