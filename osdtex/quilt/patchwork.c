/* patchwork.c -- the worst spot, patches for it, and so on. */
#include "quilt/patchwork.h"

#include <stdlib.h>
#include <string.h>

enum
{
    STRIDE = 2, /* texels between spots */
    NEARBY = 4, /* a spot that could not be mended is left alone so far */
    PATCHES = 8 /* offered at a spot, at most */
};

static const char STAGE[] = "tiles";

/* Spots are boxes of a patch's size, named by their lower left texel. */
typedef struct board
{
    const otx_patch_search *search;
    otx_quilt *quilt;
    int64_t *costs;    /* [height * width], see otx_quilt_map_cost */
    int64_t *sums;     /* [(height + 1) * (width + 1)] of those below, left */
    uint8_t *given_up; /* [height * width] */
} board;

static otx_status
open_board(otx_run *run, board *b)
{
    const size_t width = (size_t)b->quilt->width;
    const size_t height = (size_t)b->quilt->height;

    b->costs = OTX_NEW(run->scratch, int64_t, width * height);
    b->sums = OTX_ZNEW(run->scratch, int64_t, (width + 1) * (height + 1));
    b->given_up = OTX_ZNEW(run->scratch, uint8_t, width * height);
    return b->costs && b->sums && b->given_up ? OSDTEX_OK
                                              : otx_fail_memory(run, STAGE);
}

static void
add_up(board *b)
{
    const size_t width = (size_t)b->quilt->width;
    const size_t height = (size_t)b->quilt->height;

    otx_quilt_map_cost(b->quilt, b->costs);
    for (size_t y = 0; y < height; ++y)
    {
        const int64_t *below = b->sums + y * (width + 1);
        int64_t *sums = b->sums + (y + 1) * (width + 1), row = 0;

        for (size_t x = 0; x < width; ++x)
        {
            row += b->costs[y * width + x];
            sums[x + 1] = below[x + 1] + row;
        }
    }
}

static int64_t
cost_of(const board *b, int32_t x, int32_t y)
{
    const size_t row = (size_t)b->quilt->width + 1;
    const size_t size = (size_t)b->search->size;
    const int64_t *low = b->sums + (size_t)y * row + (size_t)x;
    const int64_t *high = low + size * row;

    return high[size] - high[0] - low[size] + low[0];
}

/* The costliest spot; false when none is left that costs anything. */
static bool
find_worst(const board *b, int32_t *out_x, int32_t *out_y)
{
    const int32_t size = b->search->size;
    int64_t worst = 0;

    for (int32_t y = 0; y <= b->quilt->height - size; y += STRIDE)
        for (int32_t x = 0; x <= b->quilt->width - size; x += STRIDE)
        {
            const int64_t cost = cost_of(b, x, y);

            if (cost <= worst || b->given_up[otx_quilt_at(b->quilt, x, y)])
                continue;
            worst = cost;
            *out_x = x;
            *out_y = y;
        }
    return worst > 0;
}

/* Sets `given_up` for the spots within `reach` of (x, y). */
static void
mark(board *b, int32_t x, int32_t y, int32_t reach, bool given_up)
{
    for (int32_t j = y - reach; j <= y + reach; ++j)
        for (int32_t i = x - reach; i <= x + reach; ++i)
            if (i >= 0 && j >= 0 && i < b->quilt->width && j < b->quilt->height)
                b->given_up[otx_quilt_at(b->quilt, i, j)] = given_up;
}

/* Offers one window at a spot. A sheet that nobody wants is taken off again. */
static otx_status
offer(otx_run *run, board *b, otx_texel_window window, int32_t x, int32_t y)
{
    const int32_t size = b->search->size;
    const int64_t before = b->quilt->cost;
    otx_texel_map map;
    int32_t sheet;

    OTX_TRY(otx_texel_map_create(run, run->arena, size, size, &map));
    otx_texel_pool_lay(b->search->pool, window, &map);
    sheet = otx_quilt_add(b->quilt, x, y, map);
    if (sheet < 0)
        return OSDTEX_OK;
    OTX_TRY(otx_quilt_expand(run, b->quilt, sheet));
    if (b->quilt->cost == before)
        otx_quilt_drop(b->quilt);
    return OSDTEX_OK;
}

static otx_status
mend_spot(
    otx_run *run, board *b, const otx_texel_map *picture, int32_t patches,
    int32_t x, int32_t y)
{
    const int32_t size = b->search->size;
    const int64_t before = b->quilt->cost;
    otx_texel_window windows[PATCHES];
    int32_t count, *texel = picture->texels;

    for (int32_t j = y; j < y + size; ++j)
        for (int32_t i = x; i < x + size; ++i)
            *texel++ = otx_quilt_texel(b->quilt, i, j);
    count = otx_patch_search_find(
        b->search, picture, patches < PATCHES ? patches : PATCHES, windows);
    for (int32_t i = 0; i < count; ++i)
        OTX_TRY(offer(run, b, windows[i], x, y));
    if (b->quilt->cost < before)
        mark(b, x, y, size, false);
    else
        mark(b, x, y, NEARBY, true);
    return OSDTEX_OK;
}

otx_status
otx_patchwork_mend(
    otx_run *run, const otx_patch_search *search,
    const otx_patchwork_options *options, otx_quilt *quilt)
{
    board b = {.search = search, .quilt = quilt};
    otx_texel_map picture;
    int32_t x = 0, y = 0;

    if (search->size > quilt->width || search->size > quilt->height)
        return OSDTEX_OK;
    OTX_TRY(open_board(run, &b));
    OTX_TRY(otx_texel_map_create(
        run, run->scratch, search->size, search->size, &picture));
    for (int32_t i = 0; i < options->spots; ++i)
    {
        add_up(&b);
        if (quilt->sheet_count + options->patches > OTX_QUILT_MAX_SHEETS ||
            !find_worst(&b, &x, &y))
            break;
        OTX_TRY(mend_spot(run, &b, &picture, options->patches, x, y));
    }
    return OSDTEX_OK;
}
