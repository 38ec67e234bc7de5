/* udim.h -- the tiles of an asset's UV plane, by number.
 *
 * Tile 1001 + u + 10 v holds [u, u + 1] x [v, v + 1]: ten in a row, rows
 * upwards without end but for the four digits. */
#ifndef OTX_IMAGE_UDIM_H
#define OTX_IMAGE_UDIM_H

#include <stdint.h>

enum
{
    OTX_UDIM_FIRST = 1001,
    OTX_UDIM_LAST = 9999,
    OTX_UDIM_COLUMNS = 10,
    OTX_UDIM_ROWS = 900 /* of which the last lacks its last place, 10000 */
};

/* How far a face may reach over the border of a tile and still not be in the
 * next: rounding of UVs that are meant to end there. */
#define OTX_UDIM_OVER 1e-5

/* Column and row of a tile, which is its lower left corner in UV. */
static inline int32_t
otx_udim_column(int32_t tile)
{
    return (tile - OTX_UDIM_FIRST) % OTX_UDIM_COLUMNS;
}

static inline int32_t
otx_udim_row(int32_t tile)
{
    return (tile - OTX_UDIM_FIRST) / OTX_UDIM_COLUMNS;
}

static inline int32_t
otx_udim_tile(int32_t column, int32_t row)
{
    return OTX_UDIM_FIRST + OTX_UDIM_COLUMNS * row + column;
}

#endif
