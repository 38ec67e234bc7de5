/* tensors.c -- arrays in a file, by name. */
#include "file/tensors.h"

#include "file/mark.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char STAGE[] = "mapping";

static const char *const TYPES[OTX_TENSOR_TYPE_COUNT] = {
    "F64", "I64", "F32", "I32", "U8"};

static const size_t SIZES[OTX_TENSOR_TYPE_COUNT] = {8, 8, 4, 4, 1};

static void
drop_json(void *json)
{
    json_decref(json);
}

void
otx_tensors_add(
    otx_tensors *tensors, const char *name, otx_tensor_type type, int64_t rows,
    int64_t columns, const void *data)
{
    otx_tensor *t = &tensors->items[tensors->count++];

    *t = (otx_tensor){
        .type = type, .rows = rows, .columns = columns, .data = data};
    snprintf(t->name, sizeof t->name, "%s", name);
}

const otx_tensor *
otx_tensors_find(
    const otx_tensors *tensors, const char *name, otx_tensor_type type,
    int64_t rows, int64_t columns)
{
    for (int32_t i = 0; i < tensors->count; ++i)
    {
        const otx_tensor *t = &tensors->items[i];

        if (strcmp(t->name, name) == 0 && t->type == type &&
            (rows < 0 || t->rows == rows) &&
            (columns < 0 || t->columns == columns))
            return t;
    }
    return NULL;
}

/* Rows times columns, of a vector rows; -1 when that cannot be. */
static int64_t
bytes_of(const otx_tensor *t)
{
    const int64_t columns = t->columns > 0 ? t->columns : 1;
    const int64_t most = INT64_MAX / 8 / columns;

    return t->rows >= 0 && t->rows <= most
               ? t->rows * columns * (int64_t)SIZES[t->type]
               : -1;
}

/* ---- writing ---- */

static json_t *
describe(const otx_tensor *t, int64_t offset)
{
    json_t *shape = json_array();

    json_array_append_new(shape, json_integer(t->rows));
    if (t->columns > 0)
        json_array_append_new(shape, json_integer(t->columns));
    return json_pack(
        "{s:s, s:o, s:[I, I]}", "dtype", TYPES[t->type], "shape", shape,
        "data_offsets", (json_int_t)offset, (json_int_t)(offset + bytes_of(t)));
}

/* Sorted, it opens the header, where the mark is looked for. */
static json_t *
metadata_of(const otx_run *run, const otx_tensors *tensors)
{
    char mark[OTX_MARK_BYTES];

    otx_mark_print(run->mark, mark);
    return json_pack(
        "{s:s*, s:s*}", "mark", *mark ? mark : NULL, "osdtex", tensors->about);
}

/* The header's text, padded with blanks so that the data are aligned; NULL when
 * memory is out. */
static char *
header_of(otx_run *run, const otx_tensors *tensors)
{
    json_t *root = json_object();
    int64_t offset = 0;
    char *text, *out;
    size_t length;

    if (tensors->about)
        json_object_set_new(root, "__metadata__", metadata_of(run, tensors));
    for (int32_t i = 0; i < tensors->count; ++i)
    {
        json_object_set_new(
            root, tensors->items[i].name, describe(&tensors->items[i], offset));
        offset += bytes_of(&tensors->items[i]);
    }
    text = json_dumps(root, JSON_COMPACT | JSON_SORT_KEYS);
    json_decref(root);
    if (!text)
        return NULL;
    length = (8 + strlen(text) + 63) / 64 * 64 - 8;
    out = OTX_NEW(run->scratch, char, length + 1);
    if (out)
        snprintf(out, length + 1, "%-*s", (int)length, text);
    free(text);
    return out;
}

