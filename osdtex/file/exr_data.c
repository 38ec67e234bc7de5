/* exr_data.c -- channels gathered into layers by their names. */
#include "file/exr_data.h"

#include "file/exr_core.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char STAGE[] = "picture";

/* What a channel is within its layer: the place of its last word here, in
 * threes; -1: the whole name is a layer's. */
static int
place_of(const char *entry, size_t *layer_bytes)
{
    static const char *const words[] = {"R", "G", "B", "X", "Y", "Z", "A", "V"};
    const char *dot = strrchr(entry, '.');
    const char *word = dot ? dot + 1 : entry;

    *layer_bytes = dot ? (size_t)(dot - entry) : 0;
    for (int i = 0; i < (int)(sizeof words / sizeof *words); ++i)
        if (strcasecmp(words[i], word) == 0)
            return i;
    *layer_bytes = strlen(entry);
    return -1;
}

static bool
is_flat(exr_const_context_t file, int part)
{
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;

    return exr_get_storage(file, part, &storage) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED);
}

/* "part.layer" of channel i, as printable ASCII in `arena`; NULL: no memory. */
static char *
name_of(
    otx_arena *arena, exr_const_context_t file, int part, const char *entry,
    size_t layer_bytes)
{
    const char *before = NULL;
    size_t bytes;
    char *name;

    if (exr_get_name(file, part, &before) != EXR_ERR_SUCCESS || !before)
        before = "";
    bytes = strlen(before) + layer_bytes + 2;
    name = OTX_NEW(arena, char, bytes);
    if (!name)
        return NULL;
    snprintf(
        name, bytes, "%s%s%.*s", before, *before && layer_bytes ? "." : "",
        (int)layer_bytes, entry);
    for (char *c = name; *c; ++c)
        if (*c < ' ' || *c > '~')
            *c = '?';
    return name;
}

bool
otx_exr_data_is_there(const char *path)
{
    static const uint8_t wanted[4] = {0x76, 0x2F, 0x31, 0x01};
    uint8_t magic[4] = {0};
    FILE *file = fopen(path, "rb");
    bool found;

    if (!file)
        return false;
    found = fread(magic, 1, 4, file) == 4 && memcmp(magic, wanted, 4) == 0;
    fclose(file);
    return found;
}

/* ---- the list ------------------------------------------------------------ */

static otx_status
add(otx_run *run, char *name, otx_exr_data_list *out)
{
    if (!name)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < out->count; ++i)
        if (strcmp(out->names[i], name) == 0)
            return OSDTEX_OK;
    out->names[out->count++] = name;
    return OSDTEX_OK;
}

static otx_status
list_part(
    otx_run *run, exr_const_context_t file, int part, otx_exr_data_list *out)
{
    const exr_attr_chlist_t *list = NULL;

    if (!is_flat(file, part) ||
        exr_get_channels(file, part, &list) != EXR_ERR_SUCCESS)
        return OSDTEX_OK;
    for (int32_t i = 0; i < list->num_channels; ++i)
    {
        const char *entry = list->entries[i].name.str;
        size_t bytes;

        place_of(entry, &bytes);
        OTX_TRY(add(run, name_of(run->arena, file, part, entry, bytes), out));
    }
    return OSDTEX_OK;
}

static otx_status
list_all(otx_run *run, exr_const_context_t file, otx_exr_data_list *out)
{
    const exr_attr_chlist_t *list = NULL;
    int32_t room = 0;
    int parts = 0;

    exr_get_count(file, &parts);
    for (int part = 0; part < parts; ++part)
        if (exr_get_channels(file, part, &list) == EXR_ERR_SUCCESS)
            room += list->num_channels;
    out->names = OTX_NEW(run->arena, const char *, room);
    OTX_TRY(otx_run_ok(run));
    for (int part = 0; part < parts; ++part)
        OTX_TRY(list_part(run, file, part, out));
    return OSDTEX_OK;
}

otx_status
otx_exr_data_list_read(otx_run *run, const char *path, otx_exr_data_list *out)
{
    exr_context_initializer_t setup = otx_exr_core_reading();
    exr_context_t file = NULL;
    exr_result_t code;
    otx_status status;

    *out = (otx_exr_data_list){0, NULL};
    code = exr_start_read(&file, path, &setup);
    if (code != EXR_ERR_SUCCESS)
        return otx_fail(
            run,
            code == EXR_ERR_FILE_ACCESS ? OSDTEX_ERROR_IO : OSDTEX_ERROR_FORMAT,
            STAGE, otx_where_file(path), "the EXR cannot be read (%s)",
            exr_get_default_error_message(code));
    status = list_all(run, file, out);
    exr_finish(&file);
    return status;
}

/* ---- one of them --------------------------------------------------------- */

/* From the channels that were met: places[0..2] R, G, B, [3..5] X, Y, Z. A
 * single one is there three times. */
static bool
settle(const int32_t places[8], int32_t count, int32_t only, otx_exr_layer *out)
{
    const bool is_rgb = places[0] >= 0 && places[1] >= 0 && places[2] >= 0;
    const bool is_xyz = places[3] >= 0 && places[4] >= 0 && places[5] >= 0;
    const int32_t *from = is_rgb ? places : places + 3;

    out->channels[3] = OTX_EXR_NO_CHANNEL;
    out->is_gray = !is_rgb && !is_xyz;
    for (int i = 0; i < 3; ++i)
        out->channels[i] = out->is_gray ? only : from[i];
    return !out->is_gray || count == 1;
}

static bool
find_in_part(
    otx_run *run, exr_const_context_t file, int part, const char *wanted,
    otx_exr_layer *out)
{
    const exr_attr_chlist_t *list = NULL;
    int32_t places[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
    int32_t count = 0, only = -1;

    if (!is_flat(file, part) ||
        exr_get_channels(file, part, &list) != EXR_ERR_SUCCESS)
        return false;
    for (int32_t i = 0; i < list->num_channels; ++i)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        const char *entry = list->entries[i].name.str;
        size_t bytes;
        const int place = place_of(entry, &bytes);
        const char *name = name_of(run->scratch, file, part, entry, bytes);

        if (name && strcmp(name, wanted) == 0)
        {
            if (place >= 0)
                places[place] = i;
            only = i;
            ++count;
        }
        otx_arena_release(run->scratch, mark);
    }
    out->part = part;
    return count > 0 && settle(places, count, only, out);
}

bool
otx_exr_data_find(
    otx_run *run, exr_const_context_t file, const char *wanted,
    otx_exr_layer *out)
{
    int parts = 0;

    *out = (otx_exr_layer){0};
    exr_get_count(file, &parts);
    for (int part = 0; part < parts; ++part)
        if (find_in_part(run, file, part, wanted, out))
        {
            out->name = otx_arena_strdup(run->arena, wanted);
            return out->name != NULL;
        }
    return false;
}
