/* quilt.h -- pictures sewn together along seams that hardly show.
 *
 * Several *sheets* lie over one another; every texel of the result shows one
 * of them. Where two neighbours p, q show different sheets a, b there is a
 * seam, and it costs, after [Kwatra03, eq. 1] but squared,
 *
 *     |a(p) - b(p)|^2 + |a(q) - b(q)|^2
 *
 * in the distances of the pool. `otx_quilt_expand` finds the best set of
 * texels to give to one sheet, by a minimum cut (an expansion move [Boykov01]).
 * The first picture over an empty one, an image cut of [Efros01], a corner, the
 * ends of a strip and the inside of a tile are all this one move.
 *
 * [Boykov01] Boykov, Veksler, Zabih: Fast approximate energy minimization via
 * graph cuts. PAMI 23.
 * [Kwatra03] Kwatra, Schoedl, Essa, Turk, Bobick: Graphcut textures. */
#ifndef OTX_QUILT_QUILT_H
#define OTX_QUILT_QUILT_H

#include "quilt/texel_pool.h"

enum
{
    OTX_QUILT_MAX_SHEETS = 255,
    OTX_QUILT_FREE = 255
};

/* A picture at a place of the quilt; outside of it there is nothing. */
typedef struct otx_quilt_sheet
{
    int32_t x, y; /* lower left texel */
    otx_texel_map map;
} otx_quilt_sheet;

typedef struct otx_quilt
{
    const otx_texel_pool *pool;
    int32_t width, height;
    int32_t sheet_count;
    otx_quilt_sheet sheets[OTX_QUILT_MAX_SHEETS];
    uint8_t *labels; /* [height * width] the sheet that shows */
    uint8_t *locks;  /* [height * width] the sheet that must, or
                      * OTX_QUILT_FREE */
    int64_t cost;    /* of all seams */
} otx_quilt;

/* What the seams of a quilt are like. */
typedef struct otx_quilt_seams
{
    int64_t length; /* pairs of neighbours with a seam between them */
    double mean;    /* Lab distance of the sheets along them */
} otx_quilt_seams;

/* An empty quilt in `arena`: no sheets, all free, labels 0. */
otx_status otx_quilt_create(
    otx_run *run, otx_arena *arena, const otx_texel_pool *pool, int32_t width,
    int32_t height, otx_quilt *out);

/* Adds a sheet with its lower left texel at (x, y), whose texels the quilt
 * borrows, and returns its number, -1 when there are too many. It must lie
 * within the quilt, and may have holes (OTX_TEXEL_NONE). */
int32_t
otx_quilt_add(otx_quilt *quilt, int32_t x, int32_t y, otx_texel_map map);

/* Takes off the sheet that was added last, which must not show. */
static inline void
otx_quilt_drop(otx_quilt *quilt)
{
    --quilt->sheet_count;
}

/* Shows `sheet` wherever it may be, regardless of seams. */
void otx_quilt_fill(otx_quilt *quilt, int32_t sheet);

/* Gives `sheet` the texels that make the seams cheapest, and the others stay
 * as they are. The cost never rises. */
otx_status otx_quilt_expand(otx_run *run, otx_quilt *quilt, int32_t sheet);

/* Expands every sheet, then those that show until a round brings nothing, at
 * most `rounds` rounds in all. quilt->cost is known. */
otx_status otx_quilt_settle(otx_run *run, otx_quilt *quilt, int32_t rounds);

/* Computes quilt->cost from the labels. */
void otx_quilt_price(otx_quilt *quilt);

/* What the seams cost between each texel and those to its right and above.
 *
 *   out  [height * width] */
void otx_quilt_map_cost(const otx_quilt *quilt, int64_t *out);

otx_quilt_seams otx_quilt_measure(const otx_quilt *quilt);

/* What a sheet has at (x, y) of the quilt. */
static inline int32_t
otx_quilt_sheet_texel(const otx_quilt_sheet *sheet, int32_t x, int32_t y)
{
    const int32_t i = x - sheet->x, j = y - sheet->y;

    if (i < 0 || j < 0 || i >= sheet->map.width || j >= sheet->map.height)
        return OTX_TEXEL_NONE;
    return otx_texel_map_at(&sheet->map, i, j);
}

static inline size_t
otx_quilt_at(const otx_quilt *quilt, int32_t x, int32_t y)
{
    return (size_t)y * (size_t)quilt->width + (size_t)x;
}

/* The texel that shows. */
static inline int32_t
otx_quilt_texel(const otx_quilt *quilt, int32_t x, int32_t y)
{
    return otx_quilt_sheet_texel(
        &quilt->sheets[quilt->labels[otx_quilt_at(quilt, x, y)]], x, y);
}

#endif
