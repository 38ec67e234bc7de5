/* texel.c -- what the texels of a baked texture show.
 *
 * Texels on the surface are bake/resolve.h's, those beyond the rims
 * bake/gutter.h's, and numbers bake/aov.h's. Here colours are fitted to
 * how a renderer looks them up: sharpened, and joined across cuts. */
#include "bake/texel.h"

#include "bake/aov.h"
#include "bake/chart_owner.h"
#include "bake/crossfade.h"
#include "bake/gutter.h"
#include "bake/resolve.h"
#include "bake/sample.h"
#include "bake/seam_fit.h"

#include <string.h>

/* Squared distance from a rim of what its texels look at: one from the rim, one
 * from the texels of a lookup on it and one from what sharpens these, the
 * latter two across corners. */
static const float RIM_APRON_SQ = 12.0f;

/* A block, and what its texels show. */
typedef struct picture
{
    otx_block block;
    float *pixels, *sharp; /* of the raster; those that are sharpened */
    float *values;         /* of the raster: of maps besides */
    int32_t *owners;       /* likewise: charts, -1 beyond the rims */
    otx_gutter beyond;
} picture;

static void
resolve(picture *p, int32_t x, int32_t y, float *out)
{
    otx_block *block = &p->block;
    int32_t first;
    const int32_t chart = otx_chart_owner(block, x, y, &first);

    p->owners[otx_block_index(block, x, y)] = chart;
    if (chart < 0)
        otx_gutter_texel(block, x, y, &p->beyond, out);
    else if (otx_texel_is_filtered(block->source->kind))
    {
        otx_resolve_texel(block, x, y, chart, first, out);
        otx_crossfade_inside(block, x, y, first, out);
    }
    else
        otx_aov_inside(block, x, y, first, out);
}

/* A few values, for which memcpy() is a call. */
static inline void
copy(const float *from, size_t count, float *to)
{
    for (size_t i = 0; i < count; ++i)
        to[i] = from[i];
}

static void
shade_texel(picture *p, int32_t x, int32_t y)
{
    const otx_block *block = &p->block;
    const size_t i = otx_block_index(block, x, y);
    const size_t own = (size_t)block->source->channels;
    const size_t maps = (size_t)block->channels - own;
    float out[OTX_SAMPLE_CHANNELS];

    if (maps == 0)
    {
        resolve(p, x, y, p->pixels + i * own);
        return;
    }
    resolve(p, x, y, out);
    copy(out, own, p->pixels + i * own);
    copy(out + own, maps, p->values + i * maps);
}

/* Whether a texel is of the block, or of its apron and looked at: by the
 * texels at the block's border, of which those by a rim look farther. */
static bool
is_needed(const otx_block *block, int32_t x, int32_t y)
{
    const size_t i = otx_block_index(block, x, y);
    const int32_t dx = x - block->apron.left, dy = y - block->apron.below;

    return (dx >= -1 && dx <= block->width && dy >= -1 &&
            dy <= block->height) ||
           (block->near.rim.edges[i] >= 0 &&
            block->near.rim.distance[i] < RIM_APRON_SQ);
}

static void
shade(picture *p)
{
    for (int32_t y = 0; y < p->block.raster.height; ++y)
        for (int32_t x = 0; x < p->block.raster.width; ++x)
            if (is_needed(&p->block, x, y))
                shade_texel(p, x, y);
            else
                p->owners[otx_block_index(&p->block, x, y)] = -1;
}

/* Texels as lookups want them, without the apron. */
static void
fit_to_lookups(const picture *p, float *pixels)
{
    const otx_block *block = &p->block;
    const otx_texel_source *source = block->source;
    const int32_t width = block->raster.width, height = block->raster.height;
    otx_sharpen_grid grid = {
        width, height, source->channels, p->pixels, p->owners};
    const otx_seam_fit fit = {
        .mapping = source->mapping,
        .show = &source->show,
        .textures = source->textures,
        .mip = block->mip,
        .raster = &block->raster,
        .near_rim = &block->near.rim,
        .near_seam = &block->near.seam,
        .grid = &grid,
        .low = source->low,
        .high = source->high,
    };
    otx_seam_fit_edge edge = {.rim = -1};

    otx_sharpen_texels(&grid, 0, 0, width, height, p->sharp);
    grid.pixels = p->sharp;
    for (int32_t y = block->apron.below; y < block->apron.below + block->height;
         ++y)
        for (int32_t x = block->apron.left;
             x < block->apron.left + block->width; ++x)
        {
            otx_seam_fit_texel(&fit, x, y, &edge, pixels);
            pixels += source->channels;
        }
}

static bool
allocate(otx_arena *scratch, picture *p)
{
    const otx_block *block = &p->block;
    const size_t texels =
        (size_t)block->raster.width * (size_t)block->raster.height;
    const size_t values = texels * (size_t)block->source->channels;

    p->owners = OTX_NEW(scratch, int32_t, texels);
    p->pixels = OTX_ZNEW(scratch, float, values);
    p->sharp = OTX_NEW(scratch, float, otx_block_is_fitted(block) ? values : 1);
    p->values =
        block->maps
            ? OTX_ZNEW(scratch, float, texels *(size_t)block->maps->channels)
            : p->pixels;
    return p->owners && p->pixels && p->sharp && p->values;
}

