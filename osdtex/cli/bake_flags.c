/* bake_flags.c -- words of flags to options of a bake. */
#include "cli/bake_flags.h"
#include "cli/picture_flags.h"
#include "cli/session.h"
#include "cli/value.h"

#include <string.h>

static bool
parse_uvs(const otx_flag_values *values, osdtex_bake_options *out)
{
    static const char *const words[] = {"auto", "own", "atlas", "charts"};
    const char *text = values->text[OTX_FLAG_BAKE_UVS];
    int index;

    if (!text)
        return true;
    if (!otx_value_word(text, words, 4, &index))
    {
        otx_session_refuse(
            "--uvs takes auto, own, atlas or charts, not '%s'", text);
        return false;
    }
    out->uvs = index;
    return true;
}

static bool
parse_numbers(const otx_flag_values *values, osdtex_bake_options *out)
{
    const char *side = values->text[OTX_FLAG_RESOLUTION];
    const char *margin = values->text[OTX_FLAG_MARGIN];
    const char *text = values->text[OTX_FLAG_TEXELS_PER_UNIT];
    const char *blend = values->text[OTX_FLAG_SEAM_BLEND];
    const char *udim = values->text[OTX_FLAG_UDIM];
    int64_t number;

    if (udim && !otx_value_int(udim, 1001, 9999, &number))
    {
        otx_session_refuse(
            "--udim takes a number from 1001 to 9999, not '%s'", udim);
        return false;
    }
    if (udim)
        out->udim = (int32_t)number;

    if (side && !otx_value_int(side, 16, 32768, &number))
    {
        otx_session_refuse(
            "--resolution takes a number of texels from 16 to 32768, not '%s'",
            side);
        return false;
    }
    if (side)
        out->resolution = (int32_t)number;
    if (margin && !otx_value_int(margin, 0, 64, &number))
    {
        otx_session_refuse(
            "--margin takes a number of texels up to 64, not '%s'", margin);
        return false;
    }
    if (margin)
        out->margin = (int32_t)number;
    if (text && (!otx_value_real(text, &out->texels_per_unit) ||
                 !(out->texels_per_unit > 0.0)))
    {
        otx_session_refuse(
            "--texels-per-unit takes a positive number, not '%s'", text);
        return false;
    }
    if (blend &&
        (!otx_value_real(blend, &out->seam_blend) || !(out->seam_blend >= 0.0)))
    {
        otx_session_refuse(
            "--seam-blend takes a number of texels, not '%s'", blend);
        return false;
    }
    return true;
}

/* Extra outputs in any number and order; each is the bit of its place. */
static bool
parse_extras(const otx_flag_values *values, osdtex_bake_options *out)
{
    static const char *const words[] = {
        "patch", "uv", "stretch", "seam", "source", "slice"};
    const int count = sizeof words / sizeof *words;
    const char *text = values->text[OTX_FLAG_EXTRA];

    for (const char *at = text; at && *at;)
    {
        const size_t length = strcspn(at, ",");
        int found = -1;

        for (int i = 0; i < count; ++i)
            if (strlen(words[i]) == length &&
                strncmp(words[i], at, length) == 0)
                found = i;
        if (found < 0)
        {
            otx_session_refuse(
                "--extra takes patch, uv, stretch, seam, source and slice with "
                "commas between, not '%s'",
                text);
            return false;
        }
        out->extras |= 1u << found;
        at += length + (at[length] == ',');
    }
    return true;
}

/* A unit by name, or metres to a scene unit. */
static bool
parse_units(const otx_flag_values *values, osdtex_bake_options *out)
{
    static const char *const names[] = {"m", "cm", "mm", "km", "in", "ft"};
    static const double meters[] = {1.0, 0.01, 0.001, 1000.0, 0.0254, 0.3048};
    const char *text = values->text[OTX_FLAG_UNITS];
    int index;

    if (!text)
        return true;
    if (otx_value_word(text, names, 6, &index))
        out->meters_per_unit = meters[index];
    else if (
        !otx_value_real(text, &out->meters_per_unit) ||
        !(out->meters_per_unit >= 1e-12 && out->meters_per_unit <= 1e12))
    {
        otx_session_refuse(
            "--units takes m, cm, mm, km, in, ft, or how many metres a scene "
            "unit is, from 1e-12 to 1e12, not '%s'",
            text);
        return false;
    }
    return true;
}

bool
otx_bake_flags_parse(const otx_flag_values *values, osdtex_bake_options *out)
{
    *out = osdtex_bake_options_default();
    out->normals = values->text[OTX_FLAG_NORMALS] != NULL;
    out->preview_png = values->text[OTX_FLAG_PREVIEW_PNG] != NULL;
    return parse_uvs(values, out) && parse_numbers(values, out) &&
           parse_extras(values, out) && parse_units(values, out) &&
           otx_picture_flags_up(values, &out->up_axis);
}
