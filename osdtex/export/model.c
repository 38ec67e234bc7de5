/* model.c -- from a mapping to what the writers of file/ take. */
#include "export/model.h"

#include "export/baked_texture.h"
#include "export/cage_model.h"
#include "export/companion_files.h"
#include "export/corner_normals.h"
#include "export/names.h"
#include "export/paste_model.h"
#include "export/texture_file.h"
#include "export/uv_pool.h"
#include "file/mtl.h"
#include "file/obj_write.h"
#include "mapping/source.h"

#include <stdio.h>
#include <string.h>

static const char STAGE[] = "export";

/* The leaf faces that are written, as arrays of their own. */
typedef struct leaf_faces
{
    int32_t count, corner_count;
    int32_t *first;   /* [count + 1] */
    int32_t *verts;   /* [corner_count] */
    int32_t *corners; /* [corner_count], of the leaf level */
    float *uvs;       /* [corner_count * 2] */
    int32_t *parents; /* [count], cage face */
    uint8_t *sources; /* [count], exemplar */
} leaf_faces;

/* The written materials, each with one texture. */
typedef struct material_list
{
    int32_t count;
    const char **names;
    int32_t *sources; /* exemplars */
} material_list;

static otx_status
allocate_faces(otx_run *run, const otx_level *leaf, leaf_faces *out)
{
    const size_t corners = (size_t)leaf->corner_count;

    *out = (leaf_faces){
        .first = OTX_NEW(run->scratch, int32_t, (size_t)leaf->face_count + 1),
        .verts = OTX_NEW(run->scratch, int32_t, corners),
        .corners = OTX_NEW(run->scratch, int32_t, corners),
        .uvs = OTX_NEW(run->scratch, float, corners * 2),
        .parents = OTX_NEW(run->scratch, int32_t, leaf->face_count),
        .sources = OTX_NEW(run->scratch, uint8_t, leaf->face_count),
    };
    OTX_TRY(otx_run_ok(run));
    out->first[0] = 0;
    return OSDTEX_OK;
}

static bool
is_plain(const otx_surface *surface)
{
    return surface->cage->scheme == OTX_SCHEME_NONE;
}

/* A plain mesh may have been severed where it is no manifold: it is written
 * with the vertices that it came with. */
static const int32_t *
written_verts(const otx_surface *surface)
{
    return is_plain(surface) ? surface->cage->face_verts
                             : otx_surface_leaf(surface)->face_verts;
}

static bool
is_hole(const otx_surface *surface, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    return leaf->face_hole && leaf->face_hole[face];
}

/* Leaf faces in their order, which is that of the cage's. Holes are left out,
 * but of a plain mesh, which stays the mesh that it is. */
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

        if (is_hole(mapping->surface, f) && !is_plain(mapping->surface))
            continue;
        memcpy(out->verts + to, verts + from, size * sizeof *out->verts);
        for (size_t k = 0; k < size; ++k)
            out->corners[to + k] = (int32_t)(from + k);
        memcpy(
            out->uvs + 2 * to, mapping->uvs + 2 * from,
            2 * size * sizeof *out->uvs);
        out->corner_count += (int32_t)size;
        out->sources[out->count] = (uint8_t)otx_source_of(mapping, f);
        out->parents[out->count++] = leaf->face_cage[f];
        out->first[out->count] = out->corner_count;
    }
    return OSDTEX_OK;
}

/* A pool of the UVs of faces that show a texture; holes that are written have
 * none.
 *
 *   indices  into the pool, -1 at corners of holes */
