/* stretch_call.c -- how far each face's UVs are from what was asked. */
#include "api/call.h"
#include "api/handle.h"
#include "render/mapped_scene.h"

#include <string.h>

static const char STAGE[] = "stretch";

static otx_status
measure(otx_call *call, const osdtex_mapping *mapping, float *out)
{
    otx_scene scene;
    otx_run aside;

    if (!mapping || !out)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping or no array is given");
    OTX_TRY(otx_call_aside(call, &aside));
    OTX_TRY(otx_scene_from_mapping(
        &aside, &mapping->mapping, mapping->exemplars, &scene));
    memcpy(out, scene.face_stretch, (size_t)scene.face_count * sizeof(float));
    return OSDTEX_OK;
}

osdtex_status
osdtex_mapping_stretch(
    osdtex_context *context, const osdtex_mapping *mapping, float *out)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, measure(&call, mapping, out));
}
