/* paste_model.c -- a mapping of pastes as a run-time list. */
#include "export/paste_model.h"

#include "export/baked_texture.h"
#include "export/cage_model.h"
#include "export/companion_files.h"
#include "export/corner_normals.h"
#include "export/paste_atlas.h"
#include "export/texture_file.h"
#include "export/uv_pool.h"
#include "file/exr.h"
#include "file/mtl.h"
#include "file/obj_write.h"
#include "file/usda.h"
#include "mapping/source.h"

#include <stdio.h>
#include <string.h>

static const char STAGE[] = "export";

/* All that is written, made in run->scratch. */
typedef struct paste_model
{
    otx_run *run;
    const otx_model_options *options;
    const otx_names *names;
    const otx_exemplar *exemplar;
    otx_paste_list list;
    otx_paste_atlas atlas;
    const char *picture, *picture_name; /* of the pastes: path, name */
    const char *usda;                   /* path */
    const char *materials[2];
    const char **layers;  /* [layer_count] names */
    int32_t *face_layer;  /* [faces] */
    int32_t *face_second; /* [faces] 0 the exemplar, 1 the pastes */
    otx_obj obj;
} paste_model;

/* Who cannot be told as layers of one exemplar. */
static otx_status
check(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const char *path)
{
    const char *why = NULL;

    if (!mapping->lookups || mapping->lookups->layering != OTX_LAYERING_OVER)
        why = "only a mapping of pastes over one another (method lapped) is "
              "written as a list of them";
    else if (mapping->decals)
        why = "pictures that are placed are baked, not written as pastes";
    else if (mapping->field || mapping->along)
        why = "what is healed is baked, not written as pastes";
    else if (otx_source_count(mapping) > 1)
        why = "pastes of several exemplars are baked, not written as a list";
    else if (exemplar->type == OTX_TEXTURE_JPEG)
        why = "JPEG has no alpha to cut pastes out by; write PNG, TIFF or EXR";
    return why ? otx_fail(
                     run, OSDTEX_ERROR_SUPPORT, STAGE, otx_where_file(path),
                     "%s", why)
               : OSDTEX_OK;
}

/* ---- names ---- */

/* "FOLDER/NAME.mtl" with another end. */
static const char *
beside(otx_run *run, const char *mtl, const char *suffix)
{
    const size_t base = strlen(mtl) - 4;
    const size_t bytes = base + strlen(suffix) + 1;
    char *out = OTX_NEW(run->scratch, char, bytes);

    if (out)
        snprintf(out, bytes, "%.*s%s", (int)base, mtl, suffix);
    return out;
}

static otx_status
name_all(paste_model *m)
{
    const char *end = otx_texture_file_extension(m->exemplar);
    char suffix[32];

    snprintf(suffix, sizeof suffix, "_pastes%s", end);
    m->picture = beside(m->run, m->names->mtl, suffix);
    m->picture_name = beside(m->run, m->names->mtl_name, suffix);
    m->usda = beside(m->run, m->names->mtl, ".usda");
    m->materials[0] = m->names->stem;
    m->materials[1] = beside(m->run, m->names->mtl_name, "_pastes");
    m->layers = OTX_NEW(m->run->scratch, const char *, m->list.layer_count);
    OTX_TRY(otx_run_ok(m->run));
    for (int32_t i = 0; i < m->list.layer_count; ++i)
    {
        char *name = OTX_NEW(m->run->scratch, char, 32);

        OTX_TRY(otx_run_ok(m->run));
        snprintf(name, 32, "layer_%d", (int)i);
        m->layers[i] = name;
    }
    return OSDTEX_OK;
}

/* ---- the mesh ---- */

static void
corner_uv(
    const paste_model *m, const otx_paste_face *face, int32_t k, float uv[2])
{
    const otx_mapping *mapping = m->list.mapping;
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    if (face->cell >= 0)
    {
        const otx_vec2 at = otx_paste_atlas_uv(&m->atlas, face, k);

        uv[0] = (float)at.x;
        uv[1] = (float)at.y;
        return;
    }
    memcpy(
        uv,
        face->lookup
            ? face->lookup[k].uv
            : mapping->uvs + 2 * (size_t)(leaf->face_first[face->face] + k),
        2 * sizeof *uv);
}

/* Faces of all layers one after the other. */
static otx_status
gather(
    paste_model *m, int32_t *first, int32_t *verts, int32_t *corners,
    float *uvs)
{
    const otx_level *leaf = otx_surface_leaf(m->list.mapping->surface);
    const int32_t count = m->list.layer_first[m->list.layer_count];
    int32_t layer = 0, at = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_paste_face *face = &m->list.faces[i];
        const int32_t from = leaf->face_first[face->face];

        while (i >= m->list.layer_first[layer + 1])
            ++layer;
        m->face_layer[i] = layer;
        m->face_second[i] = face->cell >= 0;
        first[i] = at;
        for (int32_t k = 0; k < otx_level_face_size(leaf, face->face); ++k)
        {
            verts[at] = leaf->face_verts[from + k];
            corners[at] = from + k;
            corner_uv(m, face, k, uvs + 2 * (size_t)at++);
        }
    }
    first[count] = at;
    return OSDTEX_OK;
}

