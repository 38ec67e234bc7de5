/* picture_flags.c -- what the flags say about a picture. */
#include "cli/picture_flags.h"

#include "cli/session.h"
#include "cli/value.h"

#include <string.h>

#define DEGREES (3.14159265358979323846 / 180.0)

/* Seven numbers, or a name that the library knows. */
static bool
parse_camera(const otx_flag_values *values, osdtex_render_options *out)
{
    const char *text = values->text[OTX_FLAG_CAMERA];
    double v[7];

    if (!text)
        return true;
    if (!strchr(text, ','))
    {
        out->view = text;
        return true;
    }
    if (!otx_value_reals(text, 7, v) || !(v[6] > 0.0) || !(v[6] < 180.0))
    {
        otx_session_refuse(
            "--camera takes a name or X,Y,Z,TX,TY,TZ,FOV with a field of view "
            "between 0 and 180 degrees, not '%s'",
            text);
        return false;
    }
    memcpy(out->eye, v, sizeof out->eye);
    memcpy(out->target, v + 3, sizeof out->target);
    out->fov = v[6] * DEGREES;
    return true;
}

static bool
parse_size(const otx_flag_values *values, osdtex_render_options *out)
{
    const char *text = values->text[OTX_FLAG_SIZE];
    char width[16];
    int64_t w, h;
    size_t length;

    if (!text)
        return true;
    length = strcspn(text, "xX");
    if (length < sizeof width && text[length] != '\0')
    {
        memcpy(width, text, length);
        width[length] = '\0';
        if (otx_value_int(width, 1, 32768, &w) &&
            otx_value_int(text + length + 1, 1, 32768, &h))
        {
            out->width = (int32_t)w;
            out->height = (int32_t)h;
            return true;
        }
    }
    otx_session_refuse(
        "--size takes WIDTHxHEIGHT, 1 to 32768 pixels each, not '%s'", text);
    return false;
}

static bool
parse_draw(const otx_flag_values *values, osdtex_render_options *out)
{
    const char *text = values->text[OTX_FLAG_DRAW];

    for (const char *at = text; at && *at;)
    {
        const size_t length = strcspn(at, ",");

        if (length == 4 && strncmp(at, "wire", 4) == 0)
            out->wire = 1;
        else if (length == 2 && strncmp(at, "uv", 2) == 0)
            out->uv_lines = 1;
        else
        {
            otx_session_refuse(
                "--draw takes wire, uv or wire,uv, not '%s'", text);
            return false;
        }
        at += length + (at[length] == ',');
    }
    return true;
}

bool
otx_picture_flags_up(const otx_flag_values *values, int32_t *out)
{
    static const char *const words[] = {"y", "z"};
    const char *text = values->text[OTX_FLAG_UP];
    int index;

    *out = 0;
    if (!text)
        return true;
    if (!otx_value_word(text, words, 2, &index))
    {
        otx_session_refuse("--up takes y or z, not '%s'", text);
        return false;
    }
    *out = index;
    return true;
}

bool
otx_picture_flags_parse(
    const otx_flag_values *values, osdtex_render_options *out)
{
    const char *samples = values->text[OTX_FLAG_SAMPLES];
    const char *turn = values->text[OTX_FLAG_TURN];
    int64_t number;

    *out = osdtex_render_options_default();
    out->show = values->text[OTX_FLAG_SHOW];
    out->unlit = values->text[OTX_FLAG_UNLIT] != NULL;
    out->plain = values->text[OTX_FLAG_PLAIN] != NULL;
    out->displace = values->text[OTX_FLAG_DISPLACE] != NULL;
    out->no_shadows = values->text[OTX_FLAG_NO_SHADOWS] != NULL;
    if (!parse_camera(values, out) || !parse_size(values, out) ||
        !parse_draw(values, out) ||
        !otx_picture_flags_up(values, &out->up_axis))
        return false;
    if (samples)
    {
        if (!otx_value_int(samples, 1, 16, &number))
        {
            otx_session_refuse(
                "--samples takes a number from 1 to 16, not '%s'", samples);
            return false;
        }
        out->samples = (int32_t)number;
    }
    if (turn)
    {
        if (!otx_value_real(turn, &out->turn))
        {
            otx_session_refuse("--turn takes degrees, not '%s'", turn);
            return false;
        }
        out->turn *= DEGREES;
    }
    return true;
}