static otx_status
pool_uvs(
    otx_run *run, const otx_surface *surface, const leaf_faces *faces,
    otx_uv_pool *pool, const int32_t **indices)
{
    int32_t *verts = OTX_NEW(run->scratch, int32_t, faces->corner_count);
    float *uvs = OTX_NEW(run->scratch, float, 2 * (size_t)faces->corner_count);
    int32_t *spread = OTX_NEW(run->scratch, int32_t, faces->corner_count);
    int32_t count = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < faces->count; ++f)
    {
        const bool hole = is_plain(surface) && is_hole(surface, f);

        for (int32_t c = faces->first[f]; c < faces->first[f + 1]; ++c)
        {
            spread[c] = hole ? -1 : count;
            if (hole)
                continue;
            verts[count] = faces->verts[c];
            memcpy(
                uvs + 2 * (size_t)count++, faces->uvs + 2 * (size_t)c,
                2 * sizeof *uvs);
        }
    }
    OTX_TRY(otx_uv_pool_build(run, run->scratch, count, verts, uvs, pool));
    for (int32_t c = 0; c < faces->corner_count; ++c)
        spread[c] = spread[c] < 0 ? -1 : pool->indices[spread[c]];
    *indices = spread;
    return OSDTEX_OK;
}

/* Of a stack, where along its axis each UV lies, which is the place of its
 * vertex. NULL: there is no axis, or vertices are not those of the leaf level.
 */
static otx_status
find_depths(
    otx_run *run, const otx_mapping *mapping, const leaf_faces *faces,
    const otx_uv_pool *pool, const int32_t *indices, const float **out)
{
    float *depths;

    *out = NULL;
    if (!mapping->along || is_plain(mapping->surface))
        return OSDTEX_OK;
    depths = OTX_ZNEW(run->scratch, float, pool->count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t c = 0; c < faces->corner_count; ++c)
        if (indices[c] >= 0)
            depths[indices[c]] = mapping->along[faces->verts[c]];
    *out = depths;
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
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < faces->count; ++f)
        carried[f] = cage_faces[faces->parents[f]];
    *names = (otx_obj_names){count, text};
    *indices = carried;
    return OSDTEX_OK;
}

/* A name that is not among `names`: "BASE_K", K from 1. NULL when memory is
 * out. */
static const char *
name_apart(
    otx_run *run, const otx_obj_names *names, const char *base, int32_t source)
{
    const size_t bytes = strlen(base) + 32;
    char *name = OTX_NEW(run->scratch, char, bytes);
    int length =
        name ? snprintf(name, bytes, "%s_%d", base, (int)source + 1) : 0;

    while (name && otx_names_find(names->text, names->count, name) >= 0 &&
           length + 2 < (int)bytes)
    {
        name[length++] = '_';
        name[length] = '\0';
    }
    return name;
}

/* The exemplar that most faces of each material show. */
static int32_t *
main_sources(
    otx_run *run, const leaf_faces *faces, const otx_obj *obj, int64_t *counts)
{
    int32_t *main = OTX_ZNEW(run->scratch, int32_t, obj->materials.count);

    for (int32_t f = 0; main && f < faces->count; ++f)
        ++counts[OTX_EXEMPLARS_MAX * obj->face_material[f] + faces->sources[f]];
    for (int32_t m = 0; main && m < obj->materials.count; ++m)
        for (int32_t k = 1; k < OTX_EXEMPLARS_MAX; ++k)
            if (counts[OTX_EXEMPLARS_MAX * m + k] >
                counts[OTX_EXEMPLARS_MAX * m + main[m]])
                main[m] = k;
    return main;
}

/* Divides materials whose faces show several exemplars: the faces of the one
 * that most show keep the name, the others' get a number behind it; those of
 * `fallback` all do. */
