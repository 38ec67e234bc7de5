/* map_command.c -- osdtex map and osdtex bake: a cage and an exemplar in, a
 * textured model out, or the cage with textures. */
#include "cli/dispatch.h"
#include "cli/guard.h"
#include "cli/map_flags.h"
#include "cli/saved_files.h"
#include "cli/session.h"
#include "cli/up_to_date.h"

#include <stdio.h>

/* The job as the flags ask for it, and what has been made of it so far. */
typedef struct job
{
    otx_flag_values values; /* with the files of what flags name */
    otx_map_flags request;
    bool has_hash;
    char hash[OSDTEX_HASH_BYTES];

    osdtex_cage *cage;  /* that is mapped: of --rest, else the operand */
    osdtex_cage *frame; /* the operand where there is a --rest */
    osdtex_exemplar *exemplar;
    osdtex_forecast forecast;
    osdtex_surface *surface;
    osdtex_mapping *keep; /* of --keep */
    osdtex_mapping *mapping;
    osdtex_image *picture;
} job;

/* The file of the cage that is mapped. */
static const char *
cage_path(const job *j)
{
    const otx_flag_values *values = j->request.values;
    const char *rest = values->text[OTX_FLAG_REST];

    return rest ? rest : values->operands[0];
}

/* Cage and exemplars. */
static osdtex_status
read_inputs(otx_session *session, job *j)
{
    otx_map_flags *r = &j->request;
    osdtex_status status;

    status = osdtex_cage_read(
        session->context, cage_path(j), &r->cage_options, &j->cage);
    if (status == OSDTEX_OK && r->values->text[OTX_FLAG_REST])
        status = osdtex_cage_read(
            session->context, r->values->operands[0], &r->cage_options,
            &j->frame);
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_read(
            session->context, r->values->operands[1], &r->exemplar_options,
            &j->exemplar);
    if (status == OSDTEX_OK)
        status = otx_also_flags_read(
            session->context, &r->exemplar_options, &r->also);
    r->map_options.also = r->also.list;
    r->map_options.also_count = r->also.count;
    otx_session_lap(session, "inputs read");
    return status;
}

/* The mapping of --keep, on the cage as it is now, and what it decides. */
static osdtex_status
read_kept(otx_session *session, job *j)
{
    osdtex_mapping_read_options options = osdtex_mapping_read_options_default();
    otx_map_flags *r = &j->request;
    const char *path = r->values->text[OTX_FLAG_KEEP];
    osdtex_status status;

    if (!path)
        return OSDTEX_OK;
    options.cage = cage_path(j);
    options.other_faces = 1;
    status = osdtex_mapping_read(session->context, path, &options, &j->keep);
    otx_session_lap(session, "old mapping read");
    if (status != OSDTEX_OK)
        return status;
    r->map_options.keep = j->keep;
    if (!r->map_options.method)
        r->map_options.method = osdtex_mapping_describe(j->keep)->method;
    if (r->map_options.scale == 0.0)
        r->map_options.scale = osdtex_mapping_describe(j->keep)->scale;
    return OSDTEX_OK;
}

/* What is wrong is said before it costs anything. */
static osdtex_status
look_ahead(otx_session *session, job *j)
{
    otx_map_flags *r = &j->request;
    osdtex_job asked = osdtex_job_none();
    osdtex_status status;

    asked.surface = &r->surface_options;
    asked.map = &r->map_options;
    asked.bake = r->bakes ? &r->bake_options : NULL;
    status = osdtex_preflight(
        session->context, j->cage, j->exemplar, &asked, &j->forecast);
    r->map_options.scale = j->forecast.scale;
    if (j->keep)
        r->surface_options.level = j->forecast.level;
    r->surface_options.leaf_edge =
        osdtex_exemplar_leaf_edge(j->exemplar, r->map_options.scale);
    otx_session_lap(session, "looked over");
    return status;
}

