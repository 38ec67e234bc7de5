/* seams_handle.c -- where seams of a mapping show, for hosts. */
#include "api/call.h"
#include "api/handle.h"
#include "render/mapped_scene.h"
#include "render/seam_place.h"

static const char STAGE[] = "seams";

struct osdtex_seams
{
    otx_arena *arena;
    osdtex_seams_info info;
};

_Static_assert(
    (int)OSDTEX_SEAM_PLACES_MAX == (int)OTX_SEAM_PLACES_MAX,
    "hosts may ask for as many places as there can be");

static osdtex_seam_place
place_of(const otx_seam_place *p, const double origin[3])
{
    return (osdtex_seam_place){
        {p->point.x + origin[0], p->point.y + origin[1],
         p->point.z + origin[2]},
        {p->normal.x, p->normal.y, p->normal.z},
        p->length,
        p->difference};
}

/* What was found, as hosts see it. */
static otx_status
tell(
    otx_run *run, const otx_seam_places *found, const double origin[3],
    osdtex_seams_info *out)
{
    osdtex_seam *seams = OTX_NEW(run->arena, osdtex_seam, found->edge_count);
    osdtex_seam_place *places =
        OTX_NEW(run->arena, osdtex_seam_place, found->count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < found->edge_count; ++i)
        seams[i] =
            (osdtex_seam){found->edges[i].corner, found->edges[i].difference};
    for (int32_t i = 0; i < found->count; ++i)
        places[i] = place_of(&found->places[i], origin);
    *out = (osdtex_seams_info){seams, places, found->edge_count, found->count};
    return OSDTEX_OK;
}

static otx_status
create(
    otx_call *call, const osdtex_mapping *mapping, int32_t most,
    osdtex_seams **out)
{
    otx_run *run = &call->run, aside;
    osdtex_seams *handle = OTX_ZNEW(run->arena, osdtex_seams, 1);
    otx_seam_places found;
    otx_scene scene;

    OTX_TRY(otx_run_ok(run));
    if (!mapping || most < 0 || most > OTX_SEAM_PLACES_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping is given, or places are not 0 to %d",
            OTX_SEAM_PLACES_MAX);
    OTX_TRY(otx_call_aside(call, &aside));
    OTX_TRY(otx_scene_from_mapping(
        &aside, &mapping->mapping, mapping->exemplars, &scene));
    OTX_TRY(otx_seam_places_find(&aside, aside.arena, &scene, most, &found));
    OTX_TRY(tell(run, &found, mapping->surface->info.origin, &handle->info));
    handle->arena = run->arena;
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_seams_create(
    osdtex_context *context, const osdtex_mapping *mapping, int32_t places,
    osdtex_seams **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_end(&call, create(&call, mapping, places, out), out);
}

const osdtex_seams_info *
osdtex_seams_describe(const osdtex_seams *seams)
{
    return seams ? &seams->info : NULL;
}

void
osdtex_seams_destroy(osdtex_seams *seams)
{
    if (seams)
        otx_arena_destroy(seams->arena);
}
