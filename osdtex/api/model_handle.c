/* model_handle.c -- what there is to look at: an OBJ with its textures, or a
 * mapping as it stands in memory. Textures are brought to scene_linear, the
 * space that light is added up in. */
#include "api/call.h"
#include "api/handle.h"
#include "api/model_layers.h"
#include "api/model_maps.h"
#include "api/picture_source.h"
#include "colour/decoder.h"
#include "file/mtl.h"
#include "file/obj.h"
#include "file/picture_read.h"
#include "file/udim_name.h"
#include "image/udim.h"
#include "render/mapped_scene.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/* A texture and the file it came from. */
typedef struct source
{
    const char *path;
    int32_t texture; /* -1: the file is not there */
} source;

/* What a material shows. */
typedef struct material_look
{
    int32_t texture;     /* -1 none */
    bool is_constant;    /* a texture of one texel, for faces without UVs too */
    bool is_cut_out;     /* by the alpha of its texture */
    const char *pattern; /* of files that are one for each UDIM tile; NULL */
    otx_data_maps maps;  /* beside them; likewise patterns */
} material_look;

typedef struct loader
{
    otx_call *call;
    const otx_obj *obj;
    const otx_colour *colour;
    const char *linear; /* scene_linear of the configuration */
    otx_scene *scene;
    otx_scene_texture *textures; /* room for each material, and where there are
                                  * UDIM tiles for each face */
    otx_data_maps *maps;         /* of each texture */
    int32_t texture_count;
    source *sources; /* likewise */
    int32_t source_count;
    material_look *looks; /* [materials + 1] */
    bool has_constants;
} loader;

/* `name` beside the file `path`, in `arena`; NULL when memory is out. Windows
 * writers separate folders by backslashes. */
static char *
beside(otx_arena *arena, const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    const size_t folder =
        slash && name[0] != '/' ? (size_t)(slash - path) + 1 : 0;
    const size_t bytes = folder + strlen(name) + 1;
    char *result = OTX_NEW(arena, char, bytes);

    if (!result)
        return NULL;
    memcpy(result, path, folder);
    memcpy(result + folder, name, bytes - folder);
    if (access(result, R_OK) != 0)
        for (char *c = result + folder; *c; ++c)
            if (*c == '\\')
                *c = '/';
    return result;
}

/* Brings pixels to scene_linear, as the file's colours are resolved. */
static otx_status
linearise(loader *l, const char *path, otx_picture *picture)
{
    otx_run *run = &l->call->run;
    const otx_decoder *decoder;
    const char *space;
    otx_colour_source about = {.path = path};

    otx_picture_source_fill(picture, &about);
    OTX_TRY(otx_colour_resolve(run, l->colour, &about, &space, &decoder));
    if (decoder)
        OTX_TRY(otx_decoder_apply(run, decoder, &picture->image));
    return otx_colour_convert(
        run, l->colour, space, l->linear, &picture->image);
}

/* Index of the texture in the file `path`, read once; -1 when the file is not
 * there, which is a warning: a model without its textures can be looked at.
 *
 *   maps  that lie on it */
static otx_status
texture_of(loader *l, const char *path, const otx_data_maps *maps, int32_t *out)
{
    otx_run *run = &l->call->run;
    otx_where where = OTX_NOWHERE;
    otx_picture picture;

    where.file = path;
    for (int32_t i = 0; i < l->source_count; ++i)
    {
        if (strcmp(l->sources[i].path, path) == 0)
        {
            *out = l->sources[i].texture;
            return OSDTEX_OK;
        }
    }
    *out = -1;
    if (access(path, F_OK) == 0)
    {
        OTX_TRY(otx_picture_read(run, path, &picture));
        OTX_TRY(linearise(l, path, &picture));
        *out = l->texture_count++;
        l->maps[*out] = *maps;
        l->textures[*out] =
            (otx_scene_texture){picture.image, true, true, NULL};
    }
    else
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "model", where,
            "the texture is not there; its faces are shown grey");
    l->sources[l->source_count++] = (source){path, *out};
    return OSDTEX_OK;
}

/* A texture of one texel: Kd, whose numbers are taken as scene_linear, as
 * those of a texture in EXR are. */