/* The mapping of --from, with what stands in the place of its own. */
static osdtex_status
read_saved(otx_session *session, job *j)
{
    osdtex_mapping_read_options options = osdtex_mapping_read_options_default();
    const otx_flag_values *values = j->request.values;

    options.cage = values->operands[0];
    options.exemplars[0] = values->operands[1];
    options.from = values->text[OTX_FLAG_FROM];
    options.to = j->request.exemplar_options.to;
    options.receiver = j->request.exemplar_options.receiver;
    options.texture_type = j->request.exemplar_options.texture_type;
    options.heal = j->request.map_options.heal;
    options.place = j->request.map_options.place;
    options.without_figures = !j->request.report;
    options.maps = j->request.exemplar_options.maps;
    options.map_count = j->request.exemplar_options.map_count;
    options.height_range = j->request.exemplar_options.height_range;
    options.height_middle = j->request.exemplar_options.height_middle;

    const osdtex_status status = osdtex_mapping_read(
        session->context, values->inputs.saved.path, &options, &j->mapping);

    otx_session_lap(session, "inputs read");
    return status;
}

/* Rendered before anything is written, so that what can go wrong in it leaves
 * no output behind. */
static osdtex_status
render_preview(otx_session *session, job *j)
{
    osdtex_model *model;
    osdtex_status status;

    if (!j->request.preview)
        return OSDTEX_OK;
    status = osdtex_model_create(session->context, j->mapping, &model);
    if (status == OSDTEX_OK)
        status = osdtex_render(
            session->context, model, &j->request.picture, &j->picture);
    osdtex_model_destroy(model);
    return status;
}

static osdtex_status
write_models(otx_session *session, const job *j, const char *const *comments)
{
    const otx_map_flags *r = &j->request;
    osdtex_write_options options = osdtex_write_options_default();
    osdtex_bake_options bake = r->bake_options;

    options.normals = r->values->text[OTX_FLAG_NORMALS] != NULL;
    options.pastes = r->values->text[OTX_FLAG_PASTES] != NULL;
    if (r->values->text[OTX_FLAG_RESOLUTION])
        options.resolution = bake.resolution;
    options.comments = bake.comments = comments;
    options.comment_count = bake.comment_count = 1;
    if (!r->bakes)
        return osdtex_mapping_write(
            session->context, j->mapping, r->obj, &options);
    bake.mesh = r->maps ? &options : NULL;
    return osdtex_bake(session->context, j->mapping, r->obj, &bake);
}

static osdtex_status
write_outputs(otx_session *session, const job *j)
{
    char made[64];
    const char *const comments[] = {made};
    osdtex_status status;

    snprintf(
        made, sizeof made, "osdtex %s, in the units of the cage",
        osdtex_version());
    status = write_models(session, j, comments);
    if (status == OSDTEX_OK && j->picture)
        status = osdtex_image_write(
            session->context, j->picture, j->request.preview);
    if (status == OSDTEX_OK && j->request.save)
        status =
            osdtex_mapping_save(session->context, j->mapping, j->request.save);
    /* Last, since it lists what the job wrote. */
    if (status == OSDTEX_OK && j->request.report)
        status = osdtex_report_write(
            session->context, j->mapping, j->request.report);
    return status;
}

static void
say_bake(const job *j)
{
    const otx_map_flags *r = &j->request;

    otx_session_print(
        "baked into    %s, %s and their textures of %d texels\n"
        "onto          %s, about %.4g texels per scene unit\n",
        r->cage_obj, r->cage_mtl, r->bake_options.resolution,
        j->forecast.uvs == OSDTEX_BAKE_UVS_OWN      ? "the cage's own UVs"
        : j->forecast.uvs == OSDTEX_BAKE_UVS_CHARTS ? "charts"
                                                    : "an atlas",
        j->forecast.bake_density);
}

static void
say_outputs(const job *j)
{
    const otx_map_flags *r = &j->request;

    if (r->maps)
        otx_session_print(
            "into          %s, %s, %s%s\n", r->obj, r->mtl, r->exrs[0],
            r->exr_count > 1 ? " and so on" : "");
    if (r->bakes && !r->values->inputs.saved.path)
        say_bake(j);
    if (r->bakes && r->values->inputs.saved.path)
        otx_session_print(
            "baked into    %s, %s and their textures of %d texels\n",
            r->cage_obj, r->cage_mtl, r->bake_options.resolution);
    if (r->preview)
        otx_session_print("preview       %s\n", r->preview);
    if (r->report)
        otx_session_print("report        %s\n", r->report);
    if (r->save)
        otx_session_print("saved as      %s\n", r->save);
}

