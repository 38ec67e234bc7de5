/* pose_call.c -- a mapping on its cage in another pose. */
#include "api/call.h"
#include "api/mapping_info.h"
#include "api/saved_about.h"

#include <string.h>

static const char STAGE[] = "pose";

static otx_status
check_faces(otx_run *run, const otx_cage *from, const otx_cage *to)
{
    const char *a, *b;

    OTX_TRY(otx_saved_topology(run, from, &a));
    OTX_TRY(otx_saved_topology(run, to, &b));
    return strcmp(a, b) == 0 && from->vert_count == to->vert_count
               ? OSDTEX_OK
               : otx_fail(
                     run, OSDTEX_ERROR_ARGUMENT, STAGE,
                     otx_where_file(to->path),
                     "the cage has other faces than the one at rest, whose "
                     "texture could not go with them; give both the same "
                     "faces in the same order");
}

/* The points that the mapping was made for, relative to the other cage's
 * origin. */
static otx_status
take_rest(
    otx_run *run, const osdtex_mapping *from, const otx_cage *to,
    const float **out)
{
    const otx_cage *cage = &from->surface->cage->cage;
    const float *points = from->made_for ? from->made_for : cage->points;
    const size_t count = 3 * (size_t)cage->vert_count;
    float *rest = OTX_NEW(run->arena, float, count);

    OTX_TRY(otx_run_ok(run));
    for (size_t i = 0; i < count; ++i)
        rest[i] =
            (float)((double)points[i] + cage->origin[i % 3] - to->origin[i % 3]);
    *out = rest;
    return OSDTEX_OK;
}

/* The surface of the mapping, with the density that it has. */
static otx_status
take_surface(otx_run *run, const otx_surface *surface, otx_mapping *mapping)
{
    const float *density = mapping->surface->density;
    otx_surface *mine;

    mapping->surface = surface;
    if (!density)
        return OSDTEX_OK;
    mine = OTX_NEW(run->arena, otx_surface, 1);
    OTX_TRY(otx_run_ok(run));
    *mine = *surface;
    mine->density = density;
    mapping->surface = mine;
    return OSDTEX_OK;
}

static otx_status
pose(
    otx_call *call, const osdtex_mapping *mapping, const osdtex_cage *cage,
    osdtex_mapping **out)
{
    otx_run *run = &call->run;
    osdtex_surface_options level = osdtex_surface_options_default();
    osdtex_mapping *h = OTX_ZNEW(run->arena, osdtex_mapping, 1);
    osdtex_surface *surface;
    otx_status status;

    OTX_TRY(otx_run_ok(run));
    if (!mapping || !cage)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping or no cage is given");
    OTX_TRY(check_faces(run, &mapping->surface->cage->cage, &cage->cage));
    level.level = mapping->surface->info.level;
    OTX_TRY(osdtex_surface_refine(call->context, cage, &level, &surface));
    status = otx_call_hold(run, surface->arena);
    osdtex_surface_destroy(surface);
    OTX_TRY(status);
    OTX_TRY(otx_call_hold(run, mapping->arena));
    *h = *mapping;
    h->arena = run->arena;
    h->base = NULL;
    h->surface = surface;
    OTX_TRY(take_rest(run, mapping, &cage->cage, &h->made_for));
    OTX_TRY(take_surface(run, &surface->surface, &h->mapping));
    h->info = otx_mapping_info_of(h);
    *out = h;
    return OSDTEX_OK;
}

osdtex_status
osdtex_mapping_pose(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_cage *cage, osdtex_mapping **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_end(&call, pose(&call, mapping, cage, out), out);
}
