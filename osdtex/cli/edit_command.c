/* edit_command.c -- osdtex edit: a saved mapping, changed in a part of it. */
#include "cli/dispatch.h"
#include "cli/edit_flags.h"
#include "cli/guard.h"
#include "cli/inputs.h"
#include "cli/saved_files.h"
#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The saved mapping stands in the place of what it names. */
typedef struct job
{
    otx_flag_values values;
    const char *output, *preview;
    osdtex_edit_options options;
    osdtex_constraint redo;
    osdtex_mapping *from, *made;
    osdtex_image *picture;
} job;

static bool
parse(job *j, const otx_flag_values *values)
{
    *j = (job){
        .values = *values,
        .output = values->text[OTX_FLAG_OUTPUT],
        .preview = values->text[OTX_FLAG_PREVIEW]};
    j->options = osdtex_edit_options_default();
    j->options.constraints = values->text[OTX_FLAG_CONSTRAINTS];
    if (!otx_value_has_extension(values->operands[0], ".osdtex") ||
        !j->output || !otx_value_has_extension(j->output, ".osdtex"))
    {
        otx_session_refuse(
            "osdtex edit reads a saved mapping and writes another one: osdtex "
            "edit MAP.osdtex -o NEW.osdtex");
        return false;
    }
    if (values->text[OTX_FLAG_REDO])
    {
        if (!otx_edit_flags_redo(values, &j->redo))
            return false;
        j->options.constraint_items = &j->redo;
        j->options.constraint_count = 1;
    }
    else if (!j->options.constraints)
    {
        otx_session_refuse(
            "nothing is asked for: say it with --constraints FILE, or name a "
            "spot with --redo FACE or --redo X,Y,Z,RADIUS");
        return false;
    }
    if (values->text[OTX_FLAG_REACH] &&
        (!otx_value_real(values->text[OTX_FLAG_REACH], &j->options.reach) ||
         !(j->options.reach > 0.0)))
    {
        otx_session_refuse(
            "--reach takes a positive number of scene units, not '%s'",
            values->text[OTX_FLAG_REACH]);
        return false;
    }
    j->values.inputs.saved.path = values->operands[0];
    j->values.operand_count = 0;
    j->values.operands[0] = NULL;
    return true;
}

/* How many faces show something else than before. */
static int
count_changed(const job *j)
{
    const osdtex_mapping_info *a = osdtex_mapping_describe(j->from);
    const osdtex_mapping_info *b = osdtex_mapping_describe(j->made);
    const osdtex_surface_info *s =
        osdtex_surface_describe(osdtex_mapping_surface(j->made));
    int count = 0;

    for (osdtex_index f = 0; f < b->face_count; ++f)
    {
        const size_t first = 2 * (size_t)s->face_first[f];
        const size_t end = 2 * (size_t)s->face_first[f + 1];

        count += a->face_patch[f] != b->face_patch[f] ||
                 memcmp(
                     a->uvs + first, b->uvs + first,
                     (end - first) * sizeof *a->uvs) != 0;
    }
    return count;
}

static osdtex_status
render_preview(otx_session *session, job *j)
{
    osdtex_render_options options = osdtex_render_options_default();
    osdtex_model *model;
    osdtex_status status;

    if (!j->preview)
        return OSDTEX_OK;
    options.show = j->values.text[OTX_FLAG_SHOW];
    status = osdtex_model_create(session->context, j->made, &model);
    if (status == OSDTEX_OK)
        status = osdtex_render(session->context, model, &options, &j->picture);
    osdtex_model_destroy(model);
    if (status == OSDTEX_OK)
        status = osdtex_image_write(session->context, j->picture, j->preview);
    otx_session_lap(session, "rendered");
    return status;
}

static osdtex_status
write_outputs(otx_session *session, job *j)
{
    osdtex_status status = render_preview(session, j);

    if (status == OSDTEX_OK)
        status = osdtex_mapping_save(session->context, j->made, j->output);
    if (status == OSDTEX_OK)
        status = otx_session_commit(session);
    otx_session_lap(session, "written");
    if (status != OSDTEX_OK)
        return status;
    otx_session_say(
        session, "saved %s: %d of %d faces changed, %.1f s", j->output,
        count_changed(j), osdtex_mapping_describe(j->made)->face_count,
        otx_session_seconds(session));
    if (j->preview)
        otx_session_say(session, "wrote %s", j->preview);
    return OSDTEX_OK;
}

static osdtex_status
make(otx_session *session, job *j)
{
    osdtex_status status = osdtex_mapping_read(
        session->context, j->values.inputs.saved.path, NULL, &j->from);

    otx_session_lap(session, "inputs read");
    if (status == OSDTEX_OK && j->values.text[OTX_FLAG_DRY_RUN])
    {
        otx_session_print(
            "would edit    %s: %d faces in %d patches, by %s\ninto          "
            "%s\n",
            j->values.inputs.saved.path,
            osdtex_mapping_describe(j->from)->face_count,
            osdtex_mapping_describe(j->from)->patch_count,
            osdtex_mapping_describe(j->from)->method, j->output);
        return OSDTEX_OK;
    }
    if (status == OSDTEX_OK)
        status = osdtex_mapping_edit(
            session->context, j->from, &j->options, &j->made);
    otx_session_lap(session, "edited");
    return status == OSDTEX_OK ? write_outputs(session, j) : status;
}

static osdtex_status
guard(otx_session *session, job *j)
{
    otx_path_list outputs = {0};
    osdtex_status status =
        otx_saved_files_take(session, &j->values.inputs.saved);

    if (status != OSDTEX_OK)
        return status;
    otx_path_list_add(&outputs, j->output);
    otx_path_list_add(&outputs, j->preview);
    status = otx_guard_check(session, &j->values, &outputs);
    otx_path_list_free(&outputs);
    if (status == OSDTEX_OK)
        status = osdtex_outputs_mark(
            session->context, NULL, otx_saved_files_source(&j->values));
    return status;
}

int
otx_edit_command_run(const otx_flag_values *values)
{
    osdtex_status status;
    otx_session session;
    job j;

    if (!parse(&j, values))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    status = guard(&session, &j);
    if (status == OSDTEX_OK)
        status = make(&session, &j);
    osdtex_image_destroy(j.picture);
    osdtex_mapping_destroy(j.made);
    osdtex_mapping_destroy(j.from);
    otx_saved_files_free(&j.values.inputs.saved);
    return otx_session_end(&session, status);
}