static void
say_plan(const job *j)
{
    const otx_map_flags *r = &j->request;
    const osdtex_forecast *f = &j->forecast;
    const osdtex_exemplar_info *e = osdtex_exemplar_describe(j->exemplar);
    const double kept =
        e->tile_size == 0 ? (double)e->width / e->source_width : 1.0;

    otx_session_print(
        "would texture %s: %.0f faces at level %d, about %.3g GiB of memory\n"
        "with          %s: %d x %d, %g scene units wide\n"
        "by            %s\n",
        r->values->operands[0], f->face_count, f->level, f->bytes / 0x1p30,
        r->values->operands[1], e->width, e->height, kept * f->scale,
        f->method);
    for (int k = 0; k < r->also.count; ++k)
        otx_session_print(
            "and           %s%s%s%s\n", r->also.files[k],
            r->also.materials[k][0] ? " on the material " : "",
            r->also.materials[k],
            r->map_options.mask ? ", where the mask says" : "");
    say_outputs(j);
}

static void
say_saved_plan(const job *j)
{
    const osdtex_mapping_info *m = osdtex_mapping_describe(j->mapping);

    otx_session_print(
        "would take    %s: %d faces in %d patches, by %s\n",
        j->request.values->inputs.saved.path, m->face_count, m->patch_count,
        m->method);
    say_outputs(j);
}

static void
say_done(otx_session *session, const job *j)
{
    const otx_map_flags *r = &j->request;
    const osdtex_mapping_info *mapping = osdtex_mapping_describe(j->mapping);

    if (r->maps)
        otx_session_say(
            session, "wrote %s, %s, %s%s: %d faces in %d patches, %.1f s",
            r->obj, r->mtl, r->exrs[0], r->exr_count > 1 ? " and so on" : "",
            mapping->face_count, mapping->patch_count,
            otx_session_seconds(session));
    if (r->bakes)
        otx_session_say(
            session,
            "wrote %s, %s and their textures: %d faces in %d patches, %.1f s",
            r->cage_obj, r->cage_mtl, mapping->face_count, mapping->patch_count,
            otx_session_seconds(session));
    if (r->preview)
        otx_session_say(session, "wrote %s", r->preview);
    if (r->report)
        otx_session_say(session, "wrote %s", r->report);
    if (r->save)
        otx_session_say(session, "saved %s", r->save);
}

/* The mapping goes with its faces to the operand. */
static osdtex_status
pose(otx_session *session, job *j)
{
    osdtex_mapping *posed;
    const osdtex_status status =
        osdtex_mapping_pose(session->context, j->mapping, j->frame, &posed);

    osdtex_mapping_destroy(j->mapping);
    j->mapping = posed;
    return status;
}

static osdtex_status
map(otx_session *session, job *j)
{
    osdtex_status status = osdtex_surface_refine(
        session->context, j->cage, &j->request.surface_options, &j->surface);

    otx_session_lap(session, "refined");
    j->request.map_options.surface = j->surface;
    if (status == OSDTEX_OK)
        status = osdtex_map(
            session->context, j->cage, j->exemplar, &j->request.map_options,
            &j->mapping);
    if (status == OSDTEX_OK && j->frame)
        status = pose(session, j);
    otx_session_lap(session, "mapped");
    return status;
}

static osdtex_status
texture(otx_session *session, job *j)
{
    const bool is_saved = j->request.values->inputs.saved.path != NULL;
    osdtex_status status =
        is_saved ? read_saved(session, j) : read_inputs(session, j);

    if (status == OSDTEX_OK && !is_saved)
        status = read_kept(session, j);
    if (status == OSDTEX_OK && !is_saved)
        status = look_ahead(session, j);
    if (status == OSDTEX_OK && j->request.values->text[OTX_FLAG_DRY_RUN])
    {
        (is_saved ? say_saved_plan : say_plan)(j);
        return OSDTEX_OK;
    }
    if (status == OSDTEX_OK && !is_saved)
        status = map(session, j);
    if (status == OSDTEX_OK)
        status = render_preview(session, j);
    otx_session_lap(session, "rendered");
    if (status == OSDTEX_OK)
        status = write_outputs(session, j);
    if (status == OSDTEX_OK)
        status = otx_session_commit(session);
    otx_session_lap(session, "written");
    if (status == OSDTEX_OK)
        say_done(session, j);
    return status;
}

