/* cage_model.c -- a cage to what the writers of file/ take. */
#include "export/cage_model.h"

#include "export/names.h"

#include <string.h>

otx_fvar
otx_cage_model_fvar(const otx_layout *layout)
{
    return layout->is_atlas ? OTX_FVAR_ALL : layout->surface->cage->fvar;
}

double
otx_cage_model_meters(otx_receiver receiver)
{
    return receiver == OTX_RECEIVER_BLENDER || receiver == OTX_RECEIVER_HOUDINI
               ? 1.0
               : 0.01;
}

const char *
otx_cage_model_fvar_name(otx_fvar fvar)
{
    static const char *const names[] = {"none",         "cornersOnly",
                                        "cornersPlus1", "cornersPlus2",
                                        "boundaries",   "all"};

    return names[fvar];
}

/* The tag counts otherwise than the enum: see docs/formats.md. */
static int32_t
boundary_tag(otx_boundary boundary)
{
    return boundary == OTX_BOUNDARY_NONE              ? 0
           : boundary == OTX_BOUNDARY_EDGE_AND_CORNER ? 1
                                                      : 2;
}

static otx_status
list_holes(otx_run *run, const otx_cage *cage, otx_obj *out)
{
    int32_t *holes = OTX_NEW(run->scratch, int32_t, cage->face_count);

    OTX_TRY(otx_run_ok(run));
    out->hole_count = 0;
    for (int32_t f = 0; f < cage->face_count; ++f)
        if (cage->face_hole[f])
            holes[out->hole_count++] = f;
    out->hole_faces = holes;
    return OSDTEX_OK;
}

otx_status
otx_cage_model_materials(
    otx_run *run, const otx_cage *cage, const int32_t *parents, int32_t faces,
    const char *fallback, otx_obj *out)
{
    const int32_t count = cage->face_material ? cage->material_count : 0;
    const char **names = OTX_NEW(run->scratch, const char *, count + 1);
    int32_t *indices = OTX_NEW(run->scratch, int32_t, faces);
    int32_t used = count;
    int32_t spare = otx_names_find(cage->material_names, count, fallback);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count; ++i)
        names[i] = cage->material_names[i];
    for (int32_t f = 0; f < faces; ++f)
    {
        indices[f] =
            count > 0 ? cage->face_material[parents ? parents[f] : f] : -1;
        if (indices[f] >= 0)
            continue;
        if (spare < 0)
        {
            spare = used;
            names[used++] = fallback;
        }
        indices[f] = spare;
    }
    out->materials = (otx_obj_names){used, names};
    out->face_material = indices;
    return OSDTEX_OK;
}

static void
set_names(const otx_cage *cage, otx_obj *out)
{
    out->groups = (otx_obj_names){cage->group_count, cage->group_names};
    out->face_group = cage->face_group;
    out->objects = (otx_obj_names){cage->object_count, cage->object_names};
    out->face_object = cage->face_object;
    out->smooths = (otx_obj_names){cage->smooth_count, cage->smooth_names};
    out->face_smooth = cage->face_smooth;
}

otx_status
otx_cage_model_tags(
    otx_run *run, const otx_cage *cage, otx_fvar fvar, otx_obj *out)
{
    out->creases = (otx_obj_creases){
        cage->crease_count, cage->crease_verts, cage->crease_sharpness, NULL};
    out->corners = (otx_obj_creases){
        cage->corner_tag_count, cage->corner_tag_verts,
        cage->corner_tag_sharpness, NULL};
    out->boundary = (otx_obj_rule){boundary_tag(cage->boundary), 0};
    out->fvar = (otx_obj_rule){(int32_t)fvar, 0};
    out->crease_method = (otx_obj_rule){
        cage->crease_chaikin ? OTX_OBJ_CREASE_CHAIKIN : OTX_OBJ_CREASE_NORMAL,
        0};
    out->triangles = (otx_obj_rule){
        cage->triangles_smooth ? OTX_OBJ_TRIANGLES_SMOOTH
                               : OTX_OBJ_TRIANGLES_CATMARK,
        0};
    return list_holes(run, cage, out);
}

otx_status
otx_cage_model_obj(
    otx_run *run, const otx_layout *layout, const char *path,
    const char *library, const char *fallback, otx_obj *out)
{
    const otx_cage *cage = layout->surface->cage;
    const char **libraries = OTX_NEW(run->scratch, const char *, 1);

    OTX_TRY(otx_run_ok(run));
    *libraries = library;
    *out = (otx_obj){
        .path = path,
        .vert_count = cage->vert_count,
        .uv_count = layout->uv_count,
        .face_count = cage->face_count,
        .corner_count = cage->corner_count,
        .points = cage->points,
        .colors = cage->colors,
        .point_lines = cage->point_lines,
        .point_line_bytes = cage->point_line_bytes,
        .uvs = layout->uvs,
        .face_first = cage->face_first,
        .face_verts = cage->face_verts,
        .face_uvs = layout->face_uvs,
        .libraries = {1, libraries},
    };
    memcpy(out->origin, cage->origin, sizeof out->origin);
    set_names(cage, out);
    OTX_TRY(otx_cage_model_tags(run, cage, otx_cage_model_fvar(layout), out));
    return otx_cage_model_materials(
        run, cage, NULL, cage->face_count, fallback, out);
}

static const char *
scheme_name(otx_scheme scheme)
{
    static const char *const names[] = {
        "catmullClark", "loop", "bilinear", "none"};

    return names[scheme];
}

static const char *
boundary_name(otx_boundary boundary)
{
    static const char *const names[] = {"none", "edgeOnly", "edgeAndCorner"};

    return names[boundary];
}

void
otx_cage_model_usda(const otx_layout *layout, const char *name, otx_usda *out)
{
    const otx_cage *cage = layout->surface->cage;

    *out = (otx_usda){
        .name = name,
        .scheme = scheme_name(cage->scheme),
        .boundary = boundary_name(cage->boundary),
        .fvar = otx_cage_model_fvar_name(otx_cage_model_fvar(layout)),
        .triangles = cage->triangles_smooth ? "smooth" : "catmullClark",
        .vert_count = cage->vert_count,
        .face_count = cage->face_count,
        .corner_count = cage->corner_count,
        .uv_count = layout->uv_count,
        .points = cage->points,
        .face_first = cage->face_first,
        .face_verts = cage->face_verts,
        .uvs = layout->uvs,
        .face_uvs = layout->face_uvs,
        .crease_count = cage->crease_count,
        .crease_verts = cage->crease_verts,
        .crease_sharpness = cage->crease_sharpness,
        .corner_tag_count = cage->corner_tag_count,
        .corner_tag_verts = cage->corner_tag_verts,
        .corner_tag_sharpness = cage->corner_tag_sharpness,
        .face_hole = cage->face_hole,
        .groups = {cage->group_count, cage->group_names, cage->face_group},
    };
    memcpy(out->origin, cage->origin, sizeof out->origin);
}
