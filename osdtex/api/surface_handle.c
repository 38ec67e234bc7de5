/* surface_handle.c -- refinement, with the level chosen by leaf size. */
#include "api/call.h"
#include "api/handle.h"
#include "api/map_resolve.h"

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

    OTX_TRY(otx_run_ok(run));
    if (!cage)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "surface", OTX_NOWHERE,
            "no cage is given");
    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    OTX_TRY(otx_resolve_level(run, cage, &ours, ours.leaf_edge, &level));
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
