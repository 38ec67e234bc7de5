/* crossfade.c -- patches blended where they meet, where that is asked for. */
#include "bake/crossfade.h"

#include "bake/sample.h"

/* What the patch on the other side of a seam would show at a texel, had it
 * gone on; false where the texel is of neither patch.
 *
 *   patch  of the texel
 */
static bool
color_across(
    otx_block *block, const otx_mip_rim *seam, int32_t patch, otx_vec2 at,
    float *color)
{
    const otx_layout *layout = block->source->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t *patches = block->source->mapping->face_patch;
    const int32_t other = otx_level_neighbour(leaf, seam->face, seam->edge);
    otx_walk walk = otx_mip_facet_place(otx_block_rim_piece(block, seam), at);

    if (patch == patches[seam->face])
    {
        const int32_t side = otx_facet_side(&walk.facet, seam->edge);

        if (!otx_walk_cross(layout->surface, layout->covered, side, &walk))
            return false;
    }
    else if (patch != patches[other])
        return false;
    otx_sample_walk(block, &walk, 1.0, color);
    return true;
}

/* Mixes a texel with what is across a seam `distance_sq` away. */
static void
mix(otx_block *block, const otx_mip_rim *seam, double distance_sq,
    int32_t patch, otx_vec2 at, float *color)
{
    const double t = 0.5 * (1.0 - sqrt(distance_sq) / block->mip->blend);
    float across[OTX_SAMPLE_CHANNELS];

    if (!(t > 0.0) || !color_across(block, seam, patch, at, across))
        return;
    for (int32_t c = 0; c < block->channels; ++c)
        color[c] = (float)((1.0 - t) * color[c] + t * across[c]);
}

void
otx_crossfade_inside(
    otx_block *block, int32_t x, int32_t y, int32_t first, float *color)
{
    const size_t i = otx_block_index(block, x, y);
    const int32_t seam = block->near.seam.edges[i];

    if (seam < 0)
        return;

    const int32_t face =
        otx_mip_facet_face(otx_block_sample(block, x, y, first));

    mix(block, &block->mip->seams[seam], block->near.seam.distance[i],
        block->source->mapping->face_patch[face],
        otx_raster_texel(&block->raster, x, y), color);
}

void
otx_crossfade_beyond(otx_block *block, int32_t x, int32_t y, float *color)
{
    const size_t i = otx_block_index(block, x, y);
    const otx_layout *layout = block->source->layout;
    const int32_t *patches = block->source->mapping->face_patch;
    const otx_mip_rim *rim = &block->mip->rims[block->near.rim.edges[i]];

    if (block->mip->seam_count == 0 || !otx_mip_is_seam(layout, patches, rim))
        return;

    const int32_t other = otx_layout_across(layout, rim->face, rim->edge);

    mix(block, rim, block->near.rim.distance[i], patches[other],
        otx_raster_texel(&block->raster, x, y), color);
}
