/* atlas.h -- a block of texture for every face of the cage.
 *
 * Blocks are as large as their faces are on the limit surface (extent.h), and
 * packed in shelves; what does not fit goes to further UDIM tiles. The sides
 * of a cell (a block and its margins) are multiples of twice the margin and so
 * is its place, so that texels of the first mip levels never straddle two
 * cells. */
#ifndef OTX_BAKE_ATLAS_H
#define OTX_BAKE_ATLAS_H

#include "surface/surface.h"

enum
{
    OTX_ATLAS_MARGIN_MIN = 4,
    OTX_ATLAS_MARGIN_MAX = 64
};

typedef struct otx_atlas_options
{
    int32_t side;   /* texels of a tile */
    int32_t margin; /* texels around a block, a power of two; 0: the largest
                     * up to 16 that costs no more than half of the texture */
    double texels_per_unit; /* texels per scene unit, 0: what fills one tile */
} otx_atlas_options;

typedef struct otx_atlas
{
    /* [cage corner_count * 2] of the corners, or where corner_index is given
     * [uv_count * 2], and corner_uvs those of the corners. */
    float *uvs;
    int32_t uv_count;
    const int32_t *corner_index; /* [cage corner_count] of charts; NULL */
    const float *corner_uvs;     /* [cage corner_count * 2] of charts; NULL */
    int32_t margin;
    double texels_per_unit; /* as asked or found; blocks are rounded up from
                               there */
    int32_t tile_count;
} otx_atlas;

/* Refuses margins and sides that no atlas has. ARGUMENT. */
otx_status otx_atlas_check(otx_run *run, const otx_atlas_options *options);

/* Refuses more tiles than UDIM numbers. LIMIT. */
otx_status otx_atlas_check_tiles(otx_run *run, const otx_atlas *atlas);

/* Says what an atlas has come to. */
void otx_atlas_tell(otx_run *run, const otx_atlas *atlas);

/* Holes get a block too: they may be closed later. ARGUMENT, LIMIT when the
 * blocks do not fit 9999 - 1001 tiles, MEMORY. Made in run->arena. */
otx_status otx_atlas_pack(
    otx_run *run, const otx_surface *surface, const otx_atlas_options *options,
    otx_atlas *out);

#endif