static bool
put_all(FILE *file, const otx_tensors *tensors, const char *header)
{
    const size_t length = strlen(header);
    uint8_t prefix[8];

    for (int k = 0; k < 8; ++k)
        prefix[k] = (uint8_t)((uint64_t)length >> 8 * k);
    if (fwrite(prefix, 1, 8, file) != 8 ||
        fwrite(header, 1, length, file) != length)
        return false;
    for (int32_t i = 0; i < tensors->count; ++i)
    {
        const size_t bytes = (size_t)bytes_of(&tensors->items[i]);

        if (bytes > 0 &&
            fwrite(tensors->items[i].data, 1, bytes, file) != bytes)
            return false;
    }
    return true;
}

otx_status
otx_tensors_write(
    otx_run *run, const otx_tensors *tensors, const char *temporary,
    const char *path)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    char *header = header_of(run, tensors);
    FILE *file = header ? fopen(temporary, "wb") : NULL;
    bool done;

    if (!header)
        return otx_fail_memory(run, STAGE);
    done = file && put_all(file, tensors, header);
    done = (!file || fclose(file) == 0) && done;
    otx_arena_release(run->scratch, mark);
    if (done)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_IO, STAGE, otx_where_file(path),
        "the file cannot be written: %s", strerror(errno));
}

/* ---- reading ---- */

typedef struct reader
{
    otx_run *run;
    otx_where where;
    const uint8_t *data;
    int64_t data_bytes;
} reader;

static otx_status
refuse(const reader *r, const char *what)
{
    return otx_fail(
        r->run, OSDTEX_ERROR_FORMAT, STAGE, r->where,
        "this is no saved mapping, or a damaged one: %s", what);
}

static otx_status
read_shape(const reader *r, const json_t *shape, otx_tensor *out)
{
    const size_t rank = json_array_size(shape);
    const json_t *rows = json_array_get(shape, 0);
    const json_t *columns = json_array_get(shape, 1);

    if (!json_is_array(shape) || rank < 1 || rank > 2 ||
        !json_is_integer(rows) || (columns && !json_is_integer(columns)) ||
        json_integer_value(rows) < 0 ||
        (columns && (json_integer_value(columns) < 1 ||
                     json_integer_value(columns) > 1 << 20)))
        return refuse(r, "an array has no shape");
    out->rows = json_integer_value(rows);
    out->columns = columns ? json_integer_value(columns) : 0;
    return OSDTEX_OK;
}

static otx_status
read_place(const reader *r, const json_t *place, otx_tensor *out)
{
    const json_t *from = json_array_get(place, 0);
    const json_t *to = json_array_get(place, 1);
    const int64_t bytes = bytes_of(out);
    int64_t begin, end;

    if (json_array_size(place) != 2 || !json_is_integer(from) ||
        !json_is_integer(to))
        return refuse(r, "an array has no place");
    begin = json_integer_value(from);
    end = json_integer_value(to);
    if (begin < 0 || end < begin || end > r->data_bytes || bytes < 0 ||
        end - begin != bytes)
        return refuse(r, "an array does not lie in the file as its shape says");
    if ((uint64_t)begin % SIZES[out->type] != 0)
        return refuse(r, "an array is not aligned");
    out->data = r->data + begin;
    return OSDTEX_OK;
}

static otx_status
read_tensor(
    const reader *r, const char *name, const json_t *json, otx_tensor *out)
{
    const char *type = json_string_value(json_object_get(json, "dtype"));
    int k = 0;

    if (strlen(name) >= sizeof out->name)
        return refuse(r, "an array has too long a name");
    snprintf(out->name, sizeof out->name, "%s", name);
    while (k < OTX_TENSOR_TYPE_COUNT && type && strcmp(type, TYPES[k]) != 0)
        ++k;
    if (!type || k == OTX_TENSOR_TYPE_COUNT)
        return refuse(r, "an array is of a type that mappings do not have");
    out->type = (otx_tensor_type)k;
    OTX_TRY(read_shape(r, json_object_get(json, "shape"), out));
    return read_place(r, json_object_get(json, "data_offsets"), out);
}

