/* also_flags.c -- [MATERIAL=]FILE and lists of scales. */
#include "cli/also_flags.h"
#include "cli/path_list.h"
#include "cli/session.h"
#include "cli/value.h"

#include <string.h>

const char *
otx_also_flags_file(const char *text)
{
    const char *equals = strchr(text, '=');

    return equals ? equals + 1 : text;
}

static bool
parse_file(const char *text, int k, otx_also_flags *out)
{
    const char *file = otx_also_flags_file(text);
    const size_t bytes = file > text ? (size_t)(file - text) - 1 : 0;

    if (*file == '\0' || bytes >= OTX_ALSO_MATERIAL_BYTES)
    {
        otx_session_refuse("--also takes [MATERIAL=]FILE, not '%s'", text);
        return false;
    }
    memcpy(out->materials[k], text, bytes);
    out->materials[k][bytes] = '\0';
    out->files[k] = file;
    return true;
}

static bool
parse_scales(const char *text, otx_also_flags *out)
{
    double v[OSDTEX_EXEMPLARS_MAX];
    int count = 1;

    if (!text)
        return true;
    for (const char *c = text; *c; ++c)
        count += *c == ',';
    if (count > out->count + 1 || !otx_value_reals(text, count, v))
        count = 0;
    for (int k = 0; k < count; ++k)
        count = v[k] > 0.0 ? count : 0;
    if (count == 0)
    {
        otx_session_refuse(
            "--scale takes a positive number of scene units%s, not '%s'",
            out->count > 0 ? " for each exemplar" : "", text);
        return false;
    }
    out->scale = v[0];
    for (int k = 1; k < count; ++k)
        out->list[k - 1].scale = v[k];
    return true;
}

bool
otx_also_flags_parse(const otx_flag_values *values, otx_also_flags *out)
{
    *out = (otx_also_flags){.count = values->also_count};
    if (values->also_count > OTX_ALSO_MAX)
    {
        otx_session_refuse(
            "--also is given %d times; a mapping takes up to %d exemplars",
            values->also_count, OSDTEX_EXEMPLARS_MAX);
        return false;
    }
    for (int k = 0; k < out->count; ++k)
        if (!parse_file(values->also[k], k, out))
            return false;
    return parse_scales(values->text[OTX_FLAG_SCALE], out);
}

osdtex_status
otx_also_flags_find(
    osdtex_context *context, otx_flag_inputs *inputs, otx_also_flags *also)
{
    for (int k = 0; k < also->count; ++k)
    {
        const osdtex_material_info *info;
        osdtex_status status;

        if (!otx_path_list_is_folder(also->files[k]))
            continue;
        status = osdtex_material_find(context, also->files[k], &also->sets[k]);
        if (status != OSDTEX_OK)
            return status;
        info = otx_also_flags_set(also, k);
        also->files[k] = info->color;
        otx_flag_inputs_add(inputs, info->color);
        for (int i = 0; i < info->map_count; ++i)
            otx_flag_inputs_add(inputs, info->maps[i].path);
    }
    return OSDTEX_OK;
}

const osdtex_material_info *
otx_also_flags_set(const otx_also_flags *also, int k)
{
    return osdtex_material_describe(also->sets[k]);
}

osdtex_status
otx_also_flags_read(
    osdtex_context *context, const osdtex_exemplar_options *options,
    otx_also_flags *also)
{
    for (int k = 0; k < also->count; ++k)
    {
        const osdtex_material_info *set = otx_also_flags_set(also, k);
        osdtex_exemplar_options own = *options;
        osdtex_status status;

        own.maps = set ? set->maps : NULL;
        own.map_count = set ? set->map_count : 0;
        status = osdtex_exemplar_read(
            context, also->files[k], &own, &also->exemplars[k]);

        if (status != OSDTEX_OK)
            return status;
        also->list[k].exemplar = also->exemplars[k];
        also->list[k].material =
            also->materials[k][0] ? also->materials[k] : NULL;
    }
    return OSDTEX_OK;
}

void
otx_also_flags_destroy(otx_also_flags *also)
{
    for (int k = 0; k < also->count; ++k)
    {
        osdtex_exemplar_destroy(also->exemplars[k]);
        osdtex_material_destroy(also->sets[k]);
    }
}
