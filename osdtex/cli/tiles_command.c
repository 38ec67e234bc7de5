/* tiles_command.c -- osdtex tiles: a tiled texture from a picture. */
#include "cli/dispatch.h"
#include "cli/guard.h"
#include "cli/inputs.h"
#include "cli/material_flags.h"
#include "cli/saved_files.h"
#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>
#include <string.h>

#define DEGREES (3.14159265358979323846 / 180.0)

enum
{
    EDGES_MAX = 6,
    NAME_BYTES = 4096
};

/* The job as the flags ask for it. */
typedef struct job
{
    otx_flag_values values;
    otx_material_flags material;
    const char *output;
    osdtex_exemplar_options exemplar_options;
    osdtex_cage_options cage_options;
    osdtex_surface_options surface_options;
    osdtex_tiles_options options;
    osdtex_tiles_edge edges[EDGES_MAX];
    osdtex_setting settings[OTX_FLAG_SETTINGS_MAX + 1];
} job;

/* X,Y,ANGLE or X,Y,ANGLE,LENGTH, as often as given. */
static bool
parse_edges(job *j)
{
    for (int i = 0; i < j->values.edge_count; ++i)
    {
        const char *text = j->values.edges[i];
        double v[4] = {0.0, 0.0, 0.0, 0.0};

        if (i == EDGES_MAX ||
            (!otx_value_reals(text, 4, v) && !otx_value_reals(text, 3, v)) ||
            v[3] < 0.0)
        {
            otx_session_refuse(
                i == EDGES_MAX ? "--edge-template is given too often: '%s'"
                               : "--edge-template takes X,Y,ANGLE[,LENGTH], "
                                 "not '%s'",
                text);
            return false;
        }
        j->edges[i] = (osdtex_tiles_edge){v[0], v[1], v[2] * DEGREES, v[3]};
    }
    j->options.edges = j->edges;
    j->options.edge_count = j->values.edge_count;
    return true;
}

static bool
parse_places(job *j)
{
    const char *corner = j->values.text[OTX_FLAG_CORNER_TEMPLATE];
    const char *background = j->values.text[OTX_FLAG_BACKGROUND];
    double v[4];

    if (corner)
    {
        if (!otx_value_reals(corner, 2, v))
        {
            otx_session_refuse("--corner-template takes X,Y, not '%s'", corner);
            return false;
        }
        j->options.has_corner = 1;
        j->options.corner_x = v[0];
        j->options.corner_y = v[1];
    }
    if (!background)
        return true;
    if (!otx_value_reals(background, 4, v) || !(v[0] >= 0.0) ||
        !(v[1] >= 0.0) || !(v[2] > v[0]) || !(v[3] > v[1]) ||
        !(v[2] <= 32768.0) || !(v[3] <= 32768.0))
    {
        otx_session_refuse(
            "--background takes X0,Y0,X1,Y1 in texels, lower left and upper "
            "right, not '%s'",
            background);
        return false;
    }
    for (int i = 0; i < 4; ++i)
        j->options.background[i] = (int32_t)v[i];
    return true;
}

static bool
parse_blend(job *j)
{
    const char *text = j->values.text[OTX_FLAG_BLEND];

    j->options.ramp = text && strcmp(text, "ramp") == 0;
    if (!text || j->options.ramp || strcmp(text, "cut") == 0)
        return true;
    otx_session_refuse("--blend is cut or ramp, not '%s'", text);
    return false;
}

