/* layout.h -- where on a texture every leaf face is.
 *
 * Either the cage's own UVs, carried to the leaves by the face-varying rule
 * that the surface was refined with, or an atlas made here, which goes with
 * the rule "linear all". Tiles are UDIM's (image/udim.h).
 */
#ifndef OTX_BAKE_LAYOUT_H
#define OTX_BAKE_LAYOUT_H

#include "bake/uv_choice.h"
#include "mapping/mapping.h"

typedef struct otx_layout_options
{
    otx_layout_source source;
    int32_t side;           /* texels of a tile, up to OTX_IMAGE_MAX_SIDE */
    int32_t margin;         /* see atlas.h; 0 chooses */
    double texels_per_unit; /* texels per scene unit; see atlas.h */
} otx_layout_options;

typedef struct otx_layout
{
    const otx_surface *surface;
    bool is_atlas;  /* made here, to go with the rule "linear all" */
    bool is_charts; /* of charts (charts.h), not of blocks */
    /* Of the cage, as the artist's file carries them. */
    int32_t uv_count;
    const float *uvs;        /* [uv_count * 2] */
    const int32_t *face_uvs; /* [cage corner_count] */

    const float *leaf_uvs;  /* [leaf corner_count * 2] */
    const uint8_t *covered; /* [leaf face_count] 1: has a texture and a place */
    /* Parts that hang together on the texture, numbered by their first face;
     * -1 on faces that are not covered. */
    const int32_t *chart; /* [leaf face_count] */
    /* 1 where the edge from a corner to the next is the rim of a chart. */
    const uint8_t *rim; /* [leaf corner_count] */

    int32_t side;
    int32_t margin; /* texels that are continued beyond a rim, at level 0 */
    int32_t tile_count;
    const int32_t *tiles;      /* [tile_count] UDIM numbers, ascending */
    const int32_t *tile_first; /* [tile_count + 1] */
    const int32_t
        *tile_faces; /* leaf faces that reach into a tile, ascending */
} otx_layout;

/* Lays out what `mapping` covers; lives in run->arena and borrows the mapping's
 * surface.
 *
 * ARGUMENT (options out of range, own UVs asked for and not there), TOPOLOGY
 * when nothing is covered or own UVs are asked for that cannot be baked onto
 * (uv_choice.h), LIMIT, MEMORY, CANCELLED. */
otx_status otx_layout_build(
    otx_run *run, const otx_mapping *mapping, const otx_layout_options *options,
    otx_layout *out);

/* The index of the tile with a UDIM number. ARGUMENT, naming those that there
 * are, when it has none. */
otx_status otx_layout_find_tile(
    otx_run *run, const otx_layout *layout, int32_t udim, int32_t *tile);

/* The face across edge k of a face, where it has a texture, too; -1 none. */
static inline int32_t
otx_layout_across(const otx_layout *layout, int32_t face, int32_t k)
{
    const int32_t other =
        otx_level_neighbour(otx_surface_leaf(layout->surface), face, k);

    return other >= 0 && layout->covered[other] ? other : -1;
}

#endif