static otx_status
constant_of(loader *l, const float color[3], int32_t *out)
{
    otx_run *run = &l->call->run;
    otx_image image;

    OTX_TRY(otx_image_create(run, run->arena, 1, 1, 3, &image));
    memcpy(image.pixels, color, 3 * sizeof *color);
    *out = l->texture_count++;
    l->maps[*out] = (otx_data_maps){0};
    l->textures[*out] = (otx_scene_texture){image, true, true, NULL};
    return OSDTEX_OK;
}

/* The maps of a material as paths. */
static otx_status
maps_beside(
    otx_run *run, const char *path, const otx_data_maps *from,
    otx_data_maps *out)
{
    const char *const names[] = {
        from->normal, from->roughness, from->metalness, from->height};
    const char **const paths[] = {
        &out->normal, &out->roughness, &out->metalness, &out->height};

    *out = (otx_data_maps){0};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (names[i])
            *paths[i] = beside(run->arena, path, names[i]);
    return otx_run_ok(run);
}

/* What a material of the library at `path` shows: its map, else its colour. */
static otx_status
look_of(
    loader *l, const char *path, const otx_mtl_material *material,
    material_look *out)
{
    otx_run *run = &l->call->run;
    const char *texture;

    if (material->map_kd)
    {
        out->is_cut_out =
            material->map_d && strcmp(material->map_d, material->map_kd) == 0;
        texture = beside(run->arena, path, material->map_kd);
        OTX_TRY(maps_beside(run, path, &material->maps, &out->maps));
        if (otx_udim_name_is_pattern(texture))
            out->pattern = texture;
        else
            OTX_TRY(texture_of(l, texture, &out->maps, &out->texture));
        return OSDTEX_OK;
    }
    if (!material->has_diffuse)
        return OSDTEX_OK;
    out->is_constant = l->has_constants = true;
    return constant_of(l, material->diffuse, &out->texture);
}

/* Gives the materials of one library their textures. */
static otx_status
use_library(loader *l, const char *path)
{
    otx_mtl mtl;

    OTX_TRY(otx_mtl_read(&l->call->run, path, &mtl));
    for (int32_t m = 0; m < l->obj->materials.count; ++m)
    {
        const int32_t found = otx_mtl_find(&mtl, l->obj->materials.text[m]);

        if (found >= 0 && l->looks[m].texture < 0 && !l->looks[m].pattern)
            OTX_TRY(look_of(l, path, &mtl.materials[found], &l->looks[m]));
    }
    return OSDTEX_OK;
}

static otx_status
use_libraries(loader *l)
{
    otx_run *run = &l->call->run;
    otx_where where = OTX_NOWHERE;

    where.file = l->obj->path;
    for (int32_t i = 0; i < l->obj->libraries.count; ++i)
    {
        const char *name = l->obj->libraries.text[i];
        const char *path = beside(run->arena, l->obj->path, name);

        OTX_TRY(otx_run_ok(run));
        if (access(path, F_OK) == 0)
            OTX_TRY(use_library(l, path));
        else
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, "model", where,
                "the material library '%.200s' is not beside the OBJ; its "
                "faces are shown grey",
                name);
    }
    return OSDTEX_OK;
}

/* The files of one UDIM tile. */
static otx_status
maps_of_tile(
    otx_run *run, const otx_data_maps *patterns, int32_t tile,
    otx_data_maps *out)
{
    const char **const paths[] = {
        &out->normal, &out->roughness, &out->metalness, &out->height};

    *out = *patterns;
    for (size_t i = 0; i < sizeof paths / sizeof *paths; ++i)
        if (*paths[i] && otx_udim_name_is_pattern(*paths[i]))
            *paths[i] = otx_udim_name_of(run->arena, *paths[i], tile);
    return otx_run_ok(run);
}

/* The texture of the UDIM tile that a face lies in, -1 where there is none;
 * the face's UVs become those within the tile.
 *
 *   uvs  of the face's corners */