static bool
parse_numbers(job *j)
{
    const otx_flag_values *values = &j->values;
    int64_t boundaries = 1, corners = 1, size = 0, gutter = 4, seed = 1;

    if (!otx_inputs_number(values, OTX_FLAG_BOUNDARIES, 1, 3, &boundaries) ||
        !otx_inputs_number(values, OTX_FLAG_CORNERS, 1, 4, &corners) ||
        !otx_inputs_number(values, OTX_FLAG_TILE_SIZE, 16, 2048, &size) ||
        !otx_inputs_number(values, OTX_FLAG_GUTTER, 1, 256, &gutter) ||
        !otx_inputs_number(values, OTX_FLAG_SEED, 0, INT64_MAX, &seed))
        return false;
    j->options.boundaries = (int32_t)boundaries;
    j->options.corners = (int32_t)corners;
    j->options.tile_size = (int32_t)size;
    j->options.gutter = (int32_t)gutter;
    j->options.seed = (uint64_t)seed;
    j->options.oriented = values->text[OTX_FLAG_ORIENTED] != NULL;
    return true;
}

/* What `osdtex map` will be asked, for --for. */
static bool
parse_mesh(job *j)
{
    const otx_flag_values *values = &j->values;
    const char *scale = values->text[OTX_FLAG_SCALE];
    const char *tile_level = values->text[OTX_FLAG_TILE_LEVEL];
    int64_t level = OSDTEX_LEVEL_AUTO;

    j->surface_options = osdtex_surface_options_default();
    if (scale && (!otx_value_real(scale, &j->options.scale) ||
                  !(j->options.scale > 0.0)))
    {
        otx_session_refuse(
            "--scale takes a positive number of scene units, not '%s'", scale);
        return false;
    }
    if (!otx_inputs_number(
            values, tile_level ? OTX_FLAG_TILE_LEVEL : OTX_FLAG_LEVEL, 0,
            OSDTEX_LEVEL_MAX, &level))
        return false;
    j->surface_options.level = (int32_t)level;
    memcpy(
        j->settings, values->settings,
        (size_t)values->setting_count * sizeof *j->settings);
    j->options.settings = j->settings;
    j->options.setting_count = values->setting_count;
    if (tile_level)
        j->settings[j->options.setting_count++] =
            (osdtex_setting){"level", tile_level};
    return true;
}

static bool
parse(job *j, const otx_flag_values *values)
{
    *j = (job){.values = *values, .output = values->text[OTX_FLAG_OUTPUT]};
    j->options = osdtex_tiles_options_default();
    if (!j->output || !otx_value_has_extension(j->output, ".exr"))
    {
        otx_session_refuse("osdtex tiles writes an EXR: -o DIR/NAME.exr");
        return false;
    }
    if (!otx_inputs_exemplar(values, &j->exemplar_options))
        return false;
    /* What cuts inside tiles weigh was measured in Lab. */
    if (!values->text[OTX_FLAG_MATCH_IN])
        j->exemplar_options.embedding = OSDTEX_EMBEDDING_LAB;
    /* Tiles have cuts of their own. */
    j->exemplar_options.tileable = OSDTEX_TILEABLE_KEEP;
    return otx_inputs_cage(values, &j->cage_options) && parse_numbers(j) &&
           parse_blend(j) && parse_edges(j) && parse_places(j) && parse_mesh(j);
}

static void
say_done(otx_session *session, const job *j, const osdtex_tiles_info *info)
{
    if (j->options.ramp)
    {
        otx_session_say(
            session,
            "wrote %s: %d tiles of %d texels, %d x %d, cross-faded; they do "
            "not meet at vertices, %.1f s",
            j->output, info->tile_count, info->tile_size, info->width,
            info->height, otx_session_seconds(session));
        return;
    }
    otx_session_say(
        session,
        "wrote %s: %d tiles of %d texels, %d x %d; cuts inside tiles %.2f of a "
        "random pair, %.1f s",
        j->output, info->tile_count, info->tile_size, info->width, info->height,
        info->random_pair > 0.0 ? info->inner_cut / info->random_pair : 0.0,
        otx_session_seconds(session));
    if (info->vertex_window >= 0.0)
        otx_session_say(
            session,
            "what is seen around vertices is %.2f of a random pair from the "
            "picture, inside tiles %.2f",
            info->vertex_window, info->inner_window);
}

