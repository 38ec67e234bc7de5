/* model.c -- from a mapping to what the writers of file/ take. */
#include "export/model.h"

#include "export/names.h"
#include "export/texture_file.h"
#include "export/uv_pool.h"
#include "file/mtl.h"
#include "file/obj_write.h"

#include <string.h>

static const char STAGE[] = "export";

/* The leaf faces that are written, as arrays of their own. */
typedef struct leaf_faces
{
    int32_t count, corner_count;
    int32_t *first;   /* [count + 1] */
    int32_t *verts;   /* [corner_count] */
    float *uvs;       /* [corner_count * 2] */
    int32_t *parents; /* [count], cage face */
} leaf_faces;

static otx_status
allocate_faces(otx_run *run, const otx_level *leaf, leaf_faces *out)
{
    const size_t corners = (size_t)leaf->corner_count;

    *out = (leaf_faces){
        .first = OTX_NEW(run->scratch, int32_t, (size_t)leaf->face_count + 1),
        .verts = OTX_NEW(run->scratch, int32_t, corners),
        .uvs = OTX_NEW(run->scratch, float, corners * 2),
        .parents = OTX_NEW(run->scratch, int32_t, leaf->face_count),
    };
    if (!out->first || !out->verts || !out->uvs || !out->parents)
        return otx_fail_memory(run, STAGE);
    out->first[0] = 0;
    return OSDTEX_OK;
}

/* A plain mesh may have been severed where it is no manifold: it is written
 * with the vertices that it came with. */
static const int32_t *
written_verts(const otx_surface *surface)
{
    return surface->cage->scheme == OTX_SCHEME_NONE
               ? surface->cage->face_verts
               : otx_surface_leaf(surface)->face_verts;
}

/* Leaf faces in their order, which is that of the cage's; without holes. */
static otx_status
gather_faces(otx_run *run, const otx_mapping *mapping, leaf_faces *out)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const int32_t *verts = written_verts(mapping->surface);

    OTX_TRY(allocate_faces(run, leaf, out));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const size_t from = (size_t)leaf->face_first[f];
        const size_t size = (size_t)otx_level_face_size(leaf, f);
        const size_t to = (size_t)out->corner_count;

        if (leaf->face_hole && leaf->face_hole[f])
            continue;
        memcpy(out->verts + to, verts + from, size * sizeof *out->verts);
        memcpy(
            out->uvs + 2 * to, mapping->uvs + 2 * from,
            2 * size * sizeof *out->uvs);
        out->corner_count += (int32_t)size;
        out->parents[out->count++] = leaf->face_cage[f];
        out->first[out->count] = out->corner_count;
    }
    return OSDTEX_OK;
}

/* A name table of the cage for the writer, carried to the written faces: NULL
 * where the cage does not have it. */
static otx_status
carry_names(
    otx_run *run, const leaf_faces *faces, const int32_t *cage_faces,
    int32_t count, const char *const *text, otx_obj_names *names,
    const int32_t **indices)
{
    int32_t *carried;

    *names = (otx_obj_names){0, NULL};
    *indices = NULL;
    if (!cage_faces || count == 0)
        return OSDTEX_OK;
    carried = OTX_NEW(run->scratch, int32_t, faces->count);
    if (!carried)
        return otx_fail_memory(run, STAGE);
    for (int32_t f = 0; f < faces->count; ++f)
        carried[f] = cage_faces[faces->parents[f]];
    *names = (otx_obj_names){count, text};
    *indices = carried;
    return OSDTEX_OK;
}

static int32_t
find_name(const char *const *names, int32_t count, const char *name)
{
    for (int32_t i = 0; i < count; ++i)
        if (strcmp(names[i], name) == 0)
            return i;
    return -1;
}

/* Every face gets a material, since one without would show no texture: those
 * that the cage gave none get the one called `fallback`. */
static otx_status
carry_materials(
    otx_run *run, const otx_cage *cage, const leaf_faces *faces,
    const char *fallback, otx_obj *obj)
{
    const int32_t count = cage->face_material ? cage->material_count : 0;
    const char **names = OTX_NEW(run->scratch, const char *, count + 1);
    int32_t *indices = OTX_NEW(run->scratch, int32_t, faces->count);
    int32_t used = count;
    int32_t spare = find_name(cage->material_names, count, fallback);

    if (!names || !indices)
        return otx_fail_memory(run, STAGE);
    if (count > 0)
        memcpy(names, cage->material_names, (size_t)count * sizeof *names);
    for (int32_t f = 0; f < faces->count; ++f)
    {
        indices[f] = count > 0 ? cage->face_material[faces->parents[f]] : -1;
        if (indices[f] >= 0)
            continue;
        if (spare < 0)
        {
            spare = used;
            names[used++] = fallback;
        }
        indices[f] = spare;
    }
    obj->materials = (otx_obj_names){used, names};
    obj->face_material = indices;
    return OSDTEX_OK;
}

