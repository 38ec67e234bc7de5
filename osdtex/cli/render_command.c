/* render_command.c -- osdtex render: a picture of a written model. */
#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>
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
    if (text[length] != '\0' && length < sizeof width)
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
    otx_session_refuse("--size takes WIDTHxHEIGHT in pixels, not '%s'", text);
    return false;
}

static bool
parse(const otx_flag_values *values, osdtex_render_options *out)
{
    const char *samples = values->text[OTX_FLAG_SAMPLES];
    const char *turn = values->text[OTX_FLAG_TURN];
    int64_t number;

    *out = osdtex_render_options_default();
    out->show = values->text[OTX_FLAG_SHOW];
    out->unlit = values->text[OTX_FLAG_UNLIT] != NULL;
    if (!parse_camera(values, out) || !parse_size(values, out))
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

static osdtex_status
render(
    otx_session *session, const char *model_path, const char *output,
    const osdtex_render_options *options, bool dry_run)
{
    osdtex_context *context = session->context;
    osdtex_model *model;
    osdtex_image *image = NULL;
    osdtex_status status = osdtex_model_read(context, model_path, &model);

    if (status == OSDTEX_OK && dry_run)
        printf(
            "would render %s into %s: %d x %d, %d x %d rays a pixel\n",
            model_path, output, options->width, options->height,
            options->samples, options->samples);
    else if (status == OSDTEX_OK)
    {
        status = osdtex_render(context, model, options, &image);
        if (status == OSDTEX_OK)
            status = osdtex_image_write(context, image, output);
        if (status == OSDTEX_OK)
            otx_session_say(
                session, "wrote %s, %.1f s", output,
                otx_session_seconds(session));
    }
    osdtex_image_destroy(image);
    osdtex_model_destroy(model);
    return status;
}

int
otx_render_command_run(const otx_flag_values *values)
{
    const char *output = values->text[OTX_FLAG_OUTPUT];
    osdtex_render_options options;
    otx_session session;

    if (!output || (!otx_value_has_extension(output, ".png") &&
                    !otx_value_has_extension(output, ".exr")))
        return otx_session_refuse(
            "osdtex render writes a picture: -o NAME.png or NAME.exr");
    if (!parse(values, &options))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    return otx_session_end(
        &session, render(
                      &session, values->operands[0], output, &options,
                      values->text[OTX_FLAG_DRY_RUN] != NULL));
}