static otx_status
tile_texture(
    loader *l, const material_look *look, float *uvs, int32_t size,
    int32_t *out)
{
    otx_data_maps maps;
    int32_t tile;
    double middle[2] = {0.0, 0.0};
    double column, row;
    const char *path;

    *out = -1;
    for (int32_t i = 0; i < size; ++i)
        for (int k = 0; k < 2; ++k)
            middle[k] += (double)uvs[2 * (size_t)i + k] / size;
    column = floor(middle[0]);
    row = floor(middle[1]);
    if (!(column >= 0.0 && column < OTX_UDIM_COLUMNS && row >= 0.0 &&
          row < OTX_UDIM_ROWS))
        return OSDTEX_OK;
    tile = otx_udim_tile((int32_t)column, (int32_t)row);
    path = otx_udim_name_of(l->call->run.arena, look->pattern, tile);
    OTX_TRY(maps_of_tile(&l->call->run, &look->maps, tile, &maps));
    for (int32_t i = 0; i < size; ++i)
    {
        uvs[2 * (size_t)i] -= (float)column;
        uvs[2 * (size_t)i + 1] -= (float)row;
    }
    return texture_of(l, path, &maps, out);
}

/* What a face shows: nothing without UVs, but for a constant. */
static otx_status
face_texture_of(
    loader *l, int32_t material, bool has_uvs, float *uvs, int32_t size,
    int32_t *out)
{
    const material_look *look = material >= 0 ? &l->looks[material] : NULL;

    *out = -1;
    if (!look || (!has_uvs && !look->is_constant))
        return OSDTEX_OK;
    *out = look->texture;
    return look->pattern ? tile_texture(l, look, uvs, size, out) : OSDTEX_OK;
}

/* Per-corner UVs and per-face textures from the OBJ's indices. */
static otx_status
spread_uvs(loader *l)
{
    const otx_obj *obj = l->obj;
    otx_run *run = &l->call->run;
    float *uvs = OTX_ZNEW(run->arena, float, 2 * (size_t)obj->corner_count);
    int32_t *face_texture = OTX_NEW(run->arena, int32_t, obj->face_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < obj->face_count; ++f)
    {
        const int32_t first = obj->face_first[f];
        const int32_t material =
            obj->face_material ? obj->face_material[f] : -1;
        const bool has_uvs = obj->face_uvs && obj->face_uvs[first] >= 0;

        for (int32_t c = first; has_uvs && c < obj->face_first[f + 1]; ++c)
            memcpy(
                uvs + 2 * (size_t)c, obj->uvs + 2 * (size_t)obj->face_uvs[c],
                2 * sizeof *uvs);
        OTX_TRY(face_texture_of(
            l, material, has_uvs, uvs + 2 * (size_t)first,
            obj->face_first[f + 1] - first, &face_texture[f]));
    }
    l->scene->uvs = uvs;
    l->scene->face_texture = face_texture;
    return OSDTEX_OK;
}

/* A picture that no UV leaves has a border: bleeding across it would draw a
 * line where a patch touches it. One that is left is meant to repeat. */
static void
choose_wrapping(loader *l)
{
    const otx_scene *scene = l->scene;

    for (int32_t t = 0; t < l->texture_count; ++t)
        l->textures[t].wrap_x = l->textures[t].wrap_y = false;
    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        const int32_t t = scene->face_texture[f];

        if (t < 0)
            continue;
        for (int32_t c = scene->face_first[f]; c < scene->face_first[f + 1];
             ++c)
        {
            const float u = scene->uvs[2 * (size_t)c];
            const float v = scene->uvs[2 * (size_t)c + 1];

            l->textures[t].wrap_x |= u < 0.0f || u > 1.0f;
            l->textures[t].wrap_y |= v < 0.0f || v > 1.0f;
        }
    }
}

static otx_status
hole_faces(otx_run *run, const otx_obj *obj, otx_scene *scene)
{
    uint8_t *holes;

    if (obj->hole_count == 0)
        return OSDTEX_OK;
    holes = OTX_ZNEW(run->arena, uint8_t, obj->face_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < obj->hole_count; ++i)
        holes[obj->hole_faces[i]] = 1;
    scene->face_hole = holes;
    return OSDTEX_OK;
}

