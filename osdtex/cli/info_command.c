/* info_command.c -- osdtex info: what a file is, as osdtex sees it. */
#include "cli/dispatch.h"
#include "cli/inputs.h"
#include "cli/session.h"
#include "cli/spool.h"
#include "cli/stop.h"
#include "cli/value.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static void
print_cage(const char *name, const osdtex_cage_info *c)
{
    const int others = c->face_count - c->triangle_count - c->quad_count;

    otx_session_print("%s: cage, hash %s\n", name, c->hash ? c->hash : "none");
    otx_session_print(
        "  faces       %d (%d quads, %d triangles, %d others), %d vertices, "
        "%d edges\n",
        c->face_count, c->quad_count, c->triangle_count, others, c->vert_count,
        c->edge_count);
    otx_session_print(
        "  components  %d, %d boundary edges%s\n", c->component_count,
        c->boundary_edge_count, c->boundary_edge_count == 0 ? ": closed" : "");
    otx_session_print(
        "  box         %.9g %.9g %.9g to %.9g %.9g %.9g, diagonal %g\n",
        c->lower[0], c->lower[1], c->lower[2], c->upper[0], c->upper[1],
        c->upper[2], c->diagonal);
    otx_session_print(
        "  edges       %g long in the mean; default scale %g\n",
        c->mean_edge_length, c->default_scale);
    otx_session_print(
        "  tags        %d creases, %d corners, %d holes\n", c->crease_count,
        c->corner_count, c->hole_count);
    if (c->scheme == OSDTEX_SCHEME_NONE)
        otx_session_print(
            "  rules       none: a plain mesh, textured as it is\n");
    else
        otx_session_print(
            "  rules       %s, boundary %s, face-varying %s\n",
            otx_inputs_scheme_name(c->scheme),
            otx_inputs_boundary_name(c->boundary),
            otx_inputs_fvar_name(c->fvar));
    otx_session_print(
        "  carries     %d UVs, %d groups, %d materials\n", c->uv_count,
        c->group_count, c->material_count);
    if (c->triangle_count == c->face_count &&
        (c->scheme == OSDTEX_SCHEME_CATMARK ||
         c->scheme == OSDTEX_SCHEME_BILINEAR))
        otx_session_print(
            "  hint        all faces are triangles: --scheme loop, or none for "
            "a scan?\n");
}

static void
print_exemplar(const char *name, const osdtex_exemplar_info *e)
{
    /* A profile or the like stands there in words. */
    const char *quote = strchr(e->source_space, '\'') ? "" : "'";
    static const char *const tiles[2][2] = {
        {"in no direction", "bottom to top"}, {"left to right", "both ways"}};

    otx_session_print(
        "%s: picture, hash %s\n", name, e->hash ? e->hash : "none");
    otx_session_print(
        "  size        %d x %d, %d channels, %s\n", e->width, e->height,
        e->channels, e->type);
    otx_session_print(
        "  colours     from %s%s%s to '%s', compared in '%s' (%s)\n", quote,
        e->source_space, quote, e->linear_space,
        e->match_space ? e->match_space : "the sRGB curve", e->embedding);
    otx_session_print(
        "  tiles       %s%s\n", tiles[e->wrap_x != 0][e->wrap_y != 0],
        e->made_tileable ? ", once made to" : "");
    if (e->slices > 0)
        otx_session_print(
            "  slices      %d along an axis, of which this is the middle one\n",
            e->slices);
}

static void
print_structure(const osdtex_exemplar_structure *s)
{
    const double *g = s->generators;

    otx_session_print(
        "  structure   %s: coherence %.2f, regularity %.2f\n", s->name,
        s->coherence, s->regularity);
    if (s->symmetry > 0)
        otx_session_print(
            "  direction   %.0f degrees, the same after a turn of %d\n",
            s->angle * 180.0 / 3.14159265358979323846, 360 / s->symmetry);
    if (strcmp(s->name, "lattice") == 0)
        otx_session_print(
            "  repeats     by (%.1f, %.1f) and (%.1f, %.1f) texels\n", g[0],
            g[1], g[2], g[3]);
}

static osdtex_status
inspect_cage(
    osdtex_context *context, const char *path, const char *name,
    const osdtex_cage_options *options)
{
    osdtex_cage *cage;
    const osdtex_status status =
        osdtex_cage_read(context, path, options, &cage);

    if (status == OSDTEX_OK)
        print_cage(name, osdtex_cage_describe(cage));
    osdtex_cage_destroy(cage);
    return status;
}

static osdtex_status
inspect_exemplar(
    osdtex_context *context, const char *path, const char *name,
    const osdtex_exemplar_options *options)
{
    osdtex_exemplar_structure structure;
    osdtex_exemplar *exemplar;
    osdtex_status status =
        osdtex_exemplar_read(context, path, options, &exemplar);

    if (status == OSDTEX_OK)
        print_exemplar(name, osdtex_exemplar_describe(exemplar));
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_analyse(context, exemplar, &structure);
    if (status == OSDTEX_OK)
        print_structure(&structure);
    osdtex_exemplar_destroy(exemplar);
    return status;
}

/* Roles, then spaces with their aliases, then displays with their views. */
typedef struct listing
{
    osdtex_colour_kind kind; /* of the line before; -1 none */
    char display[128];       /* the line of views goes on for */
} listing;

