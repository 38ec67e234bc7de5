/* render_handle.c -- a picture of a model. */
#include "api/call.h"
#include "api/cell_view.h"
#include "api/contact_sheet.h"
#include "api/field_view.h"
#include "api/handle.h"
#include "api/image_handle.h"
#include "heal/window_map.h"
#include "render/displace.h"
#include "render/render.h"
#include "render/worst_seam.h"
#include "word/near.h"

#include <string.h>

static const char *
show_name(const void *list, int32_t index)
{
    (void)list;
    return index < OTX_SHOW_COUNT    ? otx_render_show_name((otx_show)index)
           : index == OTX_SHOW_COUNT ? OTX_CONTACT_SHEET
                                     : NULL;
}

static const char *
view_name(const void *list, int32_t index)
{
    (void)list;
    return index < OTX_VIEW_COUNT ? otx_camera_view_name((otx_view)index)
                                  : NULL;
}

static otx_status
no_such(otx_run *run, const char *what, const char *name, otx_near_name names)
{
    char near_names[256];

    otx_near_text(name, names, NULL, near_names);
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "render", OTX_NOWHERE,
        "there is no %s '%.60s'%s", what, name, near_names);
}

/* A place of the scene, as the model's points are kept. */
static otx_vec3
place_of(const osdtex_model *model, const double place[3])
{
    return (otx_vec3){
        place[0] - model->origin[0], place[1] - model->origin[1],
        place[2] - model->origin[2]};
}

static otx_status
options_of(
    otx_run *run, const osdtex_model *model, const osdtex_render_options *ours,
    otx_camera *camera, otx_render_options *out)
{
    const int32_t seam = ours->view ? otx_worst_seam_rank(ours->view) : 0;

    *out = otx_render_defaults();
    out->width = ours->width;
    out->height = ours->height;
    out->samples = ours->samples;
    out->unlit = ours->unlit != 0;
    out->transparent = ours->transparent != 0;
    out->plain = ours->plain != 0;
    out->no_shadows = ours->no_shadows != 0;
    out->turn = ours->turn;
    out->up = ours->up_axis ? OTX_UP_Z : OTX_UP_Y;
    out->orbit = ours->orbit != 0;
    out->wire = ours->wire != 0;
    out->uv_lines = ours->uv_lines != 0;
    if (ours->show && !otx_render_show_find(ours->show, &out->show))
        return no_such(run, "picture to show", ours->show, show_name);
    if (seam == 0 && ours->view &&
        !otx_camera_view_find(ours->view, &out->view))
        return no_such(run, "view", ours->view, view_name);
    if (seam > 0 && ours->fov == 0.0)
    {
        OTX_TRY(otx_worst_seam_camera(
            run, &model->scene, seam, model->origin, camera));
        camera->up = out->up;
        out->camera = camera;
    }
    if (ours->fov == 0.0)
        return OSDTEX_OK;
    *camera = (otx_camera){
        place_of(model, ours->eye), place_of(model, ours->target), ours->fov,
        0.0, out->up};
    out->camera = camera;
    return OSDTEX_OK;
}

static otx_status
find_windows(otx_run *run, const osdtex_model *model, const float **out)
{
    otx_window_map map;

    if (!model->mapping)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "render", OTX_NOWHERE,
            "windows are those of a mapping, and this model has none: a "
            "mapping "
            "that is saved by {save} and read by {from} has one");
    if (!model->mapping->exemplars[0].lab.pixels)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "render", OTX_NOWHERE,
            "windows are not known of a mapping that is read without figures");
    OTX_TRY(otx_window_map_make(
        run, &model->mapping->mapping, model->mapping->exemplars, &map));
    *out = map.faces;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, "render", OTX_NOWHERE,
        "windows of 56 texels at an eighth of the resolution are %.3f times as "
        "far from the exemplar as its own are from the rest of it, %.0f %% of "
        "them farther (white is 1, blue nearer, red farther, grey not judged)",
        map.mean, 100.0 * map.share_above);
    return OSDTEX_OK;
}

/* One picture, options complete. */
static otx_status
draw(
    otx_run *run, const osdtex_model *model, const osdtex_render_options *ours,
    otx_image *out)
{
    otx_render_options how;
    otx_overlay overlay;
    otx_camera camera;
    otx_scene scene;

    OTX_TRY(options_of(run, model, ours, &camera, &how));
    if (model->guide &&
        (how.show == OTX_SHOW_FIELD || how.show == OTX_SHOW_SINGULARITIES))
    {
        OTX_TRY(otx_field_view(
            run, model->surface, model->guide, how.show == OTX_SHOW_FIELD,
            &overlay));
        how.overlay = &overlay;
    }
    if (model->lattice && how.show == OTX_SHOW_CELLS)
    {
        OTX_TRY(otx_cell_view(run, model->surface, model->lattice, &overlay));
        how.overlay = &overlay;
    }
    scene = model->scene;
    if (ours->displace)
        OTX_TRY(otx_scene_displace(run, &model->scene, &scene));
    if (how.show == OTX_SHOW_WINDOWS)
        OTX_TRY(find_windows(run, model, &scene.face_windows));
    return otx_render(run, &scene, &how, out);
}

static otx_status
render(
    otx_run *run, const osdtex_model *model,
    const osdtex_render_options *options, osdtex_image **out)
{
    osdtex_render_options ours = osdtex_render_options_default();
    otx_image image;

    if (!model)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "render", OTX_NOWHERE,
            "no model is given");
    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    if (ours.show && strcmp(ours.show, OTX_CONTACT_SHEET) == 0)
        OTX_TRY(otx_contact_sheet_make(run, model, &ours, draw, &image));
    else
        OTX_TRY(draw(run, model, &ours, &image));
    return otx_image_handle_wrap(run, image, out);
}

osdtex_status
osdtex_render(
    osdtex_context *context, const osdtex_model *model,
    const osdtex_render_options *options, osdtex_image **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "render", &call));
    return otx_call_end(&call, render(&call.run, model, options, out), out);
}