static otx_status
add_normals(paste_model *m, const int32_t *corners)
{
    int32_t *indices = OTX_NEW(m->run->scratch, int32_t, m->list.corner_count);
    otx_corner_normals all;

    OTX_TRY(otx_corner_normals_build(m->run, m->list.mapping->surface, &all));
    OTX_TRY(otx_run_ok(m->run));
    for (int32_t c = 0; c < m->list.corner_count; ++c)
        indices[c] = all.indices[corners[c]];
    m->obj.normal_count = all.count;
    m->obj.normals = all.normals;
    m->obj.face_normals = indices;
    return OSDTEX_OK;
}

static void
describe(
    paste_model *m, const int32_t *first, const int32_t *verts,
    const otx_uv_pool *pool)
{
    const otx_surface *surface = m->list.mapping->surface;
    const char **library = OTX_NEW(m->run->scratch, const char *, 1);

    if (library)
        *library = m->names->mtl_name;
    m->obj = (otx_obj){
        .path = m->names->obj,
        .vert_count = otx_surface_leaf(surface)->vert_count,
        .points = surface->points,
        .uv_count = pool->count,
        .face_count = m->list.layer_first[m->list.layer_count],
        .corner_count = m->list.corner_count,
        .uvs = pool->uvs,
        .face_first = first,
        .face_verts = verts,
        .face_uvs = pool->indices,
        .face_group = m->face_layer,
        .groups = {m->list.layer_count, m->layers},
        .face_material = m->face_second,
        .materials = {2, m->materials},
        .libraries = {1, library},
        .boundary = OTX_OBJ_NO_RULE,
        .fvar = OTX_OBJ_NO_RULE,
        .crease_method = OTX_OBJ_NO_RULE,
        .triangles = OTX_OBJ_NO_RULE};
    memcpy(m->obj.origin, surface->cage->origin, sizeof m->obj.origin);
}

static otx_status
make_mesh(paste_model *m)
{
    otx_arena *scratch = m->run->scratch;
    const int32_t faces = m->list.layer_first[m->list.layer_count];
    const int32_t count = m->list.corner_count;
    int32_t *first = OTX_NEW(scratch, int32_t, (size_t)faces + 1);
    int32_t *verts = OTX_NEW(scratch, int32_t, count);
    int32_t *corners = OTX_NEW(scratch, int32_t, count);
    float *uvs = OTX_NEW(scratch, float, 2 * (size_t)count);
    otx_uv_pool pool;

    m->face_layer = OTX_NEW(scratch, int32_t, faces);
    m->face_second = OTX_NEW(scratch, int32_t, faces);
    OTX_TRY(otx_run_ok(m->run));
    OTX_TRY(gather(m, first, verts, corners, uvs));
    OTX_TRY(otx_uv_pool_build(m->run, scratch, count, verts, uvs, &pool));
    describe(m, first, verts, &pool);
    return m->options->normals ? add_normals(m, corners) : otx_run_ok(m->run);
}

/* ---- files ---- */

static otx_status
write_pastes(paste_model *m)
{
    otx_atomic_file_set *set = m->options->set;
    const otx_exemplar *e = m->exemplar;
    otx_exr_options options = otx_exr_options_default();
    otx_pyramid levels;

    OTX_TRY(otx_paste_atlas_fill(m->run, &m->atlas, &levels));
    if (e->type > OTX_TEXTURE_EXR)
        return otx_texture_file_write_integers(
            m->run, set, m->picture, e, &levels.levels[0]);
    options.has_chromaticities = e->has_chromaticities;
    memcpy(
        options.chromaticities, e->chromaticities,
        sizeof options.chromaticities);
    options.color_space = e->linear_space;
    options.interop_id = e->interop_id;
    options.levels = levels.levels + 1;
    options.level_count = levels.count - 1;
    return otx_exr_write(m->run, set, m->picture, &levels.levels[0], &options);
}

/* On the pieces of the exemplar a scene unit has as many texels as on it. */
static otx_status
write_maps(paste_model *m)
{
    const otx_exemplar *e = m->exemplar;
    const double width = otx_source_unit(m->list.mapping, e, 0).x;
    otx_exemplar pieces = *e;

    OTX_TRY(otx_companion_files_write(
        m->run, m->options->set, m->names->textures[0], e, width));
    if (!e->companions.image.pixels)
        return OSDTEX_OK;
    OTX_TRY(otx_paste_atlas_maps(m->run, &m->atlas, &pieces.companions));
    pieces.companions.height_range =
        otx_companions_scale(&e->companions, width).range;
    pieces.wrap_x = pieces.wrap_y = false;
    pieces.tiles.cell = 0;
    return otx_companion_files_write(
        m->run, m->options->set, m->picture, &pieces, width);
}

