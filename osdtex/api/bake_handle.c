/* bake_handle.c -- a mapping baked onto its cage. */
#include "api/call.h"
#include "api/handle.h"
#include "export/look.h"

#include <math.h>

static otx_layout_options
layout_options(const osdtex_bake_options *ours)
{
    return (otx_layout_options){
        .source = (otx_layout_source)ours->uvs,
        .side = ours->resolution,
        .margin = ours->margin,
        .texels_per_unit = ours->texels_per_unit,
    };
}

static otx_status
check(
    otx_run *run, const osdtex_mapping *mapping, const char *path,
    const osdtex_bake_options *ours, const osdtex_write_options *mesh)
{
    const uint32_t known = OSDTEX_BAKE_PATCH | OSDTEX_BAKE_UV |
                           OSDTEX_BAKE_STRETCH | OSDTEX_BAKE_SEAM |
                           OSDTEX_BAKE_SOURCE;

    if (!mapping || !path || ours->comment_count < 0 ||
        (ours->comment_count > 0 && !ours->comments) ||
        mesh->comment_count < 0 || (mesh->comment_count > 0 && !mesh->comments))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "no mapping, no path, or no comments are given");
    if (ours->uvs < OSDTEX_BAKE_UVS_AUTO || ours->uvs > OSDTEX_BAKE_UVS_ATLAS ||
        (ours->extras & ~known) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "there are no such UVs or extra outputs");
    if (!(ours->meters_per_unit >= 0.0 && isfinite(ours->meters_per_unit)) ||
        ours->up_axis < OSDTEX_UP_Y || ours->up_axis > OSDTEX_UP_Z)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "the scene has no such unit or axis that points up");
    if (!(ours->seam_blend >= 0.0 && isfinite(ours->seam_blend)))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "seams are blended over 0 or more texels, not %g",
            ours->seam_blend);
    return OSDTEX_OK;
}

static otx_status
bake(
    otx_call *call, const osdtex_mapping *mapping, const char *path,
    const osdtex_bake_options *options)
{
    osdtex_bake_options ours = osdtex_bake_options_default();
    osdtex_write_options mesh = osdtex_write_options_default();
    otx_look_options how = {.path = path};
    otx_layout_options place;
    otx_model_options model;
    otx_layout layout;

    OTX_TRY(otx_call_options(&call->run, &ours, sizeof ours, options));
    OTX_TRY(otx_call_options(&call->run, &mesh, sizeof mesh, ours.mesh));
    OTX_TRY(check(&call->run, mapping, path, &ours, &mesh));
    model = (otx_model_options){
        .without_image = mesh.without_image != 0,
        .normals = mesh.normals != 0,
        .comment_count = mesh.comment_count,
        .comments = mesh.comments};
    how.mesh = ours.mesh ? &model : NULL;
    place = layout_options(&ours);
    how.seam_blend = ours.seam_blend;
    how.udim = ours.udim;
    how.meters_per_unit = ours.meters_per_unit;
    how.normals = ours.normals != 0;
    how.z_up = ours.up_axis == OSDTEX_UP_Z;
    how.texture_comment = ours.texture_comment;
    how.comments = ours.comments;
    how.comment_count = ours.comment_count;
    how.extras[OTX_TEXEL_PATCH] = (ours.extras & OSDTEX_BAKE_PATCH) != 0;
    how.extras[OTX_TEXEL_UV] = (ours.extras & OSDTEX_BAKE_UV) != 0;
    how.extras[OTX_TEXEL_STRETCH] = (ours.extras & OSDTEX_BAKE_STRETCH) != 0;
    how.extras[OTX_TEXEL_SEAM] = (ours.extras & OSDTEX_BAKE_SEAM) != 0;
    how.extras[OTX_TEXEL_SOURCE] = (ours.extras & OSDTEX_BAKE_SOURCE) != 0;
    if (ours.preview_png)
        OTX_TRY(otx_call_colour(call, &how.colour));
    OTX_TRY(otx_layout_build(&call->run, &mapping->mapping, &place, &layout));
    return otx_look_write(
        &call->run, &mapping->mapping, mapping->exemplars, &layout, &how);
}

osdtex_status
osdtex_bake(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path,
    const osdtex_bake_options *options)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, "bake", &call));
    return otx_call_drop(&call, bake(&call, mapping, path, options));
}