static otx_status
divide_materials(
    otx_run *run, const leaf_faces *faces, const char *fallback, otx_obj *obj,
    material_list *out)
{
    const int32_t most = OTX_EXEMPLARS_MAX * obj->materials.count;
    int64_t *counts = OTX_ZNEW(run->scratch, int64_t, most);
    int32_t *index = OTX_NEW(run->scratch, int32_t, most);
    int32_t *indices = OTX_NEW(run->scratch, int32_t, faces->count);
    const int32_t *main;

    out->names = OTX_NEW(run->scratch, const char *, most);
    out->sources = OTX_NEW(run->scratch, int32_t, most);
    OTX_TRY(otx_run_ok(run));
    main = main_sources(run, faces, obj, counts);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < most; ++i)
    {
        const int32_t k = i % OTX_EXEMPLARS_MAX;
        const char *base = obj->materials.text[i / OTX_EXEMPLARS_MAX];
        const bool keeps =
            main[i / OTX_EXEMPLARS_MAX] == k && strcmp(base, fallback) != 0;

        if (counts[i] == 0)
            continue;
        index[i] = out->count;
        out->sources[out->count] = k;
        out->names[out->count] =
            keeps ? base : name_apart(run, &obj->materials, base, k);
        if (!out->names[out->count++])
            return otx_fail_memory(run, STAGE);
    }
    for (int32_t f = 0; f < faces->count; ++f)
        indices[f] = index
            [OTX_EXEMPLARS_MAX * obj->face_material[f] + faces->sources[f]];
    obj->materials = (otx_obj_names){out->count, out->names};
    obj->face_material = indices;
    return OSDTEX_OK;
}

/* All of one texture. */
static otx_status
list_materials(otx_run *run, const otx_obj *obj, material_list *out)
{
    out->count = obj->materials.count;
    out->names = NULL;
    out->sources = OTX_ZNEW(run->scratch, int32_t, out->count);
    return otx_run_ok(run);
}

static void
set_points(const otx_surface *surface, otx_obj *out)
{
    const otx_cage *cage = surface->cage;

    memcpy(out->origin, cage->origin, sizeof out->origin);
    out->vert_count = otx_surface_leaf(surface)->vert_count;
    out->points = surface->points;
    if (!is_plain(surface))
        return;
    out->vert_count = cage->vert_count;
    out->points = cage->points;
    out->colors = cage->colors;
    out->point_lines = cage->point_lines;
    out->point_line_bytes = cage->point_line_bytes;
}

/* A plain mesh may be a cage to others: what it says about its subdivision
 * stays with it. */
static bool
has_tags(const otx_surface *surface)
{
    const otx_cage *cage = surface->cage;
    bool holes = false;

    for (int32_t f = 0; cage->face_hole && f < cage->face_count; ++f)
        holes |= cage->face_hole[f] != 0;
    return is_plain(surface) &&
           (holes || cage->crease_count > 0 || cage->corner_tag_count > 0);
}

static otx_status
add_normals(
    otx_run *run, const otx_surface *surface, const leaf_faces *faces,
    otx_obj *obj)
{
    int32_t *indices = OTX_NEW(run->scratch, int32_t, faces->corner_count);
    otx_corner_normals all;

    OTX_TRY(otx_corner_normals_build(run, surface, &all));
    OTX_TRY(otx_run_ok(run));
    for (int32_t c = 0; c < faces->corner_count; ++c)
        indices[c] = all.indices[faces->corners[c]];
    obj->normal_count = all.count;
    obj->normals = all.normals;
    obj->face_normals = indices;
    return OSDTEX_OK;
}

