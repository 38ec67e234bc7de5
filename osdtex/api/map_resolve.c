/* map_resolve.c -- defaults filled in, and what cannot be refused. */
#include "api/map_resolve.h"

#include "word/near.h"

#include <math.h>
#include <string.h>

/* Wanted lengths from which faces that cannot be subdivided are coarse against
 * what is in a picture. */
#define COARSE 3.0

/* Leaf edges across an exemplar of the default scale: at 14 texels an edge, a
 * picture 672 texels wide. */
#define LEAVES_ACROSS 48.0

static void
note_level(otx_run *run, const osdtex_cage *cage, double wanted, int32_t level)
{
    const double edge = cage->cage.mean_edge_length;

    if (cage->cage.scheme != OTX_SCHEME_NONE)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "surface", OTX_NOWHERE,
            "level %d: leaf edges come to about %.3g", level,
            ldexp(edge, -level));
    else if (edge < COARSE * wanted)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "surface", OTX_NOWHERE,
            "a plain mesh, textured as it is: its edges come to %.3g", edge);
    else
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "surface", OTX_NOWHERE,
            "the edges of this plain mesh come to %.3g, where %.3g would suit "
            "the exemplar, and seams can only run along them; {scheme} "
            "bilinear subdivides it and keeps its shape",
            edge, wanted);
}

otx_status
otx_resolve_level(
    otx_run *run, const osdtex_cage *cage,
    const osdtex_surface_options *options, double leaf_edge, int32_t *out)
{
    *out = options->level;
    if (options->level >= 0 && options->level <= OSDTEX_LEVEL_MAX)
        return OSDTEX_OK;
    if (options->level != OSDTEX_LEVEL_AUTO)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "surface", OTX_NOWHERE,
            "the level is from 0 to %d, or auto; not %d", OSDTEX_LEVEL_MAX,
            options->level);
    if (!(leaf_edge >= 0.0) || !isfinite(leaf_edge))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "surface", OTX_NOWHERE,
            "the length of leaf edges is a positive number of scene units, or "
            "0 for what suits most exemplars; not %g",
            leaf_edge);
    if (leaf_edge == 0.0)
        leaf_edge = cage->info.default_scale / LEAVES_ACROSS;
    *out = otx_surface_level_for(&cage->cage, leaf_edge);
    note_level(run, cage, leaf_edge, *out);
    return OSDTEX_OK;
}

static const char *
method_name(const void *list, int32_t index)
{
    (void)list;
    return index < otx_method_count() ? otx_method_at(index)->name : NULL;
}

otx_status
otx_resolve_method(otx_run *run, const char *name, const otx_method **out)
{
    char near_names[256];

    *out = name ? otx_method_find(name) : otx_method_at(0);
    if (*out)
        return OSDTEX_OK;
    otx_near_text(name, method_name, NULL, near_names);
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
        "there is no method '%.60s'%s", name, near_names);
}

otx_status
otx_resolve_scale(
    otx_run *run, const osdtex_cage_info *cage, double asked, double *out)
{
    *out = asked;
    if (asked == 0.0)
    {
        *out = cage->default_scale;
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
            "scale %g: a fifth of the diagonal of the cage's bounding box",
            *out);
    }
    if (*out > 0.0 && isfinite(*out))
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
        "the scale is a positive number of scene units, not %g", *out);
}

otx_status
otx_resolve_request(
    otx_run *run, const osdtex_cage *cage, const osdtex_exemplar_info *exemplar,
    const osdtex_map_options *options, otx_map_request *out)
{
    const int32_t faces = cage->info.face_count;

    *out = (otx_map_request){
        .first_face = options->first_face,
        .first_position = {options->first_u, options->first_v},
        .first_angle = options->first_angle,
    };
    OTX_TRY(otx_resolve_scale(run, &cage->info, options->scale, &out->scale));
    /* A scale means the picture as it was given, not what was cut out of it. */
    if (exemplar->tile_size == 0)
        out->scale *= (double)exemplar->width / exemplar->source_width;
    if (options->first_face < -1 || options->first_face >= faces)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "the first patch begins at face %d, but the cage has faces 0 to "
            "%d",
            options->first_face, faces - 1);
    if (!isfinite(options->first_u) || !isfinite(options->first_v) ||
        !isfinite(options->first_angle))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "position and angle of the first patch must be finite");
    return OSDTEX_OK;
}
