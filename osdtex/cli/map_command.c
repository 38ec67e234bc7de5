/* map_command.c -- osdtex map and osdtex bake: a cage and an exemplar in, a
 * textured model out, or the cage with textures. */
#include "cli/also_flags.h"
#include "cli/bake_flags.h"
#include "cli/bake_outputs.h"
#include "cli/inputs.h"
#include "cli/session.h"
#include "cli/up_to_date.h"
#include "cli/value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    PATH_BYTES = 4096
};

#define DEGREES (3.14159265358979323846 / 180.0)

/* The job as the flags ask for it, and what has been made of it so far. */
typedef struct job
{
    const otx_flag_values *values;
    osdtex_cage_options cage_options;
    osdtex_exemplar_options exemplar_options;
    osdtex_surface_options surface_options;
    osdtex_map_options map_options;
    otx_also_flags also;
    osdtex_setting settings[OTX_FLAG_SETTINGS_MAX + 1];
    osdtex_bake_options bake_options;
    bool maps, bakes; /* which files are asked for */
    char obj[PATH_BYTES], mtl[PATH_BYTES];
    char exrs[OSDTEX_EXEMPLARS_MAX][PATH_BYTES]; /* "" none */
    char cage_obj[PATH_BYTES], cage_mtl[PATH_BYTES];
    const char *preview, *report; /* NULL none */
    bool has_hash;
    char hash[OSDTEX_HASH_BYTES];

    osdtex_cage *cage;
    osdtex_exemplar *exemplar;
    osdtex_surface *surface;
    osdtex_mapping *mapping;
    osdtex_image *picture;
} job;

/* FOLDER/NAME of an OBJ and another end. */
static bool
name_beside(const char *obj, const char *suffix, char out[PATH_BYTES])
{
    const int base = (int)strlen(obj) - 4;

    return snprintf(out, PATH_BYTES, "%.*s%s", base, obj, suffix) < PATH_BYTES;
}

/* NAME.exr, or of several exemplars NAME_1.exr and so on. */
static bool
name_textures(job *j)
{
    char suffix[32] = ".exr";

    for (int k = 0; k <= j->also.count; ++k)
    {
        if (j->also.count > 0)
            snprintf(suffix, sizeof suffix, "_%d.exr", k + 1);
        if (!name_beside(j->mtl, suffix, j->exrs[k]))
            return false;
    }
    return true;
}

/* NAME.mtl and NAME.exr beside NAME.obj, NAME_cage.obj and NAME_cage.mtl of a
 * bake; blanks become `_` there, as readers split at them. */
static bool
name_outputs(job *j)
{
    const char *path = j->values->text[OTX_FLAG_OUTPUT];
    const size_t length = path ? strlen(path) : 0;
    char *name;

    if (!path || !otx_value_has_extension(path, ".obj") ||
        path[length - 5] == '/' || length >= PATH_BYTES)
    {
        otx_session_refuse("the output is called NAME.obj: -o DIR/NAME.obj");
        return false;
    }
    memcpy(j->obj, path, length + 1);
    memcpy(j->mtl, path, length + 1);
    name = strrchr(j->mtl, '/');
    for (name = name ? name + 1 : j->mtl; *name; ++name)
        if (*name == ' ')
            *name = '_';
    memcpy(j->mtl + length - 4, ".mtl", 5);
    if (name_textures(j) && name_beside(j->mtl, "_cage.obj", j->cage_obj) &&
        name_beside(j->mtl, "_cage.mtl", j->cage_mtl))
        return true;
    otx_session_refuse("'%s' is too long a name", path);
    return false;
}

static bool
is_picture(const char *path)
{
    return !path || otx_value_has_extension(path, ".png") ||
           otx_value_has_extension(path, ".exr");
}

