/* exr_layer.c -- which part and which channels of an EXR are the picture. */
#include "file/exr_layer.h"

#include <stdio.h>
#include <string.h>

enum
{
    NAMES_BYTES = 400,
    NONE = OTX_EXR_NO_CHANNEL
};

/* Index of the channel `layer` + `name`, or NONE. `layer` has `length` bytes,
 * its dot included. */
static int32_t
find_channel(
    const exr_attr_chlist_t *list, const char *layer, size_t length,
    const char *name)
{
    for (int32_t i = 0; i < list->num_channels; ++i)
    {
        const char *entry = list->entries[i].name.str;

        if (strncmp(entry, layer, length) == 0 &&
            strcmp(entry + length, name) == 0)
            return i;
    }
    return NONE;
}

/* Takes R, G, B (and A) of a layer. False when one of the three is missing. */
static bool
take_layer(
    const exr_attr_chlist_t *list, const char *layer, size_t length,
    otx_exr_layer *out)
{
    static const char *const names[4] = {"R", "G", "B", "A"};

    for (int32_t i = 0; i < 4; ++i)
        out->channels[i] = find_channel(list, layer, length, names[i]);
    return out->channels[0] != NONE && out->channels[1] != NONE &&
           out->channels[2] != NONE;
}

/* Luminance alone. With chroma (RY, BY) it is only part of a colour. */
static bool
take_gray(const exr_attr_chlist_t *list, otx_exr_layer *out)
{
    const int32_t y = find_channel(list, "", 0, "Y");

    if (y == NONE || find_channel(list, "", 0, "RY") != NONE)
        return false;
    out->channels[0] = out->channels[1] = out->channels[2] = y;
    out->channels[3] = find_channel(list, "", 0, "A");
    out->is_gray = true;
    return true;
}

/* The first layer, in the order of the file, that has R, G and B. */
static bool
take_any_layer(
    otx_arena *arena, const exr_attr_chlist_t *list, otx_exr_layer *out)
{
    for (int32_t i = 0; i < list->num_channels; ++i)
    {
        const char *name = list->entries[i].name.str;
        const char *dot = strrchr(name, '.');
        char *layer;

        if (!dot || !take_layer(list, name, (size_t)(dot + 1 - name), out))
            continue;
        layer = otx_arena_strdup(arena, name);
        if (layer)
            layer[dot - name] = '\0';
        out->name = layer;
        return layer != NULL;
    }
    return false;
}

static bool
part_is_flat(exr_const_context_t file, int part)
{
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;

    return exr_get_storage(file, part, &storage) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED);
}

/* What is there, for the message that says it is not what is needed. Bytes
 * that are not printable ASCII become '?'. */
static void
list_channels(exr_const_context_t file, int part_count, char text[NAMES_BYTES])
{
    const exr_attr_chlist_t *list = NULL;
    size_t used = 0;

    text[0] = '\0';
    for (int part = 0; part < part_count; ++part)
    {
        if (exr_get_channels(file, part, &list) != EXR_ERR_SUCCESS)
            continue;
        for (int32_t i = 0; i < list->num_channels; ++i)
        {
            const int n = snprintf(
                text + used, NAMES_BYTES - used, "%s%s", used > 0 ? ", " : "",
                list->entries[i].name.str);

            if (n < 0 || (size_t)n >= NAMES_BYTES - used)
                break;
            used += (size_t)n;
        }
    }
    for (char *c = text; *c; ++c)
        if (*c < ' ' || *c > '~')
            *c = '?';
}

static otx_status
no_color(
    otx_run *run, const char *path, exr_const_context_t file, int part_count)
{
    char names[NAMES_BYTES];
    bool deep = true;

    for (int part = 0; part < part_count; ++part)
        deep = deep && !part_is_flat(file, part);
    if (deep)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
            "the EXR is deep; flatten it, for example with oiiotool --flatten");
    list_channels(file, part_count, names);
    return otx_fail(
        run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
        "the EXR has no R, G, B, no Y alone and no layer with R, G, B, only "
        "%s; rename or select channels, for example with oiiotool --ch",
        names);
}

/* The first flat part with colour. */
static otx_status
choose_part(
    otx_run *run, const char *path, exr_const_context_t file,
    otx_exr_layer *out)
{
    const exr_attr_chlist_t *list = NULL;
    int part_count = 0;

    exr_get_count(file, &part_count);
    for (out->part = 0; out->part < part_count; ++out->part)
        if (part_is_flat(file, out->part) &&
            exr_get_channels(file, out->part, &list) == EXR_ERR_SUCCESS &&
            (take_layer(list, "", 0, out) || take_gray(list, out) ||
             take_any_layer(run->arena, list, out)))
            break;
    if (out->part == part_count)
        return no_color(run, path, file, part_count);
    if (part_count > 1)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "picture", otx_where_file(path),
            "the EXR has %d parts; part %d is the first with colour and is "
            "used",
            part_count, out->part);
    if (out->name)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "picture", otx_where_file(path),
            "the EXR has no plain R, G, B; layer \"%s\" is used", out->name);
    return OSDTEX_OK;
}

/* Subsampled colours would need a reconstruction filter; alpha alone is
 * dropped. */
static otx_status
check_channels(
    otx_run *run, const char *path, exr_const_context_t file,
    otx_exr_layer *out)
{
    const exr_attr_chlist_t *list = NULL;

    exr_get_channels(file, out->part, &list);
    for (int32_t i = 0; i < 4; ++i)
    {
        const exr_attr_chlist_entry_t *entry;

        if (out->channels[i] == NONE)
            continue;
        entry = &list->entries[out->channels[i]];
        if (entry->x_sampling == 1 && entry->y_sampling == 1)
            continue;
        if (i < 3)
            return otx_fail(
                run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
                "the EXR has subsampled colours; convert it to full "
                "resolution R, G, B");
        out->channels[i] = NONE;
    }
    out->bits =
        list->entries[out->channels[0]].pixel_type == EXR_PIXEL_HALF ? 16 : 32;
    return OSDTEX_OK;
}

otx_status
otx_exr_layer_choose(
    otx_run *run, const char *path, exr_const_context_t file,
    otx_exr_layer *out)
{
    *out = (otx_exr_layer){0};
    OTX_TRY(choose_part(run, path, file, out));
    return check_channels(run, path, file, out);
}
