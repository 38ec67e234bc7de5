/* mapped_scene.c -- the scene that shows a mapping. */
#include "render/mapped_scene.h"

#include "mapping/source.h"
#include "render/distortion.h"

static otx_scene_texture *
list_textures(otx_run *run, const otx_exemplar *exemplars, int32_t count)
{
    otx_scene_texture *list = OTX_ZNEW(run->arena, otx_scene_texture, count);

    for (int32_t k = 0; list && k < count; ++k)
        list[k] = (otx_scene_texture){
            exemplars[k].linear, exemplars[k].wrap_x, exemplars[k].wrap_y,
            exemplars[k].slices};
    return list;
}

/* Which texture each face shows; NULL in *out when there is one. */
static otx_status
list_sources(otx_run *run, const otx_mapping *mapping, const int32_t **out)
{
    const int32_t count = otx_surface_leaf(mapping->surface)->face_count;
    int32_t *sources;

    *out = NULL;
    if (otx_source_count(mapping) == 1)
        return OSDTEX_OK;
    sources = OTX_NEW(run->arena, int32_t, count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < count; ++f)
        sources[f] = otx_source_of(mapping, f);
    *out = sources;
    return OSDTEX_OK;
}

/* NULL in *out where no exemplar has any. */
static otx_status
make_maps(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_map_textures **out)
{
    otx_map_textures *maps = OTX_ZNEW(run->arena, otx_map_textures, 1);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_map_textures_create(
        run, mapping, exemplars, OTX_MAP_TEXTURES_ALL, maps));
    *out = maps->channels > 0 ? maps : NULL;
    return OSDTEX_OK;
}

otx_status
otx_scene_from_mapping(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_scene *out)
{
    const otx_surface *surface = mapping->surface;
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t count = otx_source_count(mapping);
    const otx_scene_texture *textures = list_textures(run, exemplars, count);
    otx_vec2 units[OTX_EXEMPLARS_MAX];

    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < count; ++k)
        units[k] = otx_source_unit(mapping, exemplars, k);
    *out = (otx_scene){
        .vert_count = leaf->vert_count,
        .face_count = leaf->face_count,
        .corner_count = leaf->corner_count,
        .points = surface->points,
        .face_first = leaf->face_first,
        .face_verts = leaf->face_verts,
        .face_hole = leaf->face_hole,
        .uvs = mapping->uvs,
        .lookups = mapping->lookups,
        .field = mapping->field,
        .along = mapping->along,
        .decals = mapping->decals,
        .vert_normals = surface->normals,
        .texture_count = count,
        .textures = textures,
        .face_root = leaf->face_cage,
        .face_patch = mapping->face_patch,
    };
    OTX_TRY(list_sources(run, mapping, &out->face_texture));
    OTX_TRY(make_maps(run, mapping, exemplars, &out->maps));
    return otx_distortion_faces(
        run, run->arena, out, units, &out->face_stretch);
}