static bool
same_file(const char *a, const char *b)
{
    struct stat first, second;

    return a && b && stat(a, &first) == 0 && stat(b, &second) == 0 &&
           first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

/* An output must neither replace an input nor another output. */
static bool
outputs_are_apart(const job *j)
{
    enum
    {
        INPUTS = OSDTEX_EXEMPLARS_MAX + 3,
        OUTPUTS = OSDTEX_EXEMPLARS_MAX + 6
    };
    const char *inputs[INPUTS] = {
        j->values->operands[0], j->values->operands[1],
        j->values->text[OTX_FLAG_MASK], j->values->text[OTX_FLAG_CONSTRAINTS]};
    const char *outputs[OUTPUTS] = {
        j->maps ? j->obj : NULL,
        j->maps ? j->mtl : NULL,
        j->bakes ? j->cage_obj : NULL,
        j->bakes ? j->cage_mtl : NULL,
        j->preview,
        j->report};

    for (int k = 0; k < j->also.count; ++k)
        inputs[4 + k] = j->also.files[k];
    for (int k = 0; j->maps && k <= j->also.count; ++k)
        outputs[6 + k] = j->exrs[k];
    for (int i = 0; i < OUTPUTS; ++i)
    {
        for (int k = 0; outputs[i] && k < INPUTS; ++k)
        {
            if (!same_file(outputs[i], inputs[k]))
                continue;
            otx_session_refuse(
                "'%s' is an input and would be replaced; choose another name "
                "for the output",
                outputs[i]);
            return false;
        }
        for (int k = 0; outputs[i] && k < i; ++k)
        {
            if (!outputs[k] || strcmp(outputs[i], outputs[k]) != 0)
                continue;
            otx_session_refuse("'%s' would be written twice", outputs[i]);
            return false;
        }
    }
    return true;
}

/* Whether the folder of `path` can be written to: better said before a long
 * job than after it. */
static bool
folder_is_writable(const char *path)
{
    char folder[PATH_BYTES];
    char *slash;

    if (!path)
        return true;
    snprintf(folder, sizeof folder, "%s", path);
    slash = strrchr(folder, '/');
    if (!slash)
        snprintf(folder, sizeof folder, ".");
    else
        slash[slash == folder] = '\0';
    if (access(folder, W_OK | X_OK) == 0)
        return true;
    otx_session_refuse(
        "'%s' cannot be written: its folder is not there or is read-only",
        path);
    return false;
}

static bool
parse_numbers(job *j)
{
    const char *level = j->values->text[OTX_FLAG_LEVEL];
    const char *seed = j->values->text[OTX_FLAG_SEED];
    int64_t number;

    if (level && strcmp(level, "auto") != 0)
    {
        if (!otx_value_int(level, 0, OSDTEX_LEVEL_MAX, &number))
        {
            otx_session_refuse(
                "--level takes a number from 0 to %d or auto, not '%s'",
                OSDTEX_LEVEL_MAX, level);
            return false;
        }
        j->surface_options.level = (int32_t)number;
    }
    j->map_options.scale = j->also.scale;
    if (seed && !otx_value_int(seed, 0, INT64_MAX, &number))
    {
        otx_session_refuse("--seed takes a whole number, not '%s'", seed);
        return false;
    }
    if (seed)
        j->map_options.seed = (uint64_t)number;
    return true;
}

/* --tile-level is a setting of the method, and the level of the surface where
 * none is given. */
static bool
parse_tile_level(job *j)
{
    const char *text = j->values->text[OTX_FLAG_TILE_LEVEL];
    int64_t level;

    memcpy(
        j->settings, j->values->settings,
        (size_t)j->values->setting_count * sizeof *j->settings);
    j->map_options.settings = j->settings;
    j->map_options.setting_count = j->values->setting_count;
    if (!text)
        return true;
    if (!otx_value_int(text, 0, OSDTEX_LEVEL_MAX, &level))
    {
        otx_session_refuse(
            "--tile-level takes a number from 0 to %d, not '%s'",
            OSDTEX_LEVEL_MAX, text);
        return false;
    }
    if (!j->values->text[OTX_FLAG_LEVEL])
        j->surface_options.level = (int32_t)level;
    j->settings[j->map_options.setting_count++] =
        (osdtex_setting){"level", text};
    return true;
}

static bool
parse_fields(job *j)
{
    const char *text = j->values->text[OTX_FLAG_GENERATORS];

    j->map_options.mask = j->values->text[OTX_FLAG_MASK];
    j->map_options.constraints = j->values->text[OTX_FLAG_CONSTRAINTS];
    j->map_options.follow = j->values->text[OTX_FLAG_FOLLOW];
    j->map_options.exemplar_class = j->values->text[OTX_FLAG_EXEMPLAR_CLASS];
    if (!text || otx_value_reals(text, 4, j->map_options.generators))
        return true;
    otx_session_refuse("--generators takes X,Y,X,Y, not '%s'", text);
    return false;
}

static bool
parse_first_patch(job *j)
{
    const char *text = j->values->text[OTX_FLAG_FIRST_PATCH];
    double v[4];

    if (!text)
        return true;
    if (!otx_value_reals(text, 4, v) || v[0] < 0.0 || v[0] > INT32_MAX ||
        v[0] != floor(v[0]))
    {
        otx_session_refuse(
            "--first-patch takes FACE,U,V,ANGLE, not '%s'", text);
        return false;
    }
    j->map_options.first_face = (osdtex_index)v[0];
    j->map_options.first_u = v[1];
    j->map_options.first_v = v[2];
    j->map_options.first_angle = v[3] * DEGREES;
    return true;
}

/* Cage and exemplar are easily taken for each other. */
static bool
cage_comes_first(const job *j)
{
    const char *cage = j->values->operands[0];

    if (!otx_inputs_is_picture(cage))
        return true;
    otx_session_refuse(
        "'%s' is a picture, where the cage, an OBJ, is expected: osdtex %s "
        "CAGE.obj EXEMPLAR",
        cage, j->maps ? "map" : "bake");
    return false;
}

static bool
parse(job *j, const otx_flag_values *values, bool bake_only)
{
    *j = (job){
        .values = values,
        .maps = !bake_only,
        .bakes = bake_only || values->text[OTX_FLAG_BAKE],
    };
    j->surface_options = osdtex_surface_options_default();
    j->map_options = osdtex_map_options_default();
    j->map_options.method = values->text[OTX_FLAG_METHOD];
    j->preview = values->text[OTX_FLAG_PREVIEW];
    j->report = values->text[OTX_FLAG_JSON_REPORT];
    if (!otx_inputs_cage(values, &j->cage_options) ||
        !otx_inputs_exemplar(values, &j->exemplar_options) ||
        !otx_bake_flags_parse(values, &j->bake_options) ||
        !otx_also_flags_parse(values, &j->also) || !name_outputs(j) ||
        !parse_numbers(j) || !parse_tile_level(j) || !parse_first_patch(j) ||
        !parse_fields(j))
        return false;
    if (!is_picture(j->preview))
    {
        otx_session_refuse(
            "--preview writes a .png or .exr, not '%s'", j->preview);
        return false;
    }
    return cage_comes_first(j) && outputs_are_apart(j);
}

static bool
has_textures(const job *j)
{
    for (int k = 0; k <= j->also.count; ++k)
        if (access(j->exrs[k], F_OK) != 0)
            return false;
    return true;
}

static bool
is_done(const job *j)
{
    return j->has_hash &&
           (!j->maps || (otx_up_to_date_check(j->obj, j->hash) &&
                         access(j->mtl, F_OK) == 0 && has_textures(j))) &&
           (!j->bakes || otx_bake_outputs_are_done(
                             j->cage_obj, &j->bake_options, j->hash)) &&
           (!j->preview || access(j->preview, F_OK) == 0) &&
           (!j->report || access(j->report, F_OK) == 0);
}

/* Cage, exemplar, surface. */
static osdtex_status
read_inputs(otx_session *session, job *j)
{
    const osdtex_cage_info *cage;
    osdtex_status status;

    status = osdtex_cage_read(
        session->context, j->values->operands[0], &j->cage_options, &j->cage);
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_read(
            session->context, j->values->operands[1], &j->exemplar_options,
            &j->exemplar);
    if (status == OSDTEX_OK)
        status = otx_also_flags_read(
            session->context, &j->exemplar_options, &j->also);
    if (status != OSDTEX_OK)
        return status;
    j->map_options.also = j->also.list;
    j->map_options.also_count = j->also.count;
    otx_session_lap(session, "inputs read");
    cage = osdtex_cage_describe(j->cage);
    if (j->map_options.scale == 0.0)
    {
        j->map_options.scale = cage->default_scale;
        otx_session_say(
            session,
            "scale %g: a fifth of the diagonal of the cage's bounding box",
            cage->default_scale);
    }
    j->surface_options.leaf_edge =
        osdtex_exemplar_leaf_edge(j->exemplar, j->map_options.scale);
    return osdtex_surface_refine(
        session->context, j->cage, &j->surface_options, &j->surface);
}

/* Rendered before anything is written, so that what can go wrong in it leaves
 * no output behind. */
static osdtex_status
render_preview(otx_session *session, job *j)
{
    osdtex_render_options options = osdtex_render_options_default();
    osdtex_model *model;
    osdtex_status status;

    if (!j->preview)
        return OSDTEX_OK;
    options.show = j->values->text[OTX_FLAG_SHOW];
    status = osdtex_model_create(session->context, j->mapping, &model);
    if (status == OSDTEX_OK)
        status = osdtex_render(session->context, model, &options, &j->picture);
    osdtex_model_destroy(model);
    return status;
}

static osdtex_status
write_models(
    otx_session *session, const job *j, const char *const *comments, int count)
{
    osdtex_write_options options = osdtex_write_options_default();
    osdtex_bake_options bake = j->bake_options;

    options.comments = bake.comments = comments;
    options.comment_count = bake.comment_count = count;
    if (!j->bakes)
        return osdtex_mapping_write(
            session->context, j->mapping, j->obj, &options);
    bake.texture_comment = count > 1 ? comments[1] : NULL;
    bake.mesh = j->maps ? &options : NULL;
    /* One tile does not make the whole: the cage must not say that it is done.
     */
    if (bake.udim)
        bake.comment_count = 1;
    return osdtex_bake(session->context, j->mapping, j->obj, &bake);
}

static osdtex_status
write_outputs(otx_session *session, const job *j)
{
    char made[64], hash[128];
    const char *const comments[] = {made, hash};
    osdtex_status status;

    snprintf(
        made, sizeof made, "osdtex %s, in the units of the cage",
        osdtex_version());
    snprintf(hash, sizeof hash, OTX_UP_TO_DATE_COMMENT "%s", j->hash);
    status = write_models(session, j, comments, j->has_hash ? 2 : 1);
    if (status == OSDTEX_OK && j->picture)
        status = osdtex_image_write(session->context, j->picture, j->preview);
    if (status == OSDTEX_OK && j->report)
        status = osdtex_report_write(session->context, j->mapping, j->report);
    return status;
}

static void
say_plan(const job *j)
{
    const osdtex_surface_info *surface = osdtex_surface_describe(j->surface);
    const osdtex_exemplar_info *e = osdtex_exemplar_describe(j->exemplar);
    const double kept =
        e->tile_size == 0 ? (double)e->width / e->source_width : 1.0;
    osdtex_method_info method = {0};

    osdtex_method_get(0, &method);
    printf(
        "would texture %s: %d faces at level %d\n"
        "with          %s: %d x %d, %g scene units wide\n"
        "by            %s\n",
        j->values->operands[0], surface->face_count, surface->level,
        j->values->operands[1], e->width, e->height,
        kept * j->map_options.scale,
        j->map_options.method ? j->map_options.method : method.name);
    for (int k = 0; k < j->also.count; ++k)
        printf(
            "and           %s%s%s%s\n", j->also.files[k],
            j->also.materials[k][0] ? " on the material " : "",
            j->also.materials[k],
            j->map_options.mask ? ", where the mask says" : "");
    if (j->maps)
        printf(
            "into          %s, %s, %s%s\n", j->obj, j->mtl, j->exrs[0],
            j->also.count > 0 ? " and so on" : "");
    if (j->bakes)
        printf(
            "baked into    %s, %s and their textures of %d texels\n",
            j->cage_obj, j->cage_mtl, j->bake_options.resolution);
    if (j->preview)
        printf("preview       %s\n", j->preview);
    if (j->report)
        printf("report        %s\n", j->report);
}

static void
say_done(otx_session *session, const job *j)
{
    const osdtex_mapping_info *mapping = osdtex_mapping_describe(j->mapping);

    if (j->maps)
        otx_session_say(
            session, "wrote %s, %s, %s%s: %d faces in %d patches, %.1f s",
            j->obj, j->mtl, j->exrs[0], j->also.count > 0 ? " and so on" : "",
            mapping->face_count, mapping->patch_count,
            otx_session_seconds(session));
    if (j->bakes)
        otx_session_say(
            session,
            "wrote %s, %s and their textures: %d faces in %d patches, %.1f s",
            j->cage_obj, j->cage_mtl, mapping->face_count, mapping->patch_count,
            otx_session_seconds(session));
    if (j->preview)
        otx_session_say(session, "wrote %s", j->preview);
    if (j->report)
        otx_session_say(session, "wrote %s", j->report);
}

static osdtex_status
texture(otx_session *session, job *j)
{
    osdtex_status status = read_inputs(session, j);

    if (status != OSDTEX_OK)
        return status;
    otx_session_lap(session, "refined");
    if (j->values->text[OTX_FLAG_DRY_RUN])
    {
        say_plan(j);
        return OSDTEX_OK;
    }
    status = osdtex_map(
        session->context, j->surface, j->exemplar, &j->map_options,
        &j->mapping);
    otx_session_lap(session, "mapped");
    if (status == OSDTEX_OK)
        status = render_preview(session, j);
    otx_session_lap(session, "rendered");
    if (status == OSDTEX_OK)
        status = write_outputs(session, j);
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
    osdtex_surface_destroy(j->surface);
    otx_also_flags_destroy(&j->also);
    osdtex_exemplar_destroy(j->exemplar);
    osdtex_cage_destroy(j->cage);
}

static int
run(const otx_flag_values *values, bool bake_only)
{
    osdtex_status status;
    otx_session session;
    job j;

    if (!parse(&j, values, bake_only))
        return OTX_EXIT_USAGE;
    if (!folder_is_writable(j.obj) || !folder_is_writable(j.preview) ||
        !folder_is_writable(j.report))
        return OTX_EXIT_IO;
    j.has_hash = otx_up_to_date_job(values, j.hash);
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    if (values->text[OTX_FLAG_UPDATE] && is_done(&j))
    {
        otx_session_say(
            &session, "%s is up to date", j.maps ? j.obj : j.cage_obj);
        return otx_session_end(&session, OSDTEX_OK);
    }
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
