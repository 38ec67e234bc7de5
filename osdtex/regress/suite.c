/* suite.c -- reading the table, taking the products. */
#include "regress/suite.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum
{
    NAME_BYTES = 200,
    CASES_MAX = 10000
};

static bool refuse(char *error, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool
refuse(char *error, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(error, OTX_SUITE_ERROR_BYTES, format, arguments);
    va_end(arguments);
    return false;
}

const char *
otx_suite_text(const json_t *item, const char *key)
{
    return json_string_value(json_object_get(item, key));
}

double
otx_suite_number(const otx_suite *suite, const char *key, double fallback)
{
    const json_t *value = json_object_get(suite->table, key);

    return json_is_number(value) ? json_number_value(value) : fallback;
}

/* Appends the file's name without folder and extension, with what shells or
 * URLs would take amiss made `_`. */
static void
append_stem(char name[NAME_BYTES], const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *base = slash ? slash + 1 : path;
    const char *dot = strrchr(base, '.');
    const size_t length =
        dot && dot > base ? (size_t)(dot - base) : strlen(base);
    size_t used = strlen(name);

    if (used > 0 && used + 1 < NAME_BYTES)
        name[used++] = '.';
    for (size_t i = 0; i < length && used + 1 < NAME_BYTES; ++i, ++used)
    {
        const char c = base[i];
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '_';

        name[used] = plain ? c : '_';
    }
    name[used] = '\0';
}

/* `path` of the table, seen from where we are. */
static json_t *
seen_from_here(const otx_suite *suite, const char *path)
{
    return path[0] == '/' ? json_string(path)
                          : json_sprintf("%s/%s", suite->folder, path);
}

/* One place in the product of a row. */
typedef struct choice
{
    const char *cage, *exemplar, *method;
    const char *option_name, *options;
    json_t *tiles; /* NULL none */
    json_t *also;  /* list of [MATERIAL=]FILE, NULL none */
    const char *mask;
    const char *again; /* flags of a bake from the saved mapping, NULL none */
    const char *swap;  /* with another picture, NULL the same */
    const char *stack; /* flags of the stack that is made first, NULL none */
    const char *to;    /* its other end, NULL none */
} choice;

/* The same for "[MATERIAL=]FILE". */
static json_t *
also_from_here(const otx_suite *suite, const char *text)
{
    const char *equals = strchr(text, '=');
    const char *file = equals ? equals + 1 : text;
    json_t *path = seen_from_here(suite, file);
    json_t *word = json_sprintf(
        "%.*s%s", (int)(file - text), text, json_string_value(path));

    json_decref(path);
    return word;
}

/* What divides the surface between exemplars. */
static void
add_several(const otx_suite *suite, const choice *c, json_t *item)
{
    json_t *list = c->also ? json_array() : NULL, *text;
    size_t i;

    json_array_foreach(c->also, i, text)
    {
        json_array_append_new(
            list, also_from_here(suite, json_string_value(text)));
    }
    if (list)
        json_object_set_new(item, "also", list);
    if (c->mask)
        json_object_set_new(item, "mask", seen_from_here(suite, c->mask));
}

/* The stack that the exemplar is made into. */
static void
add_stack(const otx_suite *suite, const choice *c, json_t *item)
{
    if (c->stack)
        json_object_set_new(item, "stack", json_string(c->stack));
    if (c->stack && c->to)
        json_object_set_new(item, "to", seen_from_here(suite, c->to));
}

/* What is done with the mapping once it is saved. */
static void
add_again(const otx_suite *suite, const choice *c, json_t *item)
{
    if (c->again)
        json_object_set_new(item, "again", json_string(c->again));
    if (c->swap)
        json_object_set_new(item, "swap", seen_from_here(suite, c->swap));
}

static bool
add_case(otx_suite *suite, const choice *c, char *error)
{
    char name[NAME_BYTES] = "";
    json_t *item;

    append_stem(name, c->cage);
    append_stem(name, c->exemplar);
    append_stem(name, c->method);
    if (*c->option_name)
        append_stem(name, c->option_name);
    if (json_object_get(suite->cases, name))
        return refuse(
            error,
            "two cases are called '%s'; give their \"options\" other names",
            name);
    item = json_pack(
        "{s:o,s:o,s:s,s:s}", "cage", seen_from_here(suite, c->cage), "exemplar",
        seen_from_here(suite, c->exemplar), "method", c->method, "options",
        c->options);
    if (c->tiles)
        json_object_set(item, "tiles", c->tiles);
    add_several(suite, c, item);
    add_again(suite, c, item);
    add_stack(suite, c, item);
    if (json_object_set_new(suite->cases, name, item) == 0)
        return true;
    return refuse(error, "memory ran out");
}

/* [*count] texts under `key`, each a string. */
static const json_t *
texts_of(const json_t *row, const char *key, size_t index, char *error)
{
    const json_t *list = json_object_get(row, key);
    size_t i;
    json_t *value;

    if (!json_is_array(list) || json_array_size(list) == 0)
    {
        refuse(
            error, "row %zu has no \"%s\": a list of one or more texts", index,
            key);
        return NULL;
    }
    json_array_foreach(list, i, value)
    {
        if (json_is_string(value))
            continue;
        refuse(
            error, "row %zu: in \"%s\", number %zu is no text", index, key, i);
        return NULL;
    }
    return list;
}

/* All options for one cage, exemplar and method. */
static bool
add_options(otx_suite *suite, json_t *row, choice c, char *error)
{
    json_t *options = json_object_get(row, "options");
    const char *name;
    json_t *text;

    c.option_name = c.options = "";
    if (!options)
        return add_case(suite, &c, error);
    json_object_foreach(options, name, text)
    {
        c.option_name = name;
        c.options = json_string_value(text);
        if (!c.options)
            return refuse(error, "the options called '%s' are no text", name);
        if (!add_case(suite, &c, error))
            return false;
    }
    return true;
}

/* What a row says beside its lists; absent is fine. */
static bool
check_row(const json_t *row, size_t index, char *error)
{
    static const char *const texts[] = {
        "tiles", "mask", "again", "swap", "stack", "to"};
    const json_t *options = json_object_get(row, "options");

    for (int i = 0; i < 6; ++i)
    {
        const json_t *value = json_object_get(row, texts[i]);

        if (value && !json_is_string(value))
            return refuse(error, "row %zu: \"%s\" is no text", index, texts[i]);
    }
    if (options && (!json_is_object(options) || json_object_size(options) == 0))
        return refuse(
            error,
            "row %zu: \"options\" is an object of one or more texts, each "
            "under the name that its cases get",
            index);
    return true;
}

/* A table that makes more cases than anybody runs is a mistake; counted before
 * any is made. */
static bool
has_room(
    const otx_suite *suite, const json_t *const lists[3], const json_t *row,
    size_t index, char *error)
{
    const size_t options = json_object_size(json_object_get(row, "options"));
    size_t count = options > 0 ? options : 1;

    for (int i = 0; i < 3; ++i)
        if (count <= CASES_MAX)
            count *= json_array_size(lists[i]) < CASES_MAX
                         ? json_array_size(lists[i])
                         : CASES_MAX + 1;
    if (count + json_object_size(suite->cases) <= CASES_MAX)
        return true;
    return refuse(
        error, "with row %zu the table has more than %d cases; divide it",
        index, CASES_MAX);
}

static bool
add_row(otx_suite *suite, json_t *row, size_t index, char *error)
{
    const json_t *cages = texts_of(row, "cages", index, error);
    const json_t *exemplars =
        cages ? texts_of(row, "exemplars", index, error) : NULL;
    const json_t *methods =
        exemplars ? texts_of(row, "methods", index, error) : NULL;
    json_t *also = json_object_get(row, "also");
    json_t *cage, *exemplar, *method;
    size_t i, k, m;

    if (!methods || (also && !texts_of(row, "also", index, error)) ||
        !check_row(row, index, error) ||
        !has_room(
            suite, (const json_t *const[]){cages, exemplars, methods}, row,
            index, error))
        return false;
    json_array_foreach(cages, i, cage)
    {
        json_array_foreach(exemplars, k, exemplar)
        {
            json_array_foreach(methods, m, method)
            {
                const choice c = {
                    .cage = json_string_value(cage),
                    .exemplar = json_string_value(exemplar),
                    .method = json_string_value(method),
                    .tiles = json_object_get(row, "tiles"),
                    .also = also,
                    .mask = json_string_value(json_object_get(row, "mask")),
                    .again = json_string_value(json_object_get(row, "again")),
                    .swap = json_string_value(json_object_get(row, "swap")),
                    .stack = json_string_value(json_object_get(row, "stack")),
                    .to = json_string_value(json_object_get(row, "to")),
                };

                if (!add_options(suite, row, c, error))
                    return false;
            }
        }
    }
    return true;
}

/* What a table says beside its rows; absent is fine. */
static bool
check_table(const otx_suite *suite, char *error)
{
    static const char *const numbers[] = {"timeout", "threads"};
    const json_t *render = json_object_get(suite->table, "render");
    const json_t *tolerances = json_object_get(suite->table, "tolerances");

    for (int i = 0; i < 2; ++i)
    {
        const json_t *value = json_object_get(suite->table, numbers[i]);

        if (value && !(json_number_value(value) > 0.0))
            return refuse(
                error, "%s/table.json: \"%s\" is no positive number",
                suite->folder, numbers[i]);
    }
    if (render && !json_is_string(render))
        return refuse(
            error, "%s/table.json: \"render\" is no text", suite->folder);
    if (tolerances && !json_is_object(tolerances))
        return refuse(
            error, "%s/table.json: \"tolerances\" is no object", suite->folder);
    return true;
}

static bool
read_table(otx_suite *suite, char *error)
{
    json_error_t wrong;
    char path[OTX_SUITE_PATH_BYTES];
    json_t *rows, *row;
    size_t i;

    snprintf(path, sizeof path, "%s/table.json", suite->folder);
    suite->table = json_load_file(path, JSON_REJECT_DUPLICATES, &wrong);
    if (!suite->table && wrong.line < 0)
        return refuse(error, "%s", wrong.text);
    if (!suite->table)
        return refuse(error, "%.300s:%d: %s", path, wrong.line, wrong.text);
    rows = json_object_get(suite->table, "rows");
    if (!json_is_array(rows) || json_array_size(rows) == 0)
        return refuse(
            error, "%s/table.json has no \"rows\"; see docs/nightly.md",
            suite->folder);
    if (!check_table(suite, error))
        return false;
    json_array_foreach(rows, i, row)
    {
        if (!add_row(suite, row, i, error))
            return false;
    }
    return true;
}

bool
otx_suite_read(
    const char *folder, otx_suite *out, char error[OTX_SUITE_ERROR_BYTES])
{
    *out = (otx_suite){.folder = folder, .cases = json_object()};
    if (out->cases && read_table(out, error))
        return true;
    if (!out->cases)
        refuse(error, "memory ran out");
    otx_suite_free(out);
    return false;
}

void
otx_suite_free(otx_suite *suite)
{
    json_decref(suite->table);
    json_decref(suite->cases);
    *suite = (otx_suite){0};
}