static void
set_points(const otx_surface *surface, otx_obj *out)
{
    const otx_cage *cage = surface->cage;

    out->vert_count = otx_surface_leaf(surface)->vert_count;
    out->points = surface->points;
    if (cage->scheme != OTX_SCHEME_NONE)
        return;
    out->vert_count = cage->vert_count;
    out->points = cage->points;
    out->colors = cage->colors;
    out->point_lines = cage->point_lines;
    out->point_line_bytes = cage->point_line_bytes;
}

static otx_status
describe_obj(
    otx_run *run, const otx_mapping *mapping, const otx_names *names,
    otx_obj *out)
{
    const otx_cage *cage = mapping->surface->cage;
    const char **library = OTX_NEW(run->scratch, const char *, 1);
    leaf_faces faces;
    otx_uv_pool pool;

    if (!library)
        return otx_fail_memory(run, STAGE);
    *library = names->mtl_name;
    OTX_TRY(gather_faces(run, mapping, &faces));
    OTX_TRY(otx_uv_pool_build(
        run, run->scratch, faces.corner_count, faces.verts, faces.uvs, &pool));
    *out = (otx_obj){
        .path = names->obj,
        .uv_count = pool.count,
        .face_count = faces.count,
        .corner_count = faces.corner_count,
        .uvs = pool.uvs,
        .face_first = faces.first,
        .face_verts = faces.verts,
        .face_uvs = pool.indices,
        .libraries = {1, library},
        .boundary = OTX_OBJ_NO_RULE,
        .fvar = OTX_OBJ_NO_RULE,
        .crease_method = OTX_OBJ_NO_RULE,
        .triangles = OTX_OBJ_NO_RULE,
    };
    set_points(mapping->surface, out);
    OTX_TRY(carry_names(
        run, &faces, cage->face_group, cage->group_count, cage->group_names,
        &out->groups, &out->face_group));
    OTX_TRY(carry_names(
        run, &faces, cage->face_object, cage->object_count, cage->object_names,
        &out->objects, &out->face_object));
    OTX_TRY(carry_names(
        run, &faces, cage->face_smooth, cage->smooth_count, cage->smooth_names,
        &out->smooths, &out->face_smooth));
    return carry_materials(run, cage, &faces, names->stem, out);
}

static otx_status
write_obj(
    otx_run *run, otx_atomic_file_set *set, const otx_names *names,
    const otx_obj *obj, const otx_model_options *options)
{
    const otx_obj_write_options how = {
        .name = names->obj,
        .comments = options->comments,
        .comment_count = options->comment_count,
    };
    const char *temporary;

    OTX_TRY(otx_atomic_file_add(run, set, names->obj, &temporary));
    return otx_obj_write(run, obj, temporary, &how);
}

static otx_status
write_mtl(
    otx_run *run, otx_atomic_file_set *set, const otx_names *names,
    const otx_obj_names *materials)
{
    otx_mtl_material *list =
        OTX_NEW(run->scratch, otx_mtl_material, materials->count);
    const otx_mtl mtl = {names->mtl, materials->count, list};
    const char *temporary;

    if (!list)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < materials->count; ++i)
        list[i] = (otx_mtl_material){
            .name = materials->text[i],
            .diffuse = {1.0f, 1.0f, 1.0f},
            .map_kd = names->exr_name,
        };
    OTX_TRY(otx_atomic_file_add(run, set, names->mtl, &temporary));
    return otx_mtl_write(run, &mtl, temporary, names->mtl);
}

/* All into temporaries, then all into place: the OBJ last, so that whoever
 * waits for it finds the others. */
static otx_status
write_files(
    otx_run *run, const otx_names *names, const otx_obj *obj,
    const otx_exemplar *exemplar, const otx_model_options *options)
{
    otx_atomic_file_set *set = options->set;

    if (!set)
        OTX_TRY(otx_atomic_file_begin(run, run->scratch, &set));
    if (!options->without_image)
        OTX_TRY(otx_texture_file_write(
            run, set, names->exr, exemplar, &exemplar->linear,
            &exemplar->tiles));
    OTX_TRY(write_mtl(run, set, names, &obj->materials));
    OTX_TRY(write_obj(run, set, names, obj, options));
    return options->set ? OSDTEX_OK : otx_atomic_file_commit(run, set, true);
}

otx_status
otx_model_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const otx_model_options *options, otx_model_files *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_names names;
    otx_obj obj;
    otx_status status;

    *out = (otx_model_files){0};
    OTX_TRY(otx_names_derive(run, run->arena, options->path, &names));
    status = describe_obj(run, mapping, &names, &obj);
    if (status == OSDTEX_OK)
        status = write_files(run, &names, &obj, exemplar, options);
    otx_arena_release(run->scratch, mark);
    if (status != OSDTEX_OK)
        return status;
    *out = (otx_model_files){
        .obj = names.obj,
        .mtl = names.mtl,
        .exr = options->without_image ? NULL : names.exr,
        .uv_count = obj.uv_count,
    };
    return OSDTEX_OK;
}
