/* companion_files.c -- maps taken out of their image, with levels of their own.
 */
#include "export/companion_files.h"

#include "export/texture_file.h"
#include "file/png_file.h"
#include "file/tiff_write.h"
#include "image/pyramid.h"

static const char STAGE[] = "export";

otx_exr_options
otx_companion_files_options(otx_companion_kind kind)
{
    otx_exr_options options = otx_exr_options_default();

    options.full_float = kind == OTX_COMPANION_HEIGHT;
    options.is_quick = true;
    options.color_space = "Raw";
    options.interop_id = "data";
    return options;
}

/* Of the file of a map. */
static otx_texture_type
type_of(otx_texture_type type, otx_companion_kind kind)
{
    if (type <= OTX_TEXTURE_EXR || type == OTX_TEXTURE_TIFF)
        return type;
    return kind == OTX_COMPANION_HEIGHT ? OTX_TEXTURE_EXR : OTX_TEXTURE_PNG;
}

const char *
otx_companion_files_extension(otx_texture_type type, otx_companion_kind kind)
{
    return otx_texture_file_type_extension(type_of(type, kind));
}

bool
otx_companion_files_is_exr(otx_texture_type type, otx_companion_kind kind)
{
    return type_of(type, kind) <= OTX_TEXTURE_EXR;
}

/* One map by itself. */
static otx_status
take_out(
    otx_run *run, const otx_companions *set, otx_companion_kind kind,
    double width, otx_image *out)
{
    const otx_image *all = &set->image;
    const size_t count = (size_t)all->width * (size_t)all->height;
    const int32_t channels = otx_companion_channels(kind);
    const bool is_height = kind == OTX_COMPANION_HEIGHT;
    const otx_companion_scale scale = otx_companions_scale(set, width);

    OTX_TRY(otx_image_create(
        run, run->scratch, all->width, all->height, channels, out));
    for (size_t i = 0; i < count; ++i)
    {
        const float *from =
            all->pixels + i * (size_t)all->channels + set->maps[kind].first;

        for (int32_t c = 0; c < channels; ++c)
            out->pixels[i * (size_t)channels + (size_t)c] =
                is_height ? (float)((from[c] - scale.middle) * scale.range)
                          : from[c];
    }
    return OSDTEX_OK;
}

otx_status
otx_companion_files_write_integers(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    otx_texture_type type, bool is_height, const otx_image *image)
{
    return type == OTX_TEXTURE_TIFF
               ? otx_tiff_write(run, set, path, image, is_height ? 32 : 16)
               : otx_png_file_write_data(run, set, path, image);
}

static void
encode(otx_image *image, bool y_down)
{
    const size_t count = (size_t)image->width * (size_t)image->height;

    for (size_t i = 0; i < count; ++i)
    {
        float *n = image->pixels + 3 * i;

        n[1] = y_down ? -n[1] : n[1];
        otx_companion_encode_normal(n);
    }
}

/* Levels 0, 1, ... down to one texel. */
static otx_status
make_levels(
    otx_run *run, const otx_exemplar *exemplar, const otx_image *map,
    otx_pyramid *out)
{
    out->count = otx_pyramid_count(map->width, map->height);
    out->levels[0] = *map;
    /* A tiled texture has levels that keep its tiles apart. */
    if (exemplar->tiles.cell > 0)
    {
        const int32_t factor = map->width / exemplar->linear.width;
        otx_tile_layout tiles = exemplar->tiles;

        tiles.cell *= factor;
        tiles.gutter *= factor;
        return otx_tile_layout_levels(
            run, run->scratch, &tiles, map, out->levels + 1);
    }
    return otx_pyramid_build(run, run->scratch, map, out);
}

static otx_status
write_map(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, otx_companion_kind kind, double width)
{
    otx_exr_options options = otx_companion_files_options(kind);
    otx_pyramid levels;
    otx_image map;

    if (!path)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(take_out(run, &exemplar->companions, kind, width, &map));
    OTX_TRY(make_levels(run, exemplar, &map, &levels));
    for (int32_t i = 0; kind == OTX_COMPANION_NORMAL && i < levels.count; ++i)
        encode(&levels.levels[i], exemplar->companions.written_y_down);
    if (!otx_companion_files_is_exr(exemplar->type, kind))
        return otx_companion_files_write_integers(
            run, set, path, exemplar->type, kind == OTX_COMPANION_HEIGHT,
            &levels.levels[0]);
    options.wrap_x = exemplar->tiles.cell == 0 && exemplar->wrap_x;
    options.wrap_y = exemplar->tiles.cell == 0 && exemplar->wrap_y;
    options.levels = levels.levels + 1;
    options.level_count = levels.count - 1;
    return otx_exr_write(run, set, path, &levels.levels[0], &options);
}

otx_status
otx_companion_files_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *exemplar, double width)
{
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        const otx_companion_kind kind = (otx_companion_kind)k;

        if (!exemplar->companions.maps[k].is_there)
            continue;
        OTX_TRY(write_map(
            run, set, otx_companion_files_path(run, path, exemplar->type, kind),
            exemplar, kind, width));
        otx_arena_release(run->scratch, mark);
    }
    return OSDTEX_OK;
}