static otx_status
read_header(const reader *r, json_t *root, otx_tensors *out)
{
    const char *name;
    json_t *value;

    if (!json_is_object(root))
        return refuse(r, "its header is no JSON object");
    json_object_foreach(root, name, value)
    {
        if (strcmp(name, "__metadata__") == 0)
        {
            const char *about =
                json_string_value(json_object_get(value, "osdtex"));

            if (!about)
                continue;
            out->about = otx_arena_strdup(r->run->arena, about);
            OTX_TRY(otx_run_ok(r->run));
            continue;
        }
        if (out->count == OTX_TENSORS_MAX)
            return refuse(r, "it has too many arrays");
        OTX_TRY(read_tensor(r, name, value, &out->items[out->count++]));
    }
    return OSDTEX_OK;
}

/* Where the data begin; -1 where there is no header of a length that fits. */
static int64_t
header_end(const uint8_t *bytes, size_t size)
{
    uint64_t length = 0;

    for (int k = 0; size >= 8 && k < 8; ++k)
        length |= (uint64_t)bytes[k] << 8 * k;
    return size >= 8 && length <= OTX_TENSORS_HEADER_MAX && length <= size - 8
               ? (int64_t)length + 8
               : -1;
}

otx_status
otx_tensors_parse(
    otx_run *run, const char *path, const void *bytes, size_t size,
    otx_tensors *out)
{
    const uint8_t *from = bytes;
    const int64_t begin = header_end(from, size);
    reader r = {run, otx_where_file(path), NULL, 0};
    json_t *root;

    *out = (otx_tensors){0};
    if (begin < 0)
        return refuse(&r, "its header has no length");
    /* Copied only where a foreign writer did not align the header. */
    r.data = from + begin;
    r.data_bytes = (int64_t)size - begin;
    if ((uintptr_t)r.data % 8 != 0)
    {
        uint8_t *copy = OTX_NEW(run->arena, uint8_t, r.data_bytes);

        OTX_TRY(otx_run_ok(run));
        memcpy(copy, r.data, (size_t)r.data_bytes);
        r.data = copy;
    }
    root = json_loadb(
        (const char *)from + 8, (size_t)begin - 8, JSON_REJECT_DUPLICATES,
        NULL);
    if (!root)
        return refuse(&r, "its header is no JSON");
    if (!otx_arena_defer(run->scratch, drop_json, root))
    {
        json_decref(root);
        return otx_fail_memory(run, STAGE);
    }
    return read_header(&r, root, out);
}

static otx_status
slurp(otx_run *run, const char *path, uint8_t **bytes, size_t *size)
{
    const otx_where where = otx_where_file(path);
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat status;
    size_t got = 0;
    ssize_t n = 1;

    if (file < 0 || fstat(file, &status) != 0 || !S_ISREG(status.st_mode))
    {
        const int why = file < 0 ? errno : EINVAL;

        if (file >= 0)
            close(file);
        return otx_fail(
            run, OSDTEX_ERROR_IO, STAGE, where,
            "the saved mapping cannot be opened: %s", strerror(why));
    }
    *size = (size_t)status.st_size;
    *bytes = OTX_NEW(run->arena, uint8_t, *size + 1);
    while (*bytes && got < *size && n > 0)
    {
        n = read(file, *bytes + got, *size - got);
        got += n > 0 ? (size_t)n : 0;
    }
    close(file);
    OTX_TRY(otx_run_ok(run));
    if (got < *size)
        return otx_fail(
            run, OSDTEX_ERROR_IO, STAGE, where,
            "the saved mapping cannot be read to its end");
    return OSDTEX_OK;
}

otx_status
otx_tensors_read(otx_run *run, const char *path, otx_tensors *out)
{
    uint8_t *bytes = NULL;
    size_t size = 0;

    *out = (otx_tensors){0};
    OTX_TRY(slurp(run, path, &bytes, &size));
    return otx_tensors_parse(run, path, bytes, size, out);
}