static void
clean_up(job *j)
{
    osdtex_image_destroy(j->picture);
    osdtex_mapping_destroy(j->mapping);
    osdtex_mapping_destroy(j->keep);
    osdtex_surface_destroy(j->surface);
    otx_also_flags_destroy(&j->request.also);
    otx_material_flags_destroy(&j->request.material);
    osdtex_exemplar_destroy(j->exemplar);
    osdtex_cage_destroy(j->cage);
    osdtex_cage_destroy(j->frame);
    otx_saved_files_free(&j->values.inputs.saved);
}

static osdtex_status
check_outputs(otx_session *session, const job *j)
{
    otx_path_list outputs = {0};
    osdtex_status status;

    otx_map_flags_outputs(&j->request, &outputs);
    status = otx_guard_check(session, j->request.values, &outputs);
    otx_path_list_free(&outputs);
    return status;
}

static osdtex_status
mark_outputs(otx_session *session, job *j)
{
    const otx_flag_values *values = j->request.values;

    j->has_hash = otx_up_to_date_job(session->context, values, j->hash);
    return osdtex_outputs_mark(
        session->context, j->has_hash ? j->hash : NULL,
        otx_saved_files_source(values));
}

/* Everything that can be wrong with the names of files. */
static osdtex_status
prepare(otx_session *session, job *j)
{
    osdtex_status status =
        otx_saved_files_take(session, &j->values.inputs.saved);

    if (status == OSDTEX_OK)
        status = otx_material_flags_take(
            session, &j->values, 1, &j->request.exemplar_options,
            &j->request.material);
    if (status == OSDTEX_OK)
        status = otx_also_flags_find(
            session->context, &j->values.inputs, &j->request.also);
    if (status == OSDTEX_OK && j->values.inputs.saved.path &&
        !otx_map_flags_name(&j->request))
        status = OSDTEX_ERROR_ARGUMENT;
    if (status == OSDTEX_OK)
        status = check_outputs(session, j);
    if (status == OSDTEX_OK)
        status = mark_outputs(session, j);
    return status;
}

/* Some flags of the bake have a say where nothing is baked: the size of the
 * texture of pastes, healing in previews and what is saved, whose loss in UVs
 * the library tells, and which way is up in previews. */
static bool
is_for_bakes_only(const otx_map_flags *r, int id)
{
    return otx_flag_at((otx_flag_id)id)->group == OTX_FLAG_GROUP_BAKE &&
           id != OTX_FLAG_RESOLUTION && id != OTX_FLAG_HEAL &&
           !(id == OTX_FLAG_UP && r->preview);
}

/* Flags of the bake where nothing is baked, and of pictures without one. */
static void
say_unused(otx_session *session, const otx_map_flags *r)
{
    for (int id = 0; id < OTX_FLAG_COUNT; ++id)
    {
        if (!r->values->text[id])
            continue;
        if (!r->bakes && is_for_bakes_only(r, id))
            otx_session_say(
                session,
                "warning: --%s is for a bake, which only --bake asks "
                "for here",
                otx_flag_at((otx_flag_id)id)->name);
        if (!r->preview &&
            otx_flag_at((otx_flag_id)id)->group == OTX_FLAG_GROUP_PICTURE)
            otx_session_say(
                session,
                "warning: --%s is for a picture, which only --preview "
                "asks for here",
                otx_flag_at((otx_flag_id)id)->name);
    }
}

static int
run(const otx_flag_values *values, bool bake_only)
{
    osdtex_status status;
    otx_session session;
    job j = {.values = *values};

    if (!otx_map_flags_parse(&j.values, bake_only, &j.request))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    say_unused(&session, &j.request);
    status = prepare(&session, &j);
    if (status == OSDTEX_OK && values->text[OTX_FLAG_UPDATE] && j.has_hash &&
        otx_map_flags_is_done(&j.request, j.hash))
        otx_session_say(
            &session, "%s is up to date",
            j.request.maps ? j.request.obj : j.request.cage_obj);
    else if (status == OSDTEX_OK)
        status = texture(&session, &j);
    clean_up(&j);
    return otx_session_end(&session, status);
}

int
otx_map_command_run(const otx_flag_values *values)
{
    return run(values, false);
}

int
otx_bake_command_run(const otx_flag_values *values)
{
    return run(values, true);
}
