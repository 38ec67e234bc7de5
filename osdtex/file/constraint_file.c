/* constraint_file.c -- constraints on fields, as JSON or CSV. */
#include "file/constraint_file.h"

#include "bridge/charconv.h"
#include "file/text.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

static const char stage[] = "constraints";

enum
{
    BYTES_MAX = 64 << 20
};

static otx_status
refuse(
    otx_run *run, const char *path, int32_t index, const char *key,
    const char *what)
{
    const otx_where where = {path, 0, -1, -1};

    if (index < 0)
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, stage, where, "\"%.40s\" %s", key, what);
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, stage, where, "constraint %d: \"%.40s\" %s",
        (int)index + 1, key, what);
}

/* -- JSON ---------------------------------------------------------------- */

static bool
read_vector(const json_t *value, double out[3])
{
    if (!json_is_array(value) || json_array_size(value) != 3)
        return false;
    for (size_t i = 0; i < 3; ++i)
    {
        const json_t *number = json_array_get(value, i);

        out[i] = json_number_value(number);
        if (!json_is_number(number) || !isfinite(out[i]))
            return false;
    }
    return true;
}

static bool
read_positive(const json_t *value, double *out)
{
    *out = json_number_value(value);
    return json_is_number(value) && *out > 0.0 && isfinite(*out);
}

static bool
read_face(const json_t *value, int32_t *out)
{
    const json_int_t face = json_integer_value(value);

    *out = (int32_t)face;
    return json_is_integer(value) && face >= 0 && face < INT32_MAX;
}

/* A number from 1, or a name. */
static otx_status
read_exemplar(
    otx_run *run, const char *path, int32_t index, const json_t *value,
    otx_constraint_line *out)
{
    const json_int_t number = json_integer_value(value);
    const char *name = json_string_value(value);

    if (name && *name)
    {
        out->exemplar_name = otx_arena_strdup(run->arena, name);
        return otx_run_ok(run);
    }
    if (number < 1 || number > INT16_MAX)
        return refuse(
            run, path, index, "exemplar",
            "is its number, from 1, or the name of its file");
    out->exemplar = (int32_t)number;
    return OSDTEX_OK;
}

static bool
read_number(const json_t *value, int32_t *out)
{
    const json_int_t number = json_integer_value(value);

    *out = (int32_t)number;
    return json_is_integer(value) && number >= 1 && number <= INT32_MAX;
}

static bool
asks_for_exemplar(const otx_constraint_line *line)
{
    return line->exemplar > 0 || line->exemplar_name;
}

/* Reads a member other than "exemplar". What it is when it is as it should be;
 * NULL when it is. */
static const char *
read_member(const char *key, const json_t *value, otx_constraint_line *out)
{
    static const char *const THREE = "is three numbers";
    static const char *const POSITIVE = "is a positive number";
    static const char *const COUNTED = "is a whole number from 1";

    if (strcmp(key, "face") == 0)
        return read_face(value, &out->face) ? NULL
                                            : "is a face of the cage, from 0";
    if (strcmp(key, "point") == 0)
        return read_vector(value, out->point) ? NULL : THREE;
    if (strcmp(key, "direction") == 0)
    {
        out->has_direction = true;
        return read_vector(value, out->direction) ? NULL : THREE;
    }
    if (strcmp(key, "radius") == 0)
        return read_positive(value, &out->radius) ? NULL : POSITIVE;
    if (strcmp(key, "reach") == 0)
        return read_positive(value, &out->reach) ? NULL : POSITIVE;
    if (strcmp(key, "edit") == 0)
        return read_number(value, &out->edit) ? NULL : COUNTED;
    if (strcmp(key, "redo") == 0)
        return read_number(value, &out->redo) ? NULL : COUNTED;
    if (strcmp(key, "scale") == 0)
        return read_positive(value, &out->scale) ? NULL : POSITIVE;
    if (strcmp(key, "material") == 0)
    {
        out->has_material = true;
        out->material = json_number_value(value);
        return json_is_number(value) && out->material >= 0.0 &&
                       out->material <= 1.0
                   ? NULL
                   : "is a number from 0 to 1";
    }
    return "is not known; there are face, point, radius, direction, scale, "
           "material, exemplar, edit, reach and redo";
}