static otx_status
describe_obj(
    otx_run *run, const otx_mapping *mapping, const otx_names *names,
    bool normals, otx_obj *out, material_list *materials)
{
    const otx_cage *cage = mapping->surface->cage;
    const char **library = OTX_NEW(run->scratch, const char *, 1);
    leaf_faces faces;
    otx_uv_pool pool;
    const int32_t *face_uvs = NULL;
    const float *depths;

    OTX_TRY(otx_run_ok(run));
    *library = names->mtl_name;
    OTX_TRY(gather_faces(run, mapping, &faces));
    OTX_TRY(pool_uvs(run, mapping->surface, &faces, &pool, &face_uvs));
    OTX_TRY(find_depths(run, mapping, &faces, &pool, face_uvs, &depths));
    *out = (otx_obj){
        .path = names->obj,
        .uv_count = pool.count,
        .face_count = faces.count,
        .corner_count = faces.corner_count,
        .uvs = pool.uvs,
        .uv_depths = depths,
        .face_first = faces.first,
        .face_verts = faces.verts,
        .face_uvs = face_uvs,
        .libraries = {1, library},
        .boundary = OTX_OBJ_NO_RULE,
        .fvar = OTX_OBJ_NO_RULE,
        .crease_method = OTX_OBJ_NO_RULE,
        .triangles = OTX_OBJ_NO_RULE,
    };
    set_points(mapping->surface, out);
    if (normals)
        OTX_TRY(add_normals(run, mapping->surface, &faces, out));
    if (has_tags(mapping->surface))
        OTX_TRY(otx_cage_model_tags(run, cage, cage->fvar, out));
    OTX_TRY(carry_names(
        run, &faces, cage->face_group, cage->group_count, cage->group_names,
        &out->groups, &out->face_group));
    OTX_TRY(carry_names(
        run, &faces, cage->face_object, cage->object_count, cage->object_names,
        &out->objects, &out->face_object));
    OTX_TRY(carry_names(
        run, &faces, cage->face_smooth, cage->smooth_count, cage->smooth_names,
        &out->smooths, &out->face_smooth));
    OTX_TRY(otx_cage_model_materials(
        run, cage, faces.parents, faces.count, names->stem, out));
    return otx_source_count(mapping) > 1
               ? divide_materials(run, &faces, names->stem, out, materials)
               : list_materials(run, out, materials);
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
        .tags = true,
    };
    const char *temporary;

    OTX_TRY(otx_atomic_file_add(run, set, names->obj, &temporary));
    return otx_obj_write(run, obj, temporary, &how);
}

/* What the UVs look up: the exemplars, or what was baked of them. */
typedef struct texture_source
{
    const otx_mapping *mapping;
    const otx_exemplar *exemplars;
    const otx_layout *layout; /* NULL: the exemplars */
} texture_source;

/* Which maps any of the exemplars has. */
static otx_companions
maps_of_any(const texture_source *from)
{
    otx_companions any = from->exemplars->companions;

    for (int32_t k = 1; k < otx_source_count(from->mapping); ++k)
        for (int i = 0; i < OTX_COMPANION_COUNT; ++i)
            any.maps[i].is_there |=
                from->exemplars[k].companions.maps[i].is_there;
    return any;
}

static otx_status
write_mtl(
    otx_run *run, otx_atomic_file_set *set, const otx_names *names,
    const otx_obj *obj, const material_list *materials,
    const texture_source *from)
{
    otx_mtl_material *list =
        OTX_NEW(run->scratch, otx_mtl_material, materials->count);
    const otx_mtl mtl = {names->mtl, materials->count, list};
    const otx_companions any = maps_of_any(from);
    const char *temporary;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < materials->count; ++i)
    {
        const int32_t k = materials->sources[i];

        list[i] = (otx_mtl_material){
            .name = obj->materials.text[i],
            .diffuse = {1.0f, 1.0f, 1.0f},
            .map_kd = names->texture_names[k],
        };
        list[i].maps = otx_companion_files_names(
            run, names->texture_names[k], from->exemplars[k].type,
            from->layout ? &any : &from->exemplars[k].companions);
    }
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_atomic_file_add(run, set, names->mtl, &temporary));
    return otx_mtl_write(run, &mtl, temporary, names->mtl);
}

static otx_status
write_textures(
    otx_run *run, otx_atomic_file_set *set, const otx_names *names,
    const texture_source *from)
{
    const otx_exemplar *e = from->exemplars;

    if (from->layout)
        return otx_baked_texture_write(
            run, set, names->textures[0], from->mapping, e, from->layout);
    for (int32_t k = 0; k < names->texture_count; ++k)
        OTX_TRY(otx_texture_file_write(
            run, set, names->textures[k], &e[k], &e[k].linear, &e[k].tiles));
    for (int32_t k = 0; k < names->texture_count; ++k)
        OTX_TRY(otx_companion_files_write(
            run, set, names->textures[k], &e[k],
            otx_source_unit(from->mapping, e, k).x));
    return OSDTEX_OK;
}

/* All into temporaries, then all into place: the OBJ last, so that whoever
 * waits for it finds the others. */
