/* bake_handle.c -- a mapping baked onto its cage. */
#include "api/bake_handle.h"
#include "api/call.h"
#include "api/handle.h"
#include "api/mapping_handle.h"
#include "export/look.h"

#include <math.h>

otx_layout_options
otx_bake_handle_layout(const osdtex_bake_options *options)
{
    return (otx_layout_options){
        .source = (otx_layout_source)options->uvs,
        .side = options->resolution,
        .margin = options->margin,
        .texels_per_unit = options->texels_per_unit,
    };
}

bool
otx_bake_handle_has(const osdtex_bake_options *options, otx_texel_kind kind)
{
    static const uint32_t bits[OTX_TEXEL_KIND_COUNT] = {
        [OTX_TEXEL_PATCH] = OSDTEX_BAKE_PATCH,
        [OTX_TEXEL_UV] = OSDTEX_BAKE_UV,
        [OTX_TEXEL_STRETCH] = OSDTEX_BAKE_STRETCH,
        [OTX_TEXEL_SEAM] = OSDTEX_BAKE_SEAM,
        [OTX_TEXEL_SOURCE] = OSDTEX_BAKE_SOURCE,
        [OTX_TEXEL_SLICE] = OSDTEX_BAKE_SLICE};

    return kind == OTX_TEXEL_COLOR || (options->extras & bits[kind]) != 0;
}

otx_status
otx_bake_handle_options(
    otx_run *run, const osdtex_bake_options *theirs, osdtex_bake_options *out)
{
    const uint32_t known = OSDTEX_BAKE_PATCH | OSDTEX_BAKE_UV |
                           OSDTEX_BAKE_STRETCH | OSDTEX_BAKE_SEAM |
                           OSDTEX_BAKE_SOURCE | OSDTEX_BAKE_SLICE;

    *out = osdtex_bake_options_default();
    OTX_TRY(otx_call_options(run, out, sizeof *out, theirs));
    if (out->uvs < OSDTEX_BAKE_UVS_AUTO || out->uvs > OSDTEX_BAKE_UVS_CHARTS ||
        (out->extras & ~known) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "there are no such UVs or extra outputs");
    if (!(out->seam_blend >= 0.0 && isfinite(out->seam_blend)))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "seams are blended over 0 or more texels, not %g", out->seam_blend);
    return OSDTEX_OK;
}

/* What only files have. */
static otx_status
check_files(
    otx_run *run, const char *path, const osdtex_bake_options *ours,
    const osdtex_write_options *mesh)
{
    if (!path || ours->comment_count < 0 ||
        (ours->comment_count > 0 && !ours->comments) ||
        mesh->comment_count < 0 || (mesh->comment_count > 0 && !mesh->comments))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "no path or no comments are given");
    if (mesh->pastes)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "a bake has the pastes in its textures: a list of them is written "
            "by itself");
    if (!(ours->meters_per_unit >= 0.0 && isfinite(ours->meters_per_unit)) ||
        ours->up_axis < OSDTEX_UP_Y || ours->up_axis > OSDTEX_UP_Z)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "the scene has no such unit or axis that points up");
    return OSDTEX_OK;
}

static otx_look_options
look_options(const osdtex_bake_options *ours, const char *path)
{
    otx_look_options how = {
        .path = path,
        .seam_blend = ours->seam_blend,
        .udim = ours->udim,
        .meters_per_unit = ours->meters_per_unit,
        .normals = ours->normals != 0,
        .z_up = ours->up_axis == OSDTEX_UP_Z,
        .texture_comment = ours->texture_comment,
        .comments = ours->comments,
        .comment_count = ours->comment_count,
    };

    for (int kind = 0; kind < OTX_TEXEL_KIND_COUNT; ++kind)
        how.extras[kind] = otx_bake_handle_has(ours, (otx_texel_kind)kind);
    return how;
}

static otx_status
bake(
    otx_call *call, const osdtex_mapping *mapping, const char *path,
    const osdtex_bake_options *options)
{
    osdtex_write_options mesh = osdtex_write_options_default();
    osdtex_bake_options ours;
    otx_look_options how;
    otx_layout_options place;
    otx_model_options model;
    otx_layout layout;

    if (!mapping)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, "bake", OTX_NOWHERE,
            "no mapping is given");
    OTX_TRY(otx_bake_handle_options(&call->run, options, &ours));
    OTX_TRY(otx_call_options(&call->run, &mesh, sizeof mesh, ours.mesh));
    OTX_TRY(check_files(&call->run, path, &ours, &mesh));
    model = otx_mapping_handle_model_options(&mesh);
    how = look_options(&ours, path);
    how.mesh = ours.mesh ? &model : NULL;
    how.rest = mapping->made_for;
    if (ours.preview_png)
        OTX_TRY(otx_call_colour(call, &how.colour));
    place = otx_bake_handle_layout(&ours);
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
