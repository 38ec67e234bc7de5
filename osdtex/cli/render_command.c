/* render_command.c -- osdtex render: a picture of a written model.
 *
 * A field is not in an OBJ: to be shown it is made anew on the model's own
 * faces, as on a plain mesh. */
#include "cli/dispatch.h"
#include "cli/field_flags.h"
#include "cli/guard.h"
#include "cli/picture_flags.h"
#include "cli/saved_files.h"
#include "cli/session.h"
#include "cli/turntable.h"
#include "cli/value.h"

#include <stdio.h>
#include <string.h>

typedef struct job
{
    const char *path;
    const char *output;
    otx_turntable turntable;
    bool dry_run;
    bool shows_field;
    osdtex_render_options picture;
    osdtex_field_options field_options;

    const char *saved; /* a mapping instead of a model; NULL */
    const char *from;

    osdtex_mapping *mapping;
    osdtex_model *model;
    osdtex_cage *cage; /* the model as a plain mesh; NULL without a field */
    osdtex_surface *surface;
    osdtex_field *field;
} job;

static bool
parse_field(job *j, const otx_flag_values *values)
{
    static const otx_flag_id needs[] = {
        OTX_FLAG_CONSTRAINTS, OTX_FLAG_FOLLOW, OTX_FLAG_SYMMETRY};
    const char *show = j->picture.show;

    j->shows_field = show && (strcmp(show, "field") == 0 ||
                              strcmp(show, "singularities") == 0);
    for (int i = 0; i < 3 && !j->shows_field; ++i)
        if (values->text[needs[i]])
        {
            otx_session_refuse(
                "--%s is for --show field and --show singularities",
                otx_flag_at(needs[i])->name);
            return false;
        }
    if (!otx_field_flags_parse(values, &j->field_options))
        return false;
    /* In a table of another level the faces are not those of the model. */
    j->field_options.whole_table = 1;
    return true;
}

static bool
parse(job *j, const otx_flag_values *values)
{
    *j = (job){
        .path = values->operands[0],
        .output = values->text[OTX_FLAG_OUTPUT],
        .saved = values->inputs.saved.path,
        .from = values->text[OTX_FLAG_FROM],
        .dry_run = values->text[OTX_FLAG_DRY_RUN] != NULL};
    if (!j->output || (!otx_value_has_extension(j->output, ".png") &&
                       !otx_value_has_extension(j->output, ".exr")))
    {
        otx_session_refuse(
            "osdtex render writes a picture: -o NAME.png or NAME.exr");
        return false;
    }
    if (j->from)
    {
        otx_session_refuse(
            "osdtex render takes --from NAME.osdtex, not a colour space");
        return false;
    }
    if (!otx_turntable_parse(values, &j->turntable) ||
        !otx_picture_flags_parse(values, &j->picture) ||
        !parse_field(j, values))
        return false;
    j->picture.orbit = j->turntable.frames > 0;
    if (!j->picture.orbit || j->picture.fov == 0.0)
        return true;
    otx_session_refuse(
        "a turntable is taken by a named --camera, not by an eye and a target");
    return false;
}

static osdtex_status
join_field(osdtex_context *context, job *j)
{
    osdtex_model *bare = j->model;
    osdtex_cage_options plain = osdtex_cage_options_default();
    osdtex_surface_options level = osdtex_surface_options_default();
    osdtex_status status;

    plain.scheme = OSDTEX_SCHEME_NONE;
    level.level = 0;
    status = osdtex_cage_read(context, j->path, &plain, &j->cage);
    if (status == OSDTEX_OK)
        status = osdtex_surface_refine(context, j->cage, &level, &j->surface);
    if (status == OSDTEX_OK)
        status = osdtex_field_create(
            context, j->surface, &j->field_options, &j->field);
    if (status == OSDTEX_OK)
        status = osdtex_model_join_field(context, bare, j->field, &j->model);
    if (status == OSDTEX_OK)
        osdtex_model_destroy(bare);
    else
        j->model = bare;
    return status;
}

static osdtex_status
draw_frame(otx_session *session, const job *j, int i)
{
    char path[OTX_TURNTABLE_PATH_BYTES];
    osdtex_render_options picture = j->picture;
    osdtex_image *image;
    osdtex_status status;

    otx_turntable_name(&j->turntable, i, path);
    picture.turn += otx_turntable_turn(&j->turntable, i);
    status = osdtex_render(session->context, j->model, &picture, &image);
    if (status == OSDTEX_OK)
        status = osdtex_image_write(session->context, image, path);
    osdtex_image_destroy(image);
    return status;
}

static osdtex_status
draw(otx_session *session, job *j)
{
    osdtex_status status = OSDTEX_OK;

    for (int i = 0; status == OSDTEX_OK && (i == 0 || i < j->turntable.frames);
         ++i)
        status = draw_frame(session, j, i);
    if (status == OSDTEX_OK)
        status = otx_session_commit(session);
    if (status == OSDTEX_OK)
        otx_session_say(
            session, "wrote %s, %.1f s", j->output,
            otx_session_seconds(session));
    return status;
}

static osdtex_status
read_saved(osdtex_context *context, job *j)
{
    osdtex_mapping_read_options options = osdtex_mapping_read_options_default();
    osdtex_status status;

    options.cage = j->path;
    options.without_figures =
        !j->picture.show || strcmp(j->picture.show, "windows") != 0;
    j->path = j->saved;
    status = osdtex_mapping_read(context, j->saved, &options, &j->mapping);
    return status == OSDTEX_OK
               ? osdtex_model_create(context, j->mapping, &j->model)
               : status;
}

static osdtex_status
render(otx_session *session, job *j)
{
    osdtex_status status =
        j->saved ? read_saved(session->context, j)
                 : osdtex_model_read(session->context, j->path, &j->model);

    if (status == OSDTEX_OK && j->shows_field && !j->saved)
        status = join_field(session->context, j);
    if (status != OSDTEX_OK)
        return status;
    if (!j->dry_run)
        return draw(session, j);
    otx_session_print(
        "would render %s into %s: %d x %d, %d x %d rays a pixel%s\n", j->path,
        j->output, j->picture.width, j->picture.height, j->picture.samples,
        j->picture.samples,
        j->turntable.frames > 0 ? ", each frame of a turntable" : "");
    return OSDTEX_OK;
}

static void
drop(const job *j)
{
    osdtex_model_destroy(j->model);
    osdtex_mapping_destroy(j->mapping);
    osdtex_field_destroy(j->field);
    osdtex_surface_destroy(j->surface);
    osdtex_cage_destroy(j->cage);
}

static osdtex_status
check_outputs(otx_session *session, const otx_flag_values *values, const job *j)
{
    otx_path_list outputs = {0};
    osdtex_status status;

    otx_turntable_outputs(&j->turntable, &outputs);
    status = otx_guard_check(session, values, &outputs);
    otx_path_list_free(&outputs);
    return status == OSDTEX_OK
               ? osdtex_outputs_mark(
                     session->context, NULL, otx_saved_files_source(values))
               : status;
}

int
otx_render_command_run(const otx_flag_values *values)
{
    osdtex_status status;
    otx_flag_values all = *values; /* with the files of the saved mapping */
    otx_session session;
    job j;

    if (!parse(&j, values))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    status = otx_saved_files_take(&session, &all.inputs.saved);
    if (status == OSDTEX_OK)
        status = check_outputs(&session, &all, &j);
    if (status == OSDTEX_OK)
        status = render(&session, &j);
    drop(&j);
    otx_saved_files_free(&all.inputs.saved);
    return otx_session_end(&session, status);
}