static otx_status
write_files(
    otx_run *run, const otx_names *names, const otx_obj *obj,
    const material_list *materials, const texture_source *from,
    const otx_model_options *options)
{
    otx_atomic_file_set *set = options->set;

    if (!set)
        OTX_TRY(otx_atomic_file_begin(run, run->scratch, &set));
    if (!options->without_image)
        OTX_TRY(write_textures(run, set, names, from));
    OTX_TRY(write_mtl(run, set, names, obj, materials, from));
    OTX_TRY(write_obj(run, set, names, obj, options));
    return options->set ? OSDTEX_OK : otx_atomic_file_commit(run, set, true);
}

static otx_status
write_model(
    otx_run *run, const otx_mapping *mapping, const texture_source *from,
    const otx_names *names, const otx_model_options *options, int32_t *uv_count)
{
    material_list materials = {0};
    otx_obj obj;

    OTX_TRY(
        describe_obj(run, mapping, names, options->normals, &obj, &materials));
    *uv_count = obj.uv_count;
    return write_files(run, names, &obj, &materials, from, options);
}

/* The mapping as UVs onto an atlas of its own. */
static otx_status
flatten_pastes(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    int32_t side, otx_layout *layout, otx_mapping *out)
{
    const int32_t corners = otx_surface_leaf(mapping->surface)->corner_count;
    float *uvs = OTX_NEW(run->scratch, float, 2 * (size_t)corners);

    if (!uvs)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(otx_baked_texture_lay_out(run, mapping, exemplars, side, layout));
    memcpy(uvs, layout->leaf_uvs, 2 * sizeof *uvs * (size_t)corners);
    *out = *mapping;
    out->uvs = uvs;
    out->patch_exemplar = NULL;
    return OSDTEX_OK;
}

/* A list of pastes, into place at once where no set is given. */
static otx_status
write_pastes(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_model_options *options, const otx_names *names, int32_t *uv_count)
{
    otx_model_options ours = *options;

    if (!ours.set)
        OTX_TRY(otx_atomic_file_begin(run, run->scratch, &ours.set));
    OTX_TRY(
        otx_paste_model_write(run, mapping, exemplars, &ours, names, uv_count));
    return options->set ? OSDTEX_OK
                        : otx_atomic_file_commit(run, ours.set, true);
}

static otx_status
write_named(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_model_options *options, const otx_names *names, int32_t *uv_count)
{
    texture_source from = {mapping, exemplars, NULL};
    otx_mapping flat = *mapping;
    otx_layout layout;

    if (options->pastes)
        return write_pastes(run, mapping, exemplars, options, names, uv_count);
    if (otx_baked_texture_is_needed(mapping))
    {
        OTX_TRY(flatten_pastes(
            run, mapping, exemplars, options->resolution, &layout, &flat));
        from.layout = &layout;
    }
    return write_model(run, &flat, &from, names, options, uv_count);
}

/* What the mapping has and its UVs, or the texture of its pastes, have not. */
static void
say_what_is_left(otx_run *run, const otx_mapping *mapping, const char *path)
{
    if (mapping->field && !otx_baked_texture_is_needed(mapping))
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, otx_where_file(path),
            "UVs cannot say what was healed, so seams are in it as they were; "
            "a bake has them healed");
}

otx_status
otx_model_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_model_options *options, otx_model_files *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t textures =
        otx_baked_texture_is_needed(mapping) ? 1 : otx_source_count(mapping);
    otx_names names;
    otx_status status;
    int32_t uv_count = 0;

    *out = (otx_model_files){0};
    OTX_TRY(otx_names_derive(run, run->arena, options->path, &names));
    OTX_TRY(otx_names_number(
        run, run->arena, textures, otx_texture_file_extension(exemplars),
        &names));
    say_what_is_left(run, mapping, names.obj);
    status = write_named(run, mapping, exemplars, options, &names, &uv_count);
    otx_arena_release(run->scratch, mark);
    if (status != OSDTEX_OK)
        return status;
    *out = (otx_model_files){
        .obj = names.obj,
        .mtl = names.mtl,
        .exr = options->without_image ? NULL : names.textures[0],
        .uv_count = uv_count,
    };
    return OSDTEX_OK;
}