/* Whether the members go together. */
static otx_status
check_item(
    otx_run *run, const char *path, int32_t index, bool has_point,
    const otx_constraint_line *line)
{
    if ((line->face >= 0) == has_point)
        return refuse(run, path, index, "face", "or \"point\" is needed, one");
    if (line->has_material && asks_for_exemplar(line))
        return refuse(
            run, path, index, "material",
            "and \"exemplar\" say the same; give one");
    if (!line->has_direction && line->scale == 0.0 && !line->has_material &&
        !asks_for_exemplar(line) && line->redo == 0)
        return refuse(
            run, path, index, "direction",
            "or \"scale\", \"material\", \"exemplar\" or \"redo\" is needed");
    return OSDTEX_OK;
}

static otx_status
read_item(
    otx_run *run, const char *path, int32_t index, json_t *item,
    otx_constraint_line *out)
{
    const char *key;
    json_t *value;

    *out = (otx_constraint_line){.face = -1};
    if (!json_is_object(item))
        return refuse(run, path, index, "constraints", "holds objects");
    json_object_foreach(item, key, value)
    {
        const bool is_name = strcmp(key, "exemplar") == 0;
        const char *wanted = is_name ? NULL : read_member(key, value, out);

        if (is_name)
            OTX_TRY(read_exemplar(run, path, index, value, out));
        if (wanted)
            return refuse(run, path, index, key, wanted);
    }
    return check_item(
        run, path, index, json_object_get(item, "point") != NULL, out);
}

static otx_status
read_items(otx_run *run, json_t *list, otx_constraint_file *out)
{
    const size_t count = json_array_size(list);

    if (!json_is_array(list))
        return refuse(run, out->path, -1, "constraints", "is a list");
    out->lines = OTX_NEW(run->arena, otx_constraint_line, count);
    OTX_TRY(otx_run_ok(run));
    for (; out->count < (int32_t)count; ++out->count)
        OTX_TRY(read_item(
            run, out->path, out->count,
            json_array_get(list, (size_t)out->count), &out->lines[out->count]));
    return OSDTEX_OK;
}

static bool
read_follow(const json_t *value, otx_constraint_file *out)
{
    static const char *const words[] = {"up", "edges", "curvature"};
    const char *text = json_string_value(value);

    for (int i = 0; text && i < 3; ++i)
        if (strcmp(text, words[i]) == 0)
        {
            out->follow = words[i];
            return true;
        }
    out->follow = "axis";
    return read_vector(value, out->axis);
}

static otx_status
read_root(otx_run *run, json_t *root, otx_constraint_file *out)
{
    const char *key;
    json_t *value;

    if (!json_is_object(root))
        return refuse(
            run, out->path, -1, "constraints", "must be in an object");
    json_object_foreach(root, key, value)
    {
        if (strcmp(key, "constraints") == 0)
            OTX_TRY(read_items(run, value, out));
        else if (strcmp(key, "follow") == 0)
        {
            if (!read_follow(value, out))
                return refuse(
                    run, out->path, -1, key,
                    "is three numbers, \"up\", \"edges\" or \"curvature\"");
        }
        else if (strcmp(key, "follow-length") == 0)
        {
            if (!read_positive(value, &out->follow_length))
                return refuse(run, out->path, -1, key, "is a positive number");
        }
        else if (strcmp(key, "symmetry") == 0)
        {
            const json_int_t s = json_integer_value(value);

            if (s != 1 && s != 2 && s != 4)
                return refuse(run, out->path, -1, key, "is 1, 2 or 4");
            out->symmetry = (int32_t)s;
        }
        else
            return refuse(
                run, out->path, -1, key,
                "is not known; there are symmetry, follow, follow-length and "
                "constraints");
    }
    return OSDTEX_OK;
}

static void
drop(void *root)
{
    json_decref(root);
}

static otx_status
read_json(
    otx_run *run, const char *bytes, size_t size, otx_constraint_file *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    json_error_t error;
    json_t *root = json_loadb(bytes, size, JSON_REJECT_DUPLICATES, &error);

    if (!root)
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, stage,
            (otx_where){out->path, error.line, -1, -1}, "no JSON: %.100s",
            error.text);
    if (!otx_arena_defer(run->scratch, drop, root))
    {
        json_decref(root);
        return otx_fail_memory(run, stage);
    }

    const otx_status status = read_root(run, root, out);

    otx_arena_release(run->scratch, mark);
    return status;
}

/* -- CSV ----------------------------------------------------------------- */

