/* field_command.c -- osdtex field: which way a texture would run on a cage. */
#include "cli/dispatch.h"
#include "cli/field_flags.h"
#include "cli/guard.h"
#include "cli/inputs.h"
#include "cli/picture_flags.h"
#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>
#include <string.h>

enum
{
    FACES_MAX = 40000 /* of the level that is chosen when none is given */
};

typedef struct job
{
    const otx_flag_values *values;
    const char *output;
    bool is_table; /* a .csv, not a picture */
    int32_t level; /* -1: chosen */
    osdtex_cage_options cage_options;
    osdtex_field_options field_options;
    osdtex_render_options picture;

    osdtex_cage *cage;
    osdtex_surface *surface;
    osdtex_field *field;
} job;

static bool
parse_level(job *j)
{
    const char *level = j->values->text[OTX_FLAG_LEVEL];
    int64_t number;

    j->level = -1;
    if (level && strcmp(level, "auto") != 0)
    {
        if (!otx_value_int(level, 0, OSDTEX_LEVEL_MAX, &number))
        {
            otx_session_refuse(
                "--level takes a number from 0 to %d or auto, not '%s'",
                OSDTEX_LEVEL_MAX, level);
            return false;
        }
        j->level = (int32_t)number;
    }
    return true;
}

static bool
parse(job *j, const otx_flag_values *values)
{
    *j = (job){.values = values, .output = values->text[OTX_FLAG_OUTPUT]};
    j->is_table = j->output && otx_value_has_extension(j->output, ".csv");
    if (!j->output ||
        (!j->is_table && !otx_value_has_extension(j->output, ".png") &&
         !otx_value_has_extension(j->output, ".exr")))
    {
        otx_session_refuse(
            "osdtex field writes a table or a picture: -o NAME.csv, NAME.png "
            "or NAME.exr");
        return false;
    }
    if (!otx_inputs_cage(values, &j->cage_options) || !parse_level(j) ||
        !otx_field_flags_parse(values, &j->field_options) ||
        !otx_picture_flags_parse(values, &j->picture))
        return false;
    if (!j->picture.show)
        j->picture.show = "field";
    return true;
}

/* The finest level of a moderate number of faces. */
static int32_t
choose_level(const job *j)
{
    const osdtex_cage_info *cage = osdtex_cage_describe(j->cage);
    int64_t faces = cage->face_count;
    int32_t level = 0;

    if (j->level >= 0)
        return j->level;
    for (; level < OSDTEX_LEVEL_MAX && 4 * faces <= FACES_MAX; ++level)
        faces *= 4;
    return level;
}

static osdtex_status
solve(otx_session *session, job *j)
{
    osdtex_surface_options options = osdtex_surface_options_default();
    osdtex_status status = osdtex_cage_read(
        session->context, j->values->operands[0], &j->cage_options, &j->cage);

    if (status != OSDTEX_OK)
        return status;
    options.level = choose_level(j);
    status =
        osdtex_surface_refine(session->context, j->cage, &options, &j->surface);
    otx_session_lap(session, "refined");
    if (status == OSDTEX_OK)
        status = osdtex_field_create(
            session->context, j->surface, &j->field_options, &j->field);
    otx_session_lap(session, "solved");
    return status;
}

static osdtex_status
draw(otx_session *session, const job *j)
{
    osdtex_image *image = NULL;
    osdtex_model *model;
    osdtex_status status =
        osdtex_model_create_field(session->context, j->field, &model);

    if (status == OSDTEX_OK)
        status = osdtex_render(session->context, model, &j->picture, &image);
    if (status == OSDTEX_OK)
        status = osdtex_image_write(session->context, image, j->output);
    osdtex_image_destroy(image);
    osdtex_model_destroy(model);
    return status;
}

/* Of the positive ones and the negative ones, how many. */
static void
say_field(otx_session *session, const job *j)
{
    const osdtex_field_info *field = osdtex_field_describe(j->field);
    int positive = 0;

    for (osdtex_index i = 0; i < field->singularity_count; ++i)
        positive += field->singularities[i].index > 0.0;
    otx_session_say(
        session,
        "%d faces, symmetry %d, %d singularities (%d positive), size %.2f to "
        "%.2f",
        field->face_count, field->symmetry, field->singularity_count, positive,
        field->scale_min, field->scale_max);
    for (osdtex_index i = 0;
         session->console.verbose && i < field->singularity_count; ++i)
        otx_session_say(
            session, "singularity of index %+g at %g %g %g",
            field->singularities[i].index, field->singularities[i].point[0],
            field->singularities[i].point[1], field->singularities[i].point[2]);
}

static osdtex_status
make(otx_session *session, job *j)
{
    osdtex_status status = solve(session, j);

    if (status != OSDTEX_OK)
        return status;
    say_field(session, j);
    if (j->values->text[OTX_FLAG_DRY_RUN])
        return OSDTEX_OK;
    /* A table is of the cage's faces unless a level is asked for. */
    status = j->is_table ? osdtex_field_write(
                               session->context, j->field,
                               j->level >= 0 ? j->level : 0, j->output)
                         : draw(session, j);
    if (status == OSDTEX_OK)
        status = otx_session_commit(session);
    if (status == OSDTEX_OK)
        otx_session_say(
            session, "wrote %s, %.1f s", j->output,
            otx_session_seconds(session));
    return status;
}

int
otx_field_command_run(const otx_flag_values *values)
{
    osdtex_status status;
    otx_session session;
    job j;

    if (!parse(&j, values))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    status = otx_guard_check_flags(&session, values);
    if (status == OSDTEX_OK)
        status = make(&session, &j);
    osdtex_field_destroy(j.field);
    osdtex_surface_destroy(j.surface);
    osdtex_cage_destroy(j.cage);
    return otx_session_end(&session, status);
}
