/* textures_handle.c -- a bake in memory: what there is, and whole levels. */
#include "api/textures_handle.h"
#include "api/bake_handle.h"
#include "api/call.h"
#include "api/handle.h"
#include "api/image_handle.h"
#include "export/cage_model.h"

static const char STAGE[] = "bake";

/* ---- what there is ------------------------------------------------------- */

static osdtex_texture_info
describe(const otx_bake *bake, const otx_exemplar *exemplar)
{
    static const char *const summaries[OTX_TEXEL_KIND_COUNT] = {
        "Scene-linear colour, multiplied by alpha where there is alpha.",
        "Number of the patch, face of the cage, and 1 on the surface.",
        "U and v in the exemplar, and 1 on the surface.",
        "L2 stretch, ratio of the axes, and 1 on the surface.",
        "1 where patches meet, nothing, and 1 on the surface.",
        "Exemplar, U and V in it, and the footprint in widths of it.",
        "Place along the axis of a stack, 0, and 1 on the surface."};
    const otx_texel_kind kind = bake->source.kind;

    return (osdtex_texture_info){
        .name = otx_bake_kind_name(kind),
        .color_space = kind == OTX_TEXEL_COLOR ? exemplar->linear_space : NULL,
        .summary = summaries[kind],
        .channels = bake->source.channels,
    };
}

static osdtex_texture_info
describe_map(int32_t map)
{
    static const char *const summaries[OTX_COMPANION_COUNT] = {
        "Normal in the frame of the UVs, y up, as (n + 1) / 2.",
        "Roughness, 0 a mirror.", "Height above the surface, in scene units.",
        "Metalness, 0 to 1.", "Ambient occlusion, 1 where nothing occludes."};
    const otx_companion_kind kind = (otx_companion_kind)map;

    return (osdtex_texture_info){
        .name = otx_companion_name(kind),
        .summary = summaries[map],
        .channels = otx_companion_channels(kind),
    };
}

static void
add_texture(
    osdtex_textures *handle, otx_textures_source source,
    osdtex_texture_info info)
{
    const int32_t i = handle->info.texture_count++;

    handle->sources[i] = source;
    handle->textures[i] = info;
}

static otx_status
add_kind(
    otx_run *run, const osdtex_mapping *mapping, const otx_bake_options *how,
    osdtex_textures *handle)
{
    otx_bake *bake = &handle->bakes[how->kind];

    OTX_TRY(otx_bake_create(
        run, &mapping->mapping, mapping->exemplars, &handle->layout, how,
        bake));
    add_texture(
        handle, (otx_textures_source){bake, -1},
        describe(bake, &mapping->exemplars[0]));
    return OSDTEX_OK;
}

/* The maps that lie on the colour. Each has a bake of its own, so that one is
 * had without the others. */
static otx_status
add_maps(
    otx_run *run, const osdtex_mapping *mapping,
    const osdtex_bake_options *ours, osdtex_textures *handle)
{
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
    {
        const otx_bake_options how = {
            .kind = OTX_TEXEL_COLOR,
            .seam_blend = ours->seam_blend,
            .maps = 1u << k,
            .maps_alone = true};
        otx_bake *bake = &handle->map_bakes[k];

        OTX_TRY(otx_bake_create(
            run, &mapping->mapping, mapping->exemplars, &handle->layout, &how,
            bake));
        if (bake->maps.texels.channels > 0)
            add_texture(
                handle, (otx_textures_source){bake, k}, describe_map(k));
    }
    return OSDTEX_OK;
}

/* The colour, the maps, and the extras. */
static otx_status
add_textures(
    otx_run *run, const osdtex_mapping *mapping,
    const osdtex_bake_options *ours, osdtex_textures *handle)
{
    for (int kind = 0; kind < OTX_TEXEL_KIND_COUNT; ++kind)
    {
        const otx_bake_options how = {
            .kind = (otx_texel_kind)kind, .seam_blend = ours->seam_blend};

        if (otx_bake_handle_has(ours, how.kind))
            OTX_TRY(add_kind(run, mapping, &how, handle));
        if (kind == OTX_TEXEL_COLOR)
            OTX_TRY(add_maps(run, mapping, ours, handle));
    }
    return OSDTEX_OK;
}

static void
describe_layout(osdtex_textures *handle, int32_t udim)
{
    const otx_layout *layout = &handle->layout;
    const otx_level *cage = &layout->surface->levels[0];
    osdtex_textures_info *info = &handle->info;

    info->tile_count = udim != 0 ? 1 : layout->tile_count;
    info->tiles = layout->tiles + handle->first_tile;
    info->side = layout->side;
    info->level_count = otx_pyramid_count(layout->side, layout->side);
    info->uvs = layout->is_charts  ? OSDTEX_BAKE_UVS_CHARTS
                : layout->is_atlas ? OSDTEX_BAKE_UVS_ATLAS
                                   : OSDTEX_BAKE_UVS_OWN;
    info->fvar = (osdtex_fvar)otx_cage_model_fvar(layout);
    info->uv_count = layout->uv_count;
    info->corner_count = cage->corner_count;
    info->cage_uvs = layout->uvs;
    info->face_uvs = layout->face_uvs;
}