static otx_status
write_textures(paste_model *m)
{
    const otx_exemplar *e = m->exemplar;

    OTX_TRY(otx_texture_file_write(
        m->run, m->options->set, m->names->textures[0], e, &e->linear,
        &e->tiles));
    OTX_TRY(write_pastes(m));
    return write_maps(m);
}

static otx_status
write_mtl(paste_model *m)
{
    const otx_exemplar *e = m->exemplar;
    otx_mtl_material list[2] = {
        {.name = m->materials[0], .map_kd = m->names->texture_names[0]},
        {.name = m->materials[1],
         .map_kd = m->picture_name,
         .map_d = m->picture_name}};
    const otx_mtl mtl = {m->names->mtl, 2, list};
    const char *temporary;

    for (int i = 0; i < 2; ++i)
    {
        for (int k = 0; k < 3; ++k)
            list[i].diffuse[k] = 1.0f;
        list[i].maps = otx_companion_files_names(
            m->run, list[i].map_kd, e->type, &e->companions);
    }
    OTX_TRY(otx_run_ok(m->run));
    OTX_TRY(otx_atomic_file_add(
        m->run, m->options->set, m->names->mtl, &temporary));
    return otx_mtl_write(m->run, &mtl, temporary, m->names->mtl);
}

static otx_status
write_usda(paste_model *m)
{
    const otx_obj *obj = &m->obj;
    const otx_usda usda = {
        .name = m->names->stem,
        .scheme = "none",
        .boundary = "edgeAndCorner",
        .fvar = "all",
        .triangles = "catmullClark",
        .vert_count = obj->vert_count,
        .face_count = obj->face_count,
        .corner_count = obj->corner_count,
        .uv_count = obj->uv_count,
        .points = obj->points,
        .origin = {obj->origin[0], obj->origin[1], obj->origin[2]},
        .face_first = obj->face_first,
        .face_verts = obj->face_verts,
        .normals = obj->normals,
        .face_normals = obj->face_normals,
        .uvs = obj->uvs,
        .face_uvs = obj->face_uvs,
        .materials = {m->list.layer_count, m->layers, m->face_layer},
        .overlay = m->picture_name,
        .meters_per_unit = otx_cage_model_meters(m->exemplar->receiver),
        .texture = m->names->texture_names[0],
        .interop_id = otx_texture_file_interop_id(m->exemplar),
        .maps = otx_companion_files_names(
            m->run, m->names->texture_names[0], m->exemplar->type,
            &m->exemplar->companions),
        .overlay_maps = otx_companion_files_names(
            m->run, m->picture_name, m->exemplar->type,
            &m->exemplar->companions),
        .comments = m->options->comments,
        .comment_count = m->options->comment_count};
    const char *temporary;

    OTX_TRY(otx_run_ok(m->run));
    OTX_TRY(otx_atomic_file_add(m->run, m->options->set, m->usda, &temporary));
    return otx_usda_write(m->run, &usda, temporary, m->usda);
}

static otx_status
write_obj(paste_model *m)
{
    const otx_obj_write_options how = {
        .name = m->names->obj,
        .comments = m->options->comments,
        .comment_count = m->options->comment_count};
    const char *temporary;

    OTX_TRY(otx_atomic_file_add(
        m->run, m->options->set, m->names->obj, &temporary));
    return otx_obj_write(m->run, &m->obj, temporary, &how);
}

/* What the textures take, beside what that of a bake would. */
static void
say_size(const paste_model *m)
{
    const otx_exemplar *e = m->exemplar;
    const double list = (double)e->linear.width * e->linear.height * 3.0 +
                        (double)m->atlas.width * m->atlas.height * 4.0;
    const double side = m->options->resolution
                            ? m->options->resolution
                            : otx_baked_texture_side(m->list.mapping, e);

    otx_note(
        m->run, OSDTEX_SEVERITY_INFO, STAGE, otx_where_file(m->names->obj),
        "%d layers of pastes, %d pictures in %d x %d texels: textures take "
        "%.1f MiB of half floats, that of a bake %.1f MiB",
        (int)m->list.layer_count, (int)m->list.cell_count, (int)m->atlas.width,
        (int)m->atlas.height, 2.0 * list / 0x1p20, 6.0 * side * side / 0x1p20);
}

otx_status
otx_paste_model_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const otx_model_options *options, const otx_names *names, int32_t *uv_count)
{
    paste_model m = {
        .run = run, .options = options, .names = names, .exemplar = exemplar};

    OTX_TRY(check(run, mapping, exemplar, names->obj));
    OTX_TRY(otx_paste_list_make(run, mapping, exemplar, &m.list));
    OTX_TRY(otx_paste_atlas_pack(run, &m.list, &m.atlas));
    OTX_TRY(name_all(&m));
    OTX_TRY(make_mesh(&m));
    *uv_count = m.obj.uv_count;
    say_size(&m);
    if (!options->without_image)
        OTX_TRY(write_textures(&m));
    OTX_TRY(write_mtl(&m));
    OTX_TRY(write_usda(&m));
    return write_obj(&m);
}
