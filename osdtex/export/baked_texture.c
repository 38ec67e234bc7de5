/* baked_texture.c -- one texture for a mapping that no single UV a corner can
 * stand for. */
#include "export/baked_texture.h"

#include "bake/bake.h"
#include "export/companion_files.h"
#include "export/texture_stream.h"

#include <string.h>

static const char STAGE[] = "export";

enum
{
    SIDE_LEAST = 512,
    SIDE_MOST = 8192
};

static const double FILLED = 0.7; /* of an atlas by its faces, about */

bool
otx_baked_texture_is_needed(const otx_mapping *mapping)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    return mapping->along || mapping->decals ||
           (mapping->lookups &&
            mapping->lookups->layering == OTX_LAYERING_OVER) ||
           (mapping->field &&
            otx_source_field_is_whole(
                mapping->field, leaf->face_hole, leaf->face_count));
}

int32_t
otx_baked_texture_side(
    const otx_mapping *mapping, const otx_exemplar *exemplars)
{
    const double needed = exemplars->linear.width / mapping->scale *
                          sqrt(mapping->surface->area / FILLED);
    int32_t side = SIDE_LEAST;

    while (side < needed && side < SIDE_MOST)
        side *= 2;
    return side;
}

otx_status
otx_baked_texture_lay_out(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    int32_t side, otx_layout *out)
{
    const otx_layout_options options = {
        .source = OTX_LAYOUT_ATLAS,
        .side = side ? side : otx_baked_texture_side(mapping, exemplars)};

    OTX_TRY(otx_layout_build(run, mapping, &options, out));
    if (out->tile_count > 1)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "the atlas of the mesh takes %d pictures of %d texels, and there "
            "is one texture; raise {resolution} or lower {level}",
            (int)out->tile_count, (int)options.side);
    return OSDTEX_OK;
}

static void
take(void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    otx_texture_stream_take(user, slot, lane, block);
}

static otx_status
put(void *user, int32_t slot, int32_t level, int32_t x, int32_t y)
{
    return otx_texture_stream_put(user, slot, level, x, y);
}

/* The blocks of a bake, or of one of its maps, as a file: an EXR by `options`,
 * where that is not NULL. */
static otx_status
write_file(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, const otx_exr_options *options,
    const otx_bake *bake, int32_t map)
{
    const int32_t channels =
        map < 0 ? bake->source.channels
                : otx_companion_channels((otx_companion_kind)map);
    otx_texture_stream *stream = OTX_ZNEW(run->scratch, otx_texture_stream, 1);
    const otx_bake_sink sink = {
        .take = take,
        .put = put,
        .user = stream,
        .level_count = options ? 0 : 1,
        .share = 1.0};

    OTX_TRY(otx_texture_stream_begin(
        run, set, path, bake, channels, map, options, stream));
    OTX_TRY(otx_bake_tile(run, bake, 0, &sink));
    return otx_texture_stream_end(run, set, exemplar, stream);
}

static otx_exr_options
color_options(const otx_exemplar *exemplar)
{
    otx_exr_options options = otx_exr_options_default();

    options.has_chromaticities = exemplar->has_chromaticities;
    memcpy(
        options.chromaticities, exemplar->chromaticities,
        sizeof options.chromaticities);
    options.color_space = exemplar->linear_space;
    options.interop_id = exemplar->interop_id;
    return options;
}

/* The map of a kind, where an exemplar has it. */
static otx_status
write_map(
    otx_run *run, otx_atomic_file_set *set, const char *color,
    const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, otx_companion_kind kind)
{
    const otx_exr_options file = otx_companion_files_options(kind);
    const otx_bake_options options = {
        .kind = OTX_TEXEL_COLOR,
        .maps = 1u << kind,
        .maps_alone = true,
        .normals_y_down = exemplars->companions.written_y_down};
    const char *path =
        otx_companion_files_path(run, color, exemplars->type, kind);
    const bool is_exr = otx_companion_files_is_exr(exemplars->type, kind);
    otx_bake bake;

    if (!path)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(otx_bake_create(run, mapping, exemplars, layout, &options, &bake));
    return bake.maps.texels.channels > 0
               ? write_file(
                     run, set, path, exemplars, is_exr ? &file : NULL, &bake,
                     (int32_t)kind)
               : OSDTEX_OK;
}

otx_status
otx_baked_texture_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout)
{
    const otx_exr_options file = color_options(exemplars);
    const otx_bake_options options = {.kind = OTX_TEXEL_COLOR};
    otx_bake bake;

    OTX_TRY(otx_bake_create(run, mapping, exemplars, layout, &options, &bake));
    OTX_TRY(write_file(
        run, set, path, exemplars,
        exemplars->type > OTX_TEXTURE_EXR ? NULL : &file, &bake, -1));
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        OTX_TRY(write_map(
            run, set, path, mapping, exemplars, layout, (otx_companion_kind)k));
    return OSDTEX_OK;
}
