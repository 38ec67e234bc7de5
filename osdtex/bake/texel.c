/* texel.c -- what the texels of a baked texture show.
 *
 * Texels on the surface are bake/resolve.h's, those beyond the rims
 * bake/gutter.h's, and numbers bake/aov.h's. Here colours are fitted to
 * how a renderer looks them up: sharpened, and joined across cuts. */
#include "bake/texel.h"

#include "bake/aov.h"
#include "bake/crossfade.h"
#include "bake/gutter.h"
#include "bake/resolve.h"
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
    int32_t *owners;       /* likewise: charts, -1 beyond the rims */
    otx_gutter beyond;
} picture;

static void
shade_texel(picture *p, int32_t x, int32_t y)
{
    otx_block *block = &p->block;
    const size_t i = otx_block_index(block, x, y);
    float *out = p->pixels + i * (size_t)block->source->channels;
    int32_t first;
    const int32_t chart = otx_resolve_owner(block, x, y, &first);

    p->owners[i] = chart;
    if (chart < 0)
        otx_gutter_texel(block, x, y, &p->beyond, out);
    else if (otx_texel_is_filtered(block->source->kind))
    {
        otx_resolve_color(block, x, y, chart, first, out);
        otx_crossfade_inside(block, x, y, first, out);
    }
    else
        otx_aov_inside(block, x, y, first, out);
}

/* Whether a texel is of the block, or of its apron and looked at: by the
 * texels at the block's border, of which those by a rim look farther. */
static bool
is_needed(const otx_block *block, int32_t x, int32_t y)
{
    const size_t i = otx_block_index(block, x, y);
    const int32_t dx = x - block->left, dy = y - block->below;

    return (dx >= -1 && dx <= block->width && dy >= -1 &&
            dy <= block->height) ||
           (block->near_rim.edges[i] >= 0 &&
            block->near_rim.distance[i] < RIM_APRON_SQ);
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
        .near_rim = &block->near_rim,
        .near_seam = &block->near_seam,
        .grid = &grid,
        .low = source->low,
        .high = source->high,
    };
    otx_seam_fit_edge edge = {.rim = -1};

    otx_sharpen_texels(&grid, 0, 0, width, height, p->sharp);
    grid.pixels = p->sharp;
    for (int32_t y = block->below; y < block->below + block->height; ++y)
        for (int32_t x = block->left; x < block->left + block->width; ++x)
        {
            otx_seam_fit_texel(&fit, x, y, &edge, pixels);
            pixels += source->channels;
        }
}

static bool
allocate(otx_arena *scratch, picture *p)
{
    const size_t texels =
        (size_t)p->block.raster.width * (size_t)p->block.raster.height;
    const size_t values = texels * (size_t)p->block.source->channels;

    p->owners = OTX_NEW(scratch, int32_t, texels);
    p->pixels = OTX_ZNEW(scratch, float, values);
    p->sharp = OTX_NEW(scratch, float, values);
    return p->owners && p->pixels && p->sharp;
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
            memcpy(
                planes[kind] + at * channels, values + maps->first[kind],
                channels * sizeof *values);
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
    float *from = p->pixels + maps->carry.height;
    const otx_sharpen_grid grid = {width, height, 1, heights, p->owners};
    otx_seam_fit_edge edge = {.rim = -1};
    otx_show_view show = maps->texels.show;
    const otx_seam_fit fit = {
        .mapping = maps->texels.mapping,
        .show = &show,
        .textures = maps->heights,
        .mip = block->mip,
        .raster = &block->raster,
        .near_rim = &block->near_rim,
        .near_seam = &block->near_seam,
        .grid = &grid,
        .welds = true,
    };

    if (!heights)
        return false;
    show.carry = &maps->height_carry;
    for (size_t i = 0; i < texels; ++i)
        heights[i] = from[i * (size_t)channels];
    for (int32_t y = block->below; y < block->below + block->height; ++y)
        for (int32_t x = block->left; x < block->left + block->width; ++x)
            otx_seam_fit_texel(
                &fit, x, y, &edge,
                from + otx_block_index(block, x, y) * (size_t)channels);
    return true;
}

/* What the maps are baked from: the block as it is drawn, or where their rims
 * are fitted and its are not, with what is around it. */
static bool
prepare_maps(
    const otx_map_source *maps, const otx_block *drawn, int32_t x, int32_t y,
    otx_arena *scratch, otx_block *out)
{
    if (otx_map_source_welds(maps) && !otx_block_is_fitted(drawn))
        return otx_block_draw(&maps->texels, drawn->mip, x, y, scratch, out);
    *out = *drawn;
    out->source = &maps->texels;
    return otx_block_forget(out, scratch);
}

/* The maps of a block whose faces are drawn. */
static bool
shade_maps(
    const otx_map_source *maps, picture *pic, otx_arena *scratch,
    float *const planes[OTX_COMPANION_COUNT])
{
    const otx_block *block = &pic->block;

    if (!allocate(scratch, pic))
        return false;
    shade(pic);
    if (otx_map_source_welds(maps) && !weld_heights(maps, pic, scratch))
        return false;
    for (int32_t y = 0; y < block->height; ++y)
        for (int32_t x = 0; x < block->width; ++x)
        {
            const int32_t i = x + block->left, j = y + block->below;

            hand_out(
                maps,
                pic->pixels + otx_block_index(block, i, j) *
                                  (size_t)maps->texels.channels,
                (size_t)y * (size_t)block->width + (size_t)x, planes);
        }
    return true;
}

/* The maps of a block that is drawn for the colour: what lies under the samples
 * is the same. */
static bool
bake_maps(
    const otx_map_source *maps, const otx_block *drawn, int32_t column,
    int32_t row, otx_arena *scratch, float *const planes[OTX_COMPANION_COUNT])
{
    picture p = {.beyond = otx_gutter_begin()};

    return prepare_maps(maps, drawn, column, row, scratch, &p.block) &&
           shade_maps(maps, &p, scratch, planes);
}

bool
otx_texel_bake_maps(
    const otx_map_source *maps, const otx_mip *mip, int32_t x, int32_t y,
    otx_arena *scratch, float *const planes[OTX_COMPANION_COUNT])
{
    picture p = {.beyond = otx_gutter_begin()};

    return otx_block_draw(&maps->texels, mip, x, y, scratch, &p.block) &&
           shade_maps(maps, &p, scratch, planes);
}

bool
otx_texel_bake(
    const otx_texel_source *source, const otx_map_source *maps,
    const otx_mip *mip, int32_t x, int32_t y, otx_arena *scratch, float *pixels,
    float *const planes[OTX_COMPANION_COUNT])
{
    picture p = {.beyond = otx_gutter_begin()};

    if (!otx_block_draw(source, mip, x, y, scratch, &p.block) ||
        !allocate(scratch, &p))
        return false;
    shade(&p);
    /* Only texels that are fitted have an apron. */
    if (otx_block_is_fitted(&p.block))
        fit_to_lookups(&p, pixels);
    else
        memcpy(
            pixels, p.pixels,
            (size_t)p.block.width * (size_t)p.block.height *
                (size_t)source->channels * sizeof *pixels);
    return !maps || bake_maps(maps, &p.block, x, y, scratch, planes);
}