/* Numbers of one line, separated by commas; -1 when it is something else. */
static int
read_numbers(otx_token line, double *out, int capacity)
{
    const char *at = line.begin;
    int count = 0;

    for (;; ++at)
    {
        while (at < line.end && (*at == ' ' || *at == '\t'))
            ++at;
        if (count == capacity ||
            otx_charconv_read_double(at, line.end, &out[count], &at) !=
                OTX_CHARCONV_OK)
            return -1;
        ++count;
        while (at < line.end && (*at == ' ' || *at == '\t'))
            ++at;
        if (at == line.end)
            return count;
        if (*at != ',')
            return -1;
    }
}

/* Whether the sixth number is the exemplar's, 0 for none. */
static bool
names_exemplar(otx_token line)
{
    static const char name[] = "exemplar";
    const char *at = line.begin;

    for (int comma = 0; comma < 5 && at < line.end; ++at)
        comma += *at == ',';
    while (at < line.end && *at == ' ')
        ++at;
    return (size_t)(line.end - at) >= strlen(name) &&
           memcmp(at, name, strlen(name)) == 0;
}

static bool
is_exemplar(double number)
{
    return number >= 0.0 && number <= INT16_MAX && number == floor(number);
}

static otx_status
read_row(
    otx_run *run, const otx_text *text, bool by_exemplar, const double *n,
    int count, otx_constraint_line *out)
{
    if (count < 4 || n[0] < 0.0 || n[0] >= INT32_MAX || n[0] != floor(n[0]) ||
        !isfinite(n[1] + n[2] + n[3]) ||
        (count >= 5 && !(n[4] > 0.0 && isfinite(n[4]))) ||
        (count == 6 && !by_exemplar && !(n[5] >= 0.0 && n[5] <= 1.0)) ||
        (count == 6 && by_exemplar && !is_exemplar(n[5])))
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, stage, otx_text_where(text),
            "a line is face,x,y,z or face,x,y,z,scale or "
            "face,x,y,z,scale,material: a face of the cage from 0, a "
            "direction, a positive factor, and a number from 0 to 1, or from "
            "1 where the first line says exemplar");
    *out = (otx_constraint_line){
        .face = (int32_t)n[0],
        .has_direction = n[1] != 0.0 || n[2] != 0.0 || n[3] != 0.0,
        .direction = {n[1], n[2], n[3]},
        .scale = count >= 5 ? n[4] : 0.0,
        .has_material = count == 6 && !by_exemplar,
        .material = count == 6 && !by_exemplar ? n[5] : 0.0,
        .exemplar = count == 6 && by_exemplar ? (int32_t)n[5] : 0};
    return OSDTEX_OK;
}

/* The first line may name the columns; only the sixth is looked at. */
static otx_status
read_csv(otx_run *run, otx_text *text, otx_constraint_file *out)
{
    int32_t capacity = 0;
    bool first = true, by_exemplar = false;

    while (otx_text_next(text))
        ++capacity;
    otx_text_rewind(text);
    out->lines = OTX_NEW(run->arena, otx_constraint_line, capacity);
    OTX_TRY(otx_run_ok(run));
    while (otx_text_next(text))
    {
        const otx_token line = otx_text_remainder(text);
        double numbers[6];
        int count;

        if (line.begin == line.end || *line.begin == '#')
            continue;
        count = read_numbers(line, numbers, 6);
        if (count >= 0 || !first)
            OTX_TRY(read_row(
                run, text, by_exemplar, numbers, count,
                &out->lines[out->count++]));
        else
            by_exemplar = names_exemplar(line);
        first = false;
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
otx_constraint_file_read(
    otx_run *run, const char *path, otx_constraint_file *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_text text;
    otx_status status;

    *out = (otx_constraint_file){
        .path = otx_arena_strdup(run->arena, path), .is_table = is_csv(path)};
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_text_read(run, stage, path, BYTES_MAX, &text));
    status =
        out->is_table
            ? read_csv(run, &text, out)
            : read_json(run, text.bytes, (size_t)(text.end - text.bytes), out);
    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_constraint_file_parse(
    otx_run *run, const char *path, const char *json, otx_constraint_file *out)
{
    *out = (otx_constraint_file){.path = otx_arena_strdup(run->arena, path)};
    OTX_TRY(otx_run_ok(run));
    return read_json(run, json, strlen(json), out);
}