static otx_status
create(
    otx_run *run, const osdtex_mapping *mapping,
    const osdtex_bake_options *options, osdtex_textures **out)
{
    osdtex_textures *handle = OTX_ZNEW(run->arena, osdtex_textures, 1);
    otx_layout_options place;
    osdtex_bake_options ours;

    if (!handle)
        return otx_fail_memory(run, STAGE);
    if (!mapping)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping is given");
    OTX_TRY(otx_bake_handle_options(run, options, &ours));
    OTX_TRY(otx_call_hold(run, mapping->arena));
    handle->arena = run->arena;
    place = otx_bake_handle_layout(&ours);
    OTX_TRY(otx_layout_build(run, &mapping->mapping, &place, &handle->layout));
    if (ours.udim != 0)
        OTX_TRY(otx_layout_find_tile(
            run, &handle->layout, ours.udim, &handle->first_tile));
    OTX_TRY(add_textures(run, mapping, &ours, handle));
    describe_layout(handle, ours.udim);
    *out = handle;
    return OSDTEX_OK;
}

osdtex_status
osdtex_textures_create(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_bake_options *options, osdtex_textures **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_end(&call, create(&call.run, mapping, options, out), out);
}

const osdtex_textures_info *
osdtex_textures_describe(const osdtex_textures *textures)
{
    return textures ? &textures->info : NULL;
}

const osdtex_texture_info *
osdtex_texture_describe(const osdtex_textures *textures, int32_t index)
{
    return textures && index >= 0 && index < textures->info.texture_count
               ? &textures->textures[index]
               : NULL;
}

void
osdtex_textures_destroy(osdtex_textures *textures)
{
    if (textures)
        otx_arena_destroy(textures->arena);
}

/* ---- a level in one piece ------------------------------------------------ */

/* What is kept of each block, and where. */
typedef struct keeper
{
    otx_image *image;
    int32_t map; /* -1 the bake's own */
} keeper;

static void
take_level(void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    const keeper *k = user;
    const otx_bake_block kept = otx_bake_block_of(block, k->map);

    (void)slot;
    (void)lane;
    otx_bake_copy(&kept, k->image);
}

static otx_status
put_nothing(void *user, int32_t slot, int32_t level, int32_t x, int32_t y)
{
    (void)user;
    (void)slot;
    (void)level;
    (void)x;
    (void)y;
    return OSDTEX_OK;
}

/* The size of a part; its pixels are for the caller to set. */
static otx_status
find_part(
    otx_run *run, const osdtex_textures *textures,
    const osdtex_texture_part *part, otx_image *out)
{
    const osdtex_textures_info *info = textures ? &textures->info : NULL;

    if (!info || !part || part->texture < 0 ||
        part->texture >= info->texture_count || part->tile < 0 ||
        part->tile >= info->tile_count || part->level < 0 ||
        part->level >= info->level_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no textures are given, or they have no such texture, tile or "
            "level");
    out->width = out->height = otx_pyramid_side(info->side, part->level);
    out->channels = textures->textures[part->texture].channels;
    return OSDTEX_OK;
}

static otx_status
bake_part(
    otx_run *run, const osdtex_textures *textures,
    const osdtex_texture_part *part, otx_image *image)
{
    const otx_textures_source *source = &textures->sources[part->texture];
    keeper kept = {image, source->map};
    const otx_bake_sink sink = {
        .take = take_level,
        .put = put_nothing,
        .user = &kept,
        .first_level = part->level,
        .level_count = 1,
        .share = 1.0};

    return otx_bake_tile(
        run, source->bake, textures->first_tile + part->tile, &sink);
}

static otx_status
make_image(
    otx_run *run, const osdtex_textures *textures,
    const osdtex_texture_part *part, osdtex_image **out)
{
    otx_image image;

    OTX_TRY(find_part(run, textures, part, &image));
    OTX_TRY(otx_image_create(
        run, run->arena, image.width, image.height, image.channels, &image));
    OTX_TRY(bake_part(run, textures, part, &image));
    return otx_image_handle_wrap(run, image, out);
}

osdtex_status
osdtex_textures_image(
    osdtex_context *context, const osdtex_textures *textures,
    const osdtex_texture_part *part, osdtex_image **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_end(&call, make_image(&call.run, textures, part, out), out);
}

static otx_status
read_part(
    otx_run *run, const osdtex_textures *textures,
    const osdtex_texture_part *part, float *pixels, size_t count)
{
    otx_image image;
    size_t wanted;

    OTX_TRY(find_part(run, textures, part, &image));
    wanted =
        (size_t)image.width * (size_t)image.height * (size_t)image.channels;
    if (!pixels || count < wanted)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the texture has %zu values, and there is room for %zu", wanted,
            pixels ? count : 0);
    image.pixels = pixels;
    return bake_part(run, textures, part, &image);
}

osdtex_status
osdtex_textures_read(
    osdtex_context *context, const osdtex_textures *textures,
    const osdtex_texture_part *part, float *pixels, size_t count)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(
        &call, read_part(&call.run, textures, part, pixels, count));
}