/* Faces that are cut out lie over those of the same corners before them. */
static otx_status
fold_layers(loader *l)
{
    const otx_obj *obj = l->obj;
    uint8_t *over = OTX_ZNEW(l->call->run.scratch, uint8_t, obj->face_count);
    bool any = false;

    OTX_TRY(otx_run_ok(&l->call->run));
    for (int32_t f = 0; obj->face_material && f < obj->face_count; ++f)
    {
        const int32_t material = obj->face_material[f];

        over[f] = material >= 0 && l->looks[material].is_cut_out;
        any = any || over[f];
    }
    return any ? otx_model_layers_fold(
                     &l->call->run, over, l->textures, l->scene)
               : OSDTEX_OK;
}

static otx_status
load(loader *l)
{
    const size_t materials = (size_t)l->obj->materials.count + 1;
    const size_t slots = materials + (size_t)l->obj->face_count;
    otx_run *run = &l->call->run;

    l->textures = OTX_ZNEW(run->arena, otx_scene_texture, slots);
    l->maps = OTX_ZNEW(run->arena, otx_data_maps, slots);
    l->sources = OTX_ZNEW(run->arena, source, slots);
    l->looks = OTX_NEW(run->arena, material_look, materials);
    OTX_TRY(otx_run_ok(run));
    for (size_t m = 0; m < materials; ++m)
        l->looks[m] = (material_look){.texture = -1};
    OTX_TRY(use_libraries(l));
    OTX_TRY(hole_faces(run, l->obj, l->scene));
    if (l->obj->uv_count == 0 && !l->has_constants)
        return OSDTEX_OK;
    OTX_TRY(spread_uvs(l));
    choose_wrapping(l);
    l->scene->textures = l->textures;
    l->scene->texture_count = l->texture_count;
    OTX_TRY(fold_layers(l));
    return otx_model_maps_read(l->call, l->maps, l->scene, &l->scene->maps);
}

static otx_status
open_colour(otx_call *call, loader *l)
{
    OTX_TRY(otx_call_colour(call, &l->colour));
    return otx_colour_resolve_linear(&call->run, l->colour, NULL, &l->linear);
}

static otx_status
read_model(otx_call *call, const char *path, osdtex_model **out)
{
    otx_run *run = &call->run;
    osdtex_model *handle = OTX_ZNEW(run->arena, osdtex_model, 1);
    otx_obj obj;
    loader l = {.call = call, .obj = &obj};

    OTX_TRY(otx_run_ok(run));
    if (!path)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "model", OTX_NOWHERE,
            "no path of a model is given");
    OTX_TRY(otx_obj_read(run, path, &obj));
    OTX_TRY(open_colour(call, &l));
    handle->arena = run->arena;
    handle->scene = (otx_scene){
        .vert_count = obj.vert_count,
        .face_count = obj.face_count,
        .corner_count = obj.corner_count,
        .points = obj.points,
        .face_first = obj.face_first,
        .face_verts = obj.face_verts,
    };
    memcpy(handle->origin, obj.origin, sizeof handle->origin);
    l.scene = &handle->scene;
    OTX_TRY(load(&l));
    OTX_TRY(otx_scene_smooth(run, &handle->scene));
    OTX_TRY(otx_scene_validate(run, &handle->scene));
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_model_read(osdtex_context *context, const char *path, osdtex_model **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "model", &call));
    return otx_call_end(&call, read_model(&call, path, out), out);
}

/* The exemplar in scene_linear: borrowed where it is in that space already,
 * else a converted copy. */
static otx_status
texture_from(loader *l, const otx_exemplar *exemplar, otx_image *out)
{
    otx_run *run = &l->call->run;
    const otx_image *from = &exemplar->linear;
    const size_t bytes = (size_t)from->width * (size_t)from->height *
                         (size_t)from->channels * sizeof(float);

    *out = *from;
    if (strcmp(exemplar->linear_space, l->linear) == 0)
        return OSDTEX_OK;
    OTX_TRY(otx_image_create(
        run, run->arena, from->width, from->height, from->channels, out));
    memcpy(out->pixels, from->pixels, bytes);
    return otx_colour_convert(
        run, l->colour, exemplar->linear_space, l->linear, out);
}

static void
set_origin(osdtex_model *model)
{
    memcpy(model->origin, model->surface->cage->origin, sizeof model->origin);
}