static void
print_item(
    void *user, osdtex_colour_kind kind, const char *name, const char *value)
{
    static const char *const titles[] = {"roles", "spaces", NULL, "displays"};
    listing *l = user;
    const bool goes_on = kind == OSDTEX_COLOUR_DISPLAY && l->kind == kind &&
                         strncmp(l->display, name, sizeof l->display - 1) == 0;

    if (kind == OSDTEX_COLOUR_ALIAS)
        otx_session_print(
            "%s%s", l->kind == OSDTEX_COLOUR_ALIAS ? ", " : "; also ", name);
    else if (goes_on)
        otx_session_print(", %s", value);
    else
    {
        const bool titled =
            kind != l->kind &&
            !(kind == OSDTEX_COLOUR_SPACE && l->kind == OSDTEX_COLOUR_ALIAS);

        if (l->kind >= 0)
            putchar('\n');
        if (titled)
            otx_session_print("  %s\n", titles[kind]);
        otx_session_print("    %s", name);
        if (value[0])
            otx_session_print(
                kind == OSDTEX_COLOUR_SPACE ? " (%s)" : ": %s", value);
        snprintf(l->display, sizeof l->display, "%s", name);
    }
    l->kind = kind;
}

static osdtex_status
inspect_configuration(osdtex_context *context)
{
    listing l = {.kind = -1};
    const osdtex_status status = osdtex_colour_list(context, print_item, &l);

    if (l.kind >= 0)
        putchar('\n');
    return status;
}

/* By its name, or by the word that every configuration has. */
static bool
is_configuration(const char *path)
{
    return strncmp(path, "ocio://", 7) == 0 ||
           otx_value_has_extension(path, ".ocio") ||
           otx_value_has_extension(path, ".ocioz") ||
           otx_inputs_holds(path, "ocio_profile_version");
}

/* The file is asked for as --colorconfig would ask for it. */
static int
run_on_configuration(const otx_flag_values *values)
{
    otx_flag_values with = *values;
    otx_session session;

    if (values->operand_count > 0)
        with.text[OTX_FLAG_COLORCONFIG] = values->operands[0];
    if (!otx_session_begin(&session, &with))
        return session.exit_code;
    otx_stop_watch(NULL);
    return otx_session_end(&session, inspect_configuration(session.context));
}

static void
print_saved_exemplar(const json_t *e)
{
    const json_t *size = json_object_get(e, "size");

    otx_session_print(
        "  exemplar    %s, hash %s: %d x %d%s\n",
        json_string_value(json_object_get(e, "path")),
        json_is_string(json_object_get(e, "hash"))
            ? json_string_value(json_object_get(e, "hash"))
            : "none",
        (int)json_integer_value(json_array_get(size, 0)),
        (int)json_integer_value(json_array_get(size, 1)),
        json_is_true(json_object_get(e, "rearranged")) ? ", made to tile" : "");
}

/* What the library has checked. */
static void
print_saved(void *path, const char *about)
{
    json_t *root = json_loads(about, 0, NULL);
    const json_t *cage = json_object_get(root, "cage");
    size_t k;
    json_t *exemplar;

    if (!root)
        return;
    otx_session_print(
        "%s: saved mapping, format %d, of osdtex %s\n", (const char *)path,
        (int)json_integer_value(json_object_get(root, "format")),
        json_string_value(json_object_get(root, "program")));
    otx_session_print(
        "  cage        %s at level %d, faces %s\n",
        json_string_value(json_object_get(cage, "path")),
        (int)json_integer_value(json_object_get(cage, "level")),
        json_string_value(json_object_get(cage, "topology")));
    json_array_foreach(json_object_get(root, "exemplars"), k, exemplar)
        print_saved_exemplar(exemplar);
    otx_session_print(
        "  mapping     %d patches by %s, %g scene units wide, seed %s\n",
        (int)json_integer_value(json_object_get(root, "patch_count")),
        json_string_value(json_object_get(root, "method")),
        json_number_value(json_object_get(root, "scale")),
        json_string_value(json_object_get(root, "seed")));
    json_decref(root);
}

static osdtex_status
inspect(
    osdtex_context *context, const char *path, const char *name,
    const osdtex_cage_options *cage, const osdtex_exemplar_options *exemplar)
{
    char title[4096];

    if (otx_value_has_extension(path, ".osdtex"))
    {
        snprintf(title, sizeof title, "%s", path);
        return osdtex_mapping_inspect(context, path, print_saved, title);
    }
    return otx_inputs_is_picture(path) || otx_inputs_is_binary(path)
               ? inspect_exemplar(context, path, name, exemplar)
               : inspect_cage(context, path, name, cage);
}

int
otx_info_command_run(const otx_flag_values *values)
{
    const char *path = values->operands[0];
    const char *name = otx_spool_name(values, path);
    osdtex_cage_options cage_options;
    osdtex_exemplar_options exemplar_options;
    otx_session session;
    osdtex_status status;

    if (!otx_inputs_cage(values, &cage_options) ||
        !otx_inputs_exemplar(values, &exemplar_options))
        return OTX_EXIT_USAGE;
    if (values->operand_count == 0 || is_configuration(path))
        return run_on_configuration(values);
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    otx_stop_watch(NULL);
    status =
        inspect(session.context, path, name, &cage_options, &exemplar_options);
    return otx_session_end(&session, status);
}
