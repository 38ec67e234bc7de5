/* chart_pack.h -- charts side by side on tiles.
 *
 * A packer of our own: charts are set down one after the other, the largest
 * first, each as a mask of cells in the eighth of a turn and at the lowest
 * place in which no cell is taken, so that small ones fill the holes that large
 * ones leave. It needs no library, and is deterministic. */
#ifndef OTX_BAKE_CHART_PACK_H
#define OTX_BAKE_CHART_PACK_H

#include "base/run.h"
#include "math/vec.h"

/* Rims of the charts: all that a packer looks at. */
typedef struct otx_chart_rims
{
    int32_t chart_count;
    const int32_t *first; /* [chart_count + 1] offsets into ends, in edges */
    const otx_vec2 *ends; /* [2 * edges] scene units */
} otx_chart_rims;

/* Where a chart lies: texels = scale * turned by `turn` + shift. */
typedef struct otx_chart_place
{
    otx_vec2 turn; /* unit: cosine and sine */
    otx_vec2 shift;
    int32_t tile;
} otx_chart_place;

typedef struct otx_chart_packing
{
    int32_t tile_count;
    double scale;            /* texels per scene unit */
    otx_chart_place *places; /* [chart_count] */
} otx_chart_packing;

/* Packs charts that keep `margin` texels, a multiple of four, around each.
 *
 *   side   texels of a tile's side
 *   scale  texels per scene unit; 0: the most that fill one tile
 *
 * LIMIT where they are too many for a tile, or one is too large for it; MEMORY,
 * CANCELLED. In run->arena. */
otx_status otx_chart_pack(
    otx_run *run, const otx_chart_rims *rims, int32_t side, int32_t margin,
    double scale, otx_chart_packing *out);

#endif
