/* render_command.c -- osdtex render: a picture of a written model. */
#include "cli/picture_flags.h"
#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>

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
    if (!otx_picture_flags_parse(values, &options))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    return otx_session_end(
        &session, render(
                      &session, values->operands[0], output, &options,
                      values->text[OTX_FLAG_DRY_RUN] != NULL));
}
