/* info_command.c -- osdtex info: what a file is, as osdtex sees it. */
#include "cli/inputs.h"
#include "cli/session.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void
print_cage(const osdtex_cage_info *c)
{
    const int others = c->face_count - c->triangle_count - c->quad_count;

    printf("%s: cage, hash %s\n", c->path, c->hash ? c->hash : "none");
    printf(
        "  faces       %d (%d quads, %d triangles, %d others), %d vertices, "
        "%d edges\n",
        c->face_count, c->quad_count, c->triangle_count, others, c->vert_count,
        c->edge_count);
    printf(
        "  components  %d, %d boundary edges%s\n", c->component_count,
        c->boundary_edge_count, c->boundary_edge_count == 0 ? ": closed" : "");
    printf(
        "  box         %.9g %.9g %.9g to %.9g %.9g %.9g, diagonal %g\n",
        c->lower[0], c->lower[1], c->lower[2], c->upper[0], c->upper[1],
        c->upper[2], c->diagonal);
    printf(
        "  edges       %g long in the mean; default scale %g\n",
        c->mean_edge_length, c->default_scale);
    printf(
        "  tags        %d creases, %d corners, %d holes\n", c->crease_count,
        c->corner_count, c->hole_count);
    if (c->scheme == OSDTEX_SCHEME_NONE)
        printf("  rules       none: a plain mesh, textured as it is\n");
    else
        printf(
            "  rules       %s, boundary %s, face-varying %s\n",
            otx_inputs_scheme_name(c->scheme),
            otx_inputs_boundary_name(c->boundary),
            otx_inputs_fvar_name(c->fvar));
    printf(
        "  carries     %d UVs, %d groups, %d materials\n", c->uv_count,
        c->group_count, c->material_count);
    if (c->triangle_count == c->face_count &&
        (c->scheme == OSDTEX_SCHEME_CATMARK ||
         c->scheme == OSDTEX_SCHEME_BILINEAR))
        printf(
            "  hint        all faces are triangles: --scheme loop, or none for "
            "a scan?\n");
}

static void
print_exemplar(const osdtex_exemplar_info *e)
{
    /* A profile or the like stands there in words. */
    const char *quote = strchr(e->source_space, '\'') ? "" : "'";
    static const char *const tiles[2][2] = {
        {"in no direction", "bottom to top"}, {"left to right", "both ways"}};

    printf("%s: picture, hash %s\n", e->path, e->hash ? e->hash : "none");
    printf(
        "  size        %d x %d, %d channels, %s\n", e->width, e->height,
        e->channels, e->type);
    printf(
        "  colours     from %s%s%s to '%s', compared in '%s' (%s)\n", quote,
        e->source_space, quote, e->linear_space,
        e->match_space ? e->match_space : "the sRGB curve", e->embedding);
    printf(
        "  tiles       %s%s\n", tiles[e->wrap_x != 0][e->wrap_y != 0],
        e->made_tileable ? ", once made to" : "");
}

static void
print_structure(const osdtex_exemplar_structure *s)
{
    const double *g = s->generators;

    printf(
        "  structure   %s: coherence %.2f, regularity %.2f\n", s->name,
        s->coherence, s->regularity);
    if (s->symmetry > 0)
        printf(
            "  direction   %.0f degrees, the same after a turn of %d\n",
            s->angle * 180.0 / 3.14159265358979323846, 360 / s->symmetry);
    if (strcmp(s->name, "lattice") == 0)
        printf(
            "  repeats     by (%.1f, %.1f) and (%.1f, %.1f) texels\n", g[0],
            g[1], g[2], g[3]);
}

static osdtex_status
inspect_cage(
    osdtex_context *context, const char *path,
    const osdtex_cage_options *options)
{
    osdtex_cage *cage;
    const osdtex_status status =
        osdtex_cage_read(context, path, options, &cage);

    if (status == OSDTEX_OK)
        print_cage(osdtex_cage_describe(cage));
    osdtex_cage_destroy(cage);
    return status;
}

static osdtex_status
inspect_exemplar(
    osdtex_context *context, const char *path,
    const osdtex_exemplar_options *options)
{
    osdtex_exemplar_structure structure;
    osdtex_exemplar *exemplar;
    osdtex_status status =
        osdtex_exemplar_read(context, path, options, &exemplar);

    if (status == OSDTEX_OK)
        print_exemplar(osdtex_exemplar_describe(exemplar));
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_analyse(context, exemplar, &structure);
    if (status == OSDTEX_OK)
        print_structure(&structure);
    osdtex_exemplar_destroy(exemplar);
    return status;
}

int
otx_info_command_run(const otx_flag_values *values)
{
    const char *path = values->operands[0];
    osdtex_cage_options cage_options;
    osdtex_exemplar_options exemplar_options;
    otx_session session;
    osdtex_status status;

    if (!otx_inputs_cage(values, &cage_options) ||
        !otx_inputs_exemplar(values, &exemplar_options))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    status = otx_inputs_is_picture(path) || otx_inputs_is_binary(path)
                 ? inspect_exemplar(session.context, path, &exemplar_options)
                 : inspect_cage(session.context, path, &cage_options);
    return otx_session_end(&session, status);
}
