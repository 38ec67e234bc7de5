/* surface_handle.c -- refinement, with the level chosen by leaf size. */
#include "api/call.h"
#include "api/handle.h"

#include <math.h>

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

static otx_status
choose_level(
    otx_run *run, const osdtex_cage *cage,
    const osdtex_surface_options *options, int32_t *level)
{
    double wanted;

    *level = options->level;
    if (options->level >= 0 && options->level <= OSDTEX_LEVEL_MAX)
        return OSDTEX_OK;
    if (options->level != OSDTEX_LEVEL_AUTO)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "surface", OTX_NOWHERE,
            "the level is from 0 to %d, or auto; not %d", OSDTEX_LEVEL_MAX,
            options->level);
    if (!(options->leaf_edge >= 0.0) || !isfinite(options->leaf_edge))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "surface", OTX_NOWHERE,
            "the length of leaf edges is a positive number of scene units, or "
            "0 for what suits most exemplars; not %g",
            options->leaf_edge);
    wanted = options->leaf_edge > 0.0
                 ? options->leaf_edge
                 : cage->info.default_scale / LEAVES_ACROSS;
    *level = otx_surface_level_for(&cage->cage, wanted);
    note_level(run, cage, wanted, *level);
    return OSDTEX_OK;
}

static osdtex_surface_info
info_of(const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const double *origin = surface->cage->origin;

    return (osdtex_surface_info){
        .level = surface->level_count - 1,
        .vert_count = leaf->vert_count,
        .face_count = leaf->face_count,
        .corner_count = leaf->corner_count,
        .points = surface->points,
        .normals = surface->normals,
        .tangents = surface->tangents,
        .face_first = leaf->face_first,
        .face_verts = leaf->face_verts,
        .face_cage = leaf->face_cage,
        .face_hole = leaf->face_hole,
        .uvs = surface->uvs,
        .face_uvs = surface->face_uvs,
        .uv_count = surface->uv_count,
        .area = surface->area,
        .mean_edge_length = surface->mean_edge_length,
        .origin = {origin[0], origin[1], origin[2]},
    };
}

static otx_status
refine(
    otx_call *call, const osdtex_cage *cage,
    const osdtex_surface_options *options, osdtex_surface **out)
{
    osdtex_surface_options ours = osdtex_surface_options_default();
    otx_run *run = &call->run;
    osdtex_surface *handle = OTX_ZNEW(run->arena, osdtex_surface, 1);
    int32_t level;

    if (!handle)
        return otx_fail_memory(run, "surface");
    if (!cage)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "surface", OTX_NOWHERE,
            "no cage is given");
    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    OTX_TRY(choose_level(run, cage, &ours, &level));
    handle->arena = run->arena;
    handle->cage = cage;
    OTX_TRY(otx_call_hold(run, cage->arena));
    OTX_TRY(otx_surface_refine(
        run, &cage->cage, level, call->context->options.memory_limit,
        &handle->surface));
    handle->info = info_of(&handle->surface);
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_surface_refine(
    osdtex_context *context, const osdtex_cage *cage,
    const osdtex_surface_options *options, osdtex_surface **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "surface", &call));
    return otx_call_end(&call, refine(&call, cage, options, out), out);
}

const osdtex_surface_info *
osdtex_surface_describe(const osdtex_surface *surface)
{
    return surface ? &surface->info : NULL;
}

void
osdtex_surface_destroy(osdtex_surface *surface)
{
    if (surface)
        otx_arena_destroy(surface->arena);
}