static otx_status
create_model(otx_call *call, const osdtex_mapping *mapping, osdtex_model **out)
{
    otx_run *run = &call->run;
    osdtex_model *handle = OTX_ZNEW(run->arena, osdtex_model, 1);
    loader l = {.call = call};
    otx_exemplar exemplars[OTX_EXEMPLARS_MAX];

    OTX_TRY(otx_run_ok(run));
    if (!mapping)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "model", OTX_NOWHERE,
            "no mapping is given");
    OTX_TRY(open_colour(call, &l));
    for (int32_t k = 0; k < mapping->source_count; ++k)
    {
        exemplars[k] = mapping->exemplars[k];
        OTX_TRY(texture_from(&l, &mapping->exemplars[k], &exemplars[k].linear));
    }
    handle->arena = run->arena;
    OTX_TRY(otx_call_hold(run, mapping->arena));
    OTX_TRY(otx_scene_from_mapping(
        run, &mapping->mapping, exemplars, &handle->scene));
    handle->surface = &mapping->surface->surface;
    set_origin(handle);
    handle->guide = mapping->mapping.guide;
    handle->lattice = mapping->mapping.lattice;
    handle->mapping = mapping;
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_model_create(
    osdtex_context *context, const osdtex_mapping *mapping, osdtex_model **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "model", &call));
    return otx_call_end(&call, create_model(&call, mapping, out), out);
}

static otx_status
create_from_field(otx_run *run, const osdtex_field *field, osdtex_model **out)
{
    osdtex_model *handle = OTX_ZNEW(run->arena, osdtex_model, 1);
    const otx_level *leaf;

    OTX_TRY(otx_run_ok(run));
    if (!field)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "model", OTX_NOWHERE,
            "no field is given");
    leaf = field->connection.level;
    handle->arena = run->arena;
    OTX_TRY(otx_call_hold(run, field->arena));
    handle->surface = &field->surface->surface;
    set_origin(handle);
    handle->guide = &field->guide;
    handle->scene = (otx_scene){
        .vert_count = leaf->vert_count,
        .face_count = leaf->face_count,
        .corner_count = leaf->corner_count,
        .points = handle->surface->points,
        .face_first = leaf->face_first,
        .face_verts = leaf->face_verts,
        .face_hole = leaf->face_hole,
        .vert_normals = handle->surface->normals,
    };
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_model_create_field(
    osdtex_context *context, const osdtex_field *field, osdtex_model **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "model", &call));
    return otx_call_end(&call, create_from_field(&call.run, field, out), out);
}

/* The field's faces are those of the model. */
static otx_status
check_field(otx_run *run, const osdtex_model *model, const osdtex_field *field)
{
    const otx_scene *scene = &model->scene;
    const otx_level *leaf = field->connection.level;

    if (scene->face_count != leaf->face_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "model", OTX_NOWHERE,
            "the field is of %d faces, but the model has %d",
            (int)leaf->face_count, (int)scene->face_count);
    if (memcmp(
            model->origin, field->surface->surface.cage->origin,
            sizeof model->origin) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "model", OTX_NOWHERE,
            "the field is of a surface that is kept relative to another "
            "origin; make it on the model's own OBJ");
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (scene->face_first[f + 1] != leaf->face_first[f + 1])
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, "model",
                (otx_where){NULL, 0, f, -1},
                "a face of the model has other corners than that of the field");
    return OSDTEX_OK;
}

static otx_status
join_field(
    otx_run *run, const osdtex_model *model, const osdtex_field *field,
    osdtex_model **out)
{
    osdtex_model *handle = OTX_ZNEW(run->arena, osdtex_model, 1);

    OTX_TRY(otx_run_ok(run));
    if (!model || !field)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "model", OTX_NOWHERE,
            "no model or no field is given");
    OTX_TRY(check_field(run, model, field));
    OTX_TRY(otx_call_hold(run, model->arena));
    OTX_TRY(otx_call_hold(run, field->arena));
    *handle = *model;
    handle->arena = run->arena;
    handle->surface = &field->surface->surface;
    handle->guide = &field->guide;
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_model_join_field(
    osdtex_context *context, const osdtex_model *model,
    const osdtex_field *field, osdtex_model **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "model", &call));
    return otx_call_end(&call, join_field(&call.run, model, field, out), out);
}

void
osdtex_model_destroy(osdtex_model *model)
{
    if (model)
        otx_arena_destroy(model->arena);
}