/* Values of a texel that was shaded, each kind into its plane.
 *
 *   at  of the texel in the block without its apron */
static void
hand_out(
    const otx_map_source *maps, float *values, size_t at,
    float *const planes[OTX_COMPANION_COUNT])
{
    otx_map_source_encode(maps, values);
    for (int32_t kind = 0; kind < OTX_COMPANION_COUNT; ++kind)
    {
        const size_t channels =
            (size_t)otx_companion_channels((otx_companion_kind)kind);

        if (maps->first[kind] >= 0)
            copy(
                values + maps->first[kind], channels,
                planes[kind] + at * channels);
    }
}

/* Heights such that both sides of a rim show the same along it. */
static bool
weld_heights(const otx_map_source *maps, const picture *p, otx_arena *scratch)
{
    const otx_block *block = &p->block;
    const int32_t channels = maps->texels.channels;
    const int32_t width = block->raster.width, height = block->raster.height;
    const size_t texels = (size_t)width * (size_t)height;
    float *heights = OTX_NEW(scratch, float, texels);
    float *from = p->values + maps->carry.height;
    const otx_sharpen_grid grid = {width, height, 1, heights, p->owners};
    otx_seam_fit_edge edge = {.rim = -1};
    otx_show_view show = maps->texels.show;
    const otx_seam_fit fit = {
        .mapping = maps->texels.mapping,
        .show = &show,
        .textures = maps->heights,
        .mip = block->mip,
        .raster = &block->raster,
        .near_rim = &block->near.rim,
        .near_seam = &block->near.seam,
        .grid = &grid,
        .welds = true,
    };

    if (!heights)
        return false;
    show.carry = &maps->height_carry;
    for (size_t i = 0; i < texels; ++i)
        heights[i] = from[i * (size_t)channels];
    for (int32_t y = block->apron.below; y < block->apron.below + block->height;
         ++y)
        for (int32_t x = block->apron.left;
             x < block->apron.left + block->width; ++x)
            otx_seam_fit_texel(
                &fit, x, y, &edge,
                from + otx_block_index(block, x, y) * (size_t)channels);
    return true;
}

/* What texels show of maps, into the planes. False when memory is out. */
static bool
finish_maps(
    const otx_map_source *maps, const picture *p, otx_arena *scratch,
    float *const planes[OTX_COMPANION_COUNT])
{
    const otx_block *block = &p->block;

    if (otx_map_source_welds(maps) && !weld_heights(maps, p, scratch))
        return false;
    for (int32_t y = 0; y < block->height; ++y)
        for (int32_t x = 0; x < block->width; ++x)
        {
            const int32_t i = x + block->apron.left, j = y + block->apron.below;

            hand_out(
                maps,
                p->values + otx_block_index(block, i, j) *
                                (size_t)maps->texels.channels,
                (size_t)y * (size_t)block->width + (size_t)x, planes);
        }
    return true;
}

/* Texels as they are, without the apron. */
static void
copy_inside(const picture *p, float *pixels)
{
    const otx_block *block = &p->block;
    const size_t channels = (size_t)block->source->channels;
    const size_t row = (size_t)block->width * channels;

    for (int32_t y = 0; y < block->height; ++y)
        memcpy(
            pixels + (size_t)y * row,
            p->pixels + otx_block_index(
                            block, block->apron.left, y + block->apron.below) *
                            channels,
            row * sizeof *pixels);
}

bool
otx_texel_bake_maps(
    const otx_map_source *maps, const otx_mip *mip, int32_t x, int32_t y,
    otx_arena *scratch, float *const planes[OTX_COMPANION_COUNT])
{
    picture p = {.beyond = otx_gutter_begin()};

    if (!otx_block_draw(&maps->texels, NULL, mip, x, y, scratch, &p.block) ||
        !allocate(scratch, &p))
        return false;
    shade(&p);
    return finish_maps(maps, &p, scratch, planes);
}

bool
otx_texel_bake(
    const otx_texel_source *source, const otx_map_source *maps,
    const otx_mip *mip, int32_t x, int32_t y, otx_arena *scratch, float *pixels,
    float *const planes[OTX_COMPANION_COUNT])
{
    picture p = {.beyond = otx_gutter_begin()};

    if (!otx_block_draw(
            source, maps ? &maps->texels : NULL, mip, x, y, scratch,
            &p.block) ||
        !allocate(scratch, &p))
        return false;
    shade(&p);
    if (otx_block_is_fitted(&p.block))
        fit_to_lookups(&p, pixels);
    else
        copy_inside(&p, pixels);
    return !maps || finish_maps(maps, &p, scratch, planes);
}