/* The surface that --for names; *out stays NULL without. */
static osdtex_status
read_mesh(
    otx_session *session, job *j, const osdtex_exemplar *exemplar,
    osdtex_cage **cage, osdtex_surface **out)
{
    const char *path = j->values.text[OTX_FLAG_FOR];
    osdtex_status status;

    if (!path)
        return OSDTEX_OK;
    status = osdtex_cage_read(session->context, path, &j->cage_options, cage);
    if (status != OSDTEX_OK)
        return status;
    if (j->options.scale == 0.0)
        j->options.scale = osdtex_cage_describe(*cage)->default_scale;
    j->surface_options.leaf_edge =
        osdtex_exemplar_leaf_edge(exemplar, j->options.scale);
    return osdtex_surface_refine(
        session->context, *cage, &j->surface_options, out);
}

static osdtex_status
make(otx_session *session, job *j)
{
    osdtex_context *context = session->context;
    osdtex_exemplar *exemplar;
    osdtex_surface *surface = NULL;
    osdtex_cage *cage = NULL;
    osdtex_tiles_info info;
    osdtex_status status = osdtex_exemplar_read(
        context, j->values.operands[0], &j->exemplar_options, &exemplar);

    if (status == OSDTEX_OK)
        status = read_mesh(session, j, exemplar, &cage, &surface);
    otx_session_lap(session, "inputs read");
    if (status == OSDTEX_OK && j->values.text[OTX_FLAG_DRY_RUN])
        otx_session_print(
            "would make tiles of %s into %s\n", j->values.operands[0],
            j->output);
    else if (status == OSDTEX_OK)
    {
        status = osdtex_tiles_write(
            context, exemplar, surface, &j->options, j->output, &info);
        if (status == OSDTEX_OK)
            status = otx_session_commit(session);
        if (status == OSDTEX_OK)
            say_done(session, j, &info);
    }
    osdtex_surface_destroy(surface);
    osdtex_cage_destroy(cage);
    osdtex_exemplar_destroy(exemplar);
    return status;
}

/* NAME.exr, and NAME_normal.exr and so on beside it. */
static osdtex_status
check_outputs(otx_session *session, const job *j)
{
    const uint32_t kinds = otx_material_flags_kinds(&j->material);
    const int base = (int)strlen(j->output) - 4;
    char names[OSDTEX_MAP_KINDS][NAME_BYTES];
    otx_path_list outputs = {0};
    osdtex_status status = OSDTEX_OK;

    otx_path_list_add(&outputs, j->output);
    for (osdtex_map_kind k = 0; k < OSDTEX_MAP_KINDS; ++k)
    {
        if (!(kinds & 1u << k))
            continue;
        if (snprintf(
                names[k], NAME_BYTES, "%.*s_%s.exr", base, j->output,
                osdtex_map_kind_name(k)) < NAME_BYTES)
            otx_path_list_add(&outputs, names[k]);
        else
            status = OSDTEX_ERROR_ARGUMENT;
    }
    if (status != OSDTEX_OK)
        otx_session_refuse("'%s' is too long a name", j->output);
    else
        status = otx_guard_check(session, &j->values, &outputs);
    otx_path_list_free(&outputs);
    return status == OSDTEX_OK
               ? osdtex_outputs_mark(
                     session->context, NULL, otx_saved_files_source(&j->values))
               : status;
}

int
otx_tiles_command_run(const otx_flag_values *values)
{
    osdtex_status status;
    otx_session session;
    job j;

    if (!parse(&j, values))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    status = otx_material_flags_take(
        &session, &j.values, 0, &j.exemplar_options, &j.material);
    if (status == OSDTEX_OK)
        status = check_outputs(&session, &j);
    if (status == OSDTEX_OK)
        status = make(&session, &j);
    otx_material_flags_destroy(&j.material);
    return otx_session_end(&session, status);
}
