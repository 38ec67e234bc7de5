/* patch_search.c -- descriptions by cosines, the nearest of them, and the exact
 * place. */
#include "quilt/patch_search.h"

#include <math.h>
#include <string.h>

enum
{
    GRID = 8,  /* cells on a patch's side */
    STEP = 2,  /* texels between described places */
    LIGHT = 4, /* frequencies of L: those with k + l < LIGHT */
    HUE = 2,   /* of a and b */
    NUMBERS = LIGHT * (LIGHT + 1) / 2 + HUE * (HUE + 1), /* of a description */
    LANES = 16, /* places that are compared together ... */
    PART = 4,   /* ... by so many numbers, before they may be given up */
    SHORTLIST = 16,
    OWN_SHARE = 4 /* a place is left out of which one texel in 4 is there */
};

/* Orthonormal cosines of GRID samples. */
static const float COSINES[LIGHT][GRID] = {
    {0.353553391f, 0.353553391f, 0.353553391f, 0.353553391f, 0.353553391f,
     0.353553391f, 0.353553391f, 0.353553391f},
    {0.490392640f, 0.415734806f, 0.277785117f, 0.097545161f, -0.097545161f,
     -0.277785117f, -0.415734806f, -0.490392640f},
    {0.461939766f, 0.191341716f, -0.191341716f, -0.461939766f, -0.461939766f,
     -0.191341716f, 0.191341716f, 0.461939766f},
    {0.415734806f, -0.097545161f, -0.490392640f, -0.277785117f, 0.277785117f,
     0.490392640f, 0.097545161f, -0.415734806f},
};

/* Means over the cells of a patch, each channel apart. */
typedef struct cells
{
    float values[3][GRID][GRID];
} cells;

/* Low frequencies of one channel; returns how many. */
static int32_t
transform(const float in[GRID][GRID], int32_t order, float *out)
{
    float rows[LIGHT][GRID];
    int32_t count = 0;

    for (int32_t k = 0; k < order; ++k)
        for (int32_t y = 0; y < GRID; ++y)
        {
            rows[k][y] = 0.0f;
            for (int32_t x = 0; x < GRID; ++x)
                rows[k][y] += COSINES[k][x] * in[y][x];
        }
    for (int32_t k = 0; k < order; ++k)
        for (int32_t l = 0; k + l < order; ++l, ++count)
        {
            out[count] = 0.0f;
            for (int32_t y = 0; y < GRID; ++y)
                out[count] += COSINES[l][y] * rows[k][y];
        }
    return count;
}

static void
describe(const cells *in, float out[NUMBERS])
{
    int32_t count = transform(in->values[0], LIGHT, out);

    count += transform(in->values[1], HUE, out + count);
    transform(in->values[2], HUE, out + count);
}

/* Mean colour over cell x cell texels from every place on, [height * width *
 * 3].
 */
static otx_status
average(otx_run *run, const otx_texel_pool *pool, int32_t cell, float **out)
{
    const int32_t width = pool->width, height = pool->height;
    const size_t count = 3 * (size_t)width * (size_t)height;
    float *rows = OTX_ZNEW(run->scratch, float, count);
    float *means = OTX_ZNEW(run->scratch, float, count);
    const float share = 1.0f / (float)(cell * cell);

    OTX_TRY(otx_run_ok(run));
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
            for (int32_t i = 0; i < cell; ++i)
                for (size_t c = 0; c < 3; ++c)
                    rows[3 * ((size_t)y * (size_t)width + (size_t)x) + c] +=
                        pool->colors
                            [3 * ((size_t)y * (size_t)width +
                                  (size_t)((x + i) % width)) +
                             c];
    for (int32_t y = 0; y < height; ++y)
        for (int32_t i = 0; i < cell; ++i)
        {
            const float *from =
                rows + 3 * (size_t)((y + i) % height) * (size_t)width;
            float *to = means + 3 * (size_t)y * (size_t)width;

            for (size_t k = 0; k < 3 * (size_t)width; ++k)
                to[k] += share * from[k];
        }
    *out = means;
    return OSDTEX_OK;
}

static void
gather_cells(
    const otx_texel_pool *pool, const float *means, int32_t cell, int32_t x0,
    int32_t y0, cells *out)
{
    for (int32_t j = 0; j < GRID; ++j)
        for (int32_t i = 0; i < GRID; ++i)
        {
            const int32_t x = (x0 + i * cell) % pool->width;
            const int32_t y = (y0 + j * cell) % pool->height;
            const float *mean =
                means + 3 * ((size_t)y * (size_t)pool->width + (size_t)x);

            for (int32_t c = 0; c < 3; ++c)
                out->values[c][j][i] = mean[c];
        }
}

/* Descriptions of LANES places from column `i` of row `j` on, number by number.
 * Places beyond the row's end are infinitely far from everything. */
static void
describe_block(
    const otx_patch_search *s, const float *means, int32_t i, int32_t j,
    float *out)
{
    for (int32_t lane = 0; lane < LANES; ++lane)
    {
        float numbers[NUMBERS];
        cells c;

        if (i + lane < s->columns)
        {
            gather_cells(
                s->pool, means, s->size / GRID,
                s->bounds.x0 + (i + lane) * STEP, s->bounds.y0 + j * STEP, &c);
            describe(&c, numbers);
        }
        for (int32_t n = 0; n < NUMBERS; ++n)
            out[n * LANES + lane] =
                i + lane < s->columns ? numbers[n] : INFINITY;
    }
}

/* Described places from `first` to before `end`; none where the exemplar is too
 * small. */
static int32_t
places(int32_t first, int32_t end)
{
    return end > first ? (end - first + STEP - 1) / STEP : 0;
}

otx_status
otx_patch_search_create(
    otx_run *run, const otx_texel_pool *pool, int32_t size,
    const otx_patch_bounds *bounds, int32_t turns_step, otx_patch_search *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    float *means = NULL, *block;

    *out = (otx_patch_search){
        .pool = pool,
        .size = size,
        .bounds = *bounds,
        .columns = places(bounds->x0, bounds->x1),
        .rows = places(bounds->y0, bounds->y1),
        .turns_step = turns_step,
    };
    out->blocks = (out->columns + LANES - 1) / LANES;
    out->index = block = OTX_NEW(
        run->arena, float,
        (size_t)out->rows *(size_t)out->blocks *(size_t)(NUMBERS * LANES));
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(average(run, pool, size / GRID, &means));
    for (int32_t j = 0; j < out->rows; ++j)
        for (int32_t i = 0; i < out->blocks; ++i, block += NUMBERS * LANES)
            describe_block(out, means, i * LANES, j, block);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* ---------------------------------------------------------------- finding */

typedef struct candidate
{
    float error;
    otx_texel_window window;
} candidate;

/* A list of the best, best first, that takes equals in the order in which they
 * come. */
static void
insert(candidate *list, int32_t *count, int32_t room, candidate c)
{
    int32_t at = *count < room ? (*count)++ : room;

    for (; at > 0 && c.error < list[at - 1].error; --at)
        if (at < room)
            list[at] = list[at - 1];
    if (at < room)
        list[at] = c;
}

static void
average_picture(
    const otx_texel_pool *pool, const otx_texel_map *picture, cells *out)
{
    const int32_t cell = picture->width / GRID;
    const float share = 1.0f / (float)(cell * cell);

    memset(out, 0, sizeof *out);
    for (int32_t y = 0; y < cell * GRID; ++y)
        for (int32_t x = 0; x < cell * GRID; ++x)
        {
            const float *color =
                pool->colors + 3 * (size_t)otx_texel_map_at(picture, x, y);

            for (int32_t c = 0; c < 3; ++c)
                out->values[c][y / cell][x / cell] += share * color[c];
        }
}

/* As a window turned by 90 degrees has them before it is turned. */
static void
turn_back(cells *c)
{
    const cells old = *c;

    for (int32_t k = 0; k < 3; ++k)
        for (int32_t y = 0; y < GRID; ++y)
            for (int32_t x = 0; x < GRID; ++x)
                c->values[k][GRID - 1 - x][y] = old.values[k][y][x];
}

/* Squared distances of a block's descriptions; false when all are `limit` or
 * more, which is often known from the first numbers. */
static bool
compare_block(
    const float *block, const float numbers[NUMBERS], float limit,
    float sums[LANES])
{
    for (int32_t k = 0; k < LANES; ++k)
        sums[k] = 0.0f;
    for (int32_t n = 0; n < NUMBERS; n += PART)
    {
        const float *part = block + n * LANES;
        float least = INFINITY;

        for (int32_t k = 0; k < LANES; ++k)
        {
            const float a = part[k] - numbers[n];
            const float b = part[LANES + k] - numbers[n + 1];
            const float c = part[2 * LANES + k] - numbers[n + 2];
            const float d = part[3 * LANES + k] - numbers[n + 3];

            sums[k] += (a * a + b * b) + (c * c + d * d);
        }
        for (int32_t k = 0; k < LANES; ++k)
            least = sums[k] < least ? sums[k] : least;
        if (!(least < limit))
            return false;
    }
    return true;
}

static void
shortlist(
    const otx_patch_search *s, const float numbers[NUMBERS], int32_t turns,
    candidate *list, int32_t *count)
{
    const float *block = s->index;

    for (int32_t j = 0; j < s->rows; ++j)
        for (int32_t i = 0; i < s->blocks; ++i, block += NUMBERS * LANES)
        {
            const float limit =
                *count == SHORTLIST ? list[SHORTLIST - 1].error : INFINITY;
            float sums[LANES];

            if (!compare_block(block, numbers, limit, sums))
                continue;
            for (int32_t k = 0; k < LANES; ++k)
                if (sums[k] < INFINITY)
                    insert(
                        list, count, SHORTLIST,
                        (candidate){
                            sums[k],
                            {s->bounds.x0 + (i * LANES + k) * STEP,
                             s->bounds.y0 + j * STEP, turns}});
        }
}

/* Sum of squared distances, given up above `limit`; INFINITY too where the
 * window is what is there, if that is not wanted. */
static float
compare(
    const otx_patch_search *s, const otx_texel_map *picture, bool fresh,
    otx_texel_window window, float limit)
{
    const int32_t size = s->size;
    int32_t own = 0;
    float sum = 0.0f;

    for (int32_t y = 0; y < size && sum <= limit; ++y)
        for (int32_t x = 0; x < size; ++x)
        {
            const int32_t p = otx_texel_map_at(picture, x, y);
            const int32_t q =
                otx_texel_pool_window(s->pool, window, size, size, x, y);
            const float *a = s->pool->colors + 3 * (size_t)p;
            const float *b = s->pool->colors + 3 * (size_t)q;

            own += p == q;
            sum += (a[0] - b[0]) * (a[0] - b[0]) +
                   (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]);
        }
    if (fresh && OWN_SHARE * own >= size * size)
        return INFINITY;
    return sum <= limit ? sum : INFINITY;
}

/* The best place within a step of the one described. */
static candidate
settle(
    const otx_patch_search *s, const otx_texel_map *picture, bool fresh,
    otx_texel_window window, float limit)
{
    candidate best = {INFINITY, window};

    for (int32_t y = window.y - 1; y <= window.y + 1; ++y)
        for (int32_t x = window.x - 1; x <= window.x + 1; ++x)
        {
            const otx_texel_window w = {x, y, window.turns};
            float error;

            if (x < s->bounds.x0 || y < s->bounds.y0 || x >= s->bounds.x1 ||
                y >= s->bounds.y1)
                continue;
            error = compare(s, picture, fresh, w, fminf(limit, best.error));
            if (error < best.error)
                best = (candidate){error, w};
        }
    return best;
}

/* The `count` (at most SHORTLIST) windows most like `picture`, best first;
 * returns how many there are.
 *
 *   fresh  leaves out what is there already */
static int32_t
find(
    const otx_patch_search *search, const otx_texel_map *picture, bool fresh,
    int32_t count, candidate *best)
{
    candidate list[SHORTLIST];
    int32_t listed = 0, found = 0;
    cells c;

    average_picture(search->pool, picture, &c);
    for (int32_t turns = 0; turns < 4; ++turns)
    {
        float numbers[NUMBERS];

        describe(&c, numbers);
        if (turns % search->turns_step == 0)
            shortlist(search, numbers, turns, list, &listed);
        turn_back(&c);
    }
    for (int32_t i = 0; i < listed; ++i)
    {
        const candidate at = settle(
            search, picture, fresh, list[i].window,
            found == count ? best[count - 1].error : INFINITY);
        bool known = !(at.error < INFINITY);

        for (int32_t k = 0; k < found && !known; ++k)
            known = memcmp(&best[k].window, &at.window, sizeof at.window) == 0;
        if (!known)
            insert(best, &found, count, at);
    }
    return found;
}

int32_t
otx_patch_search_find(
    const otx_patch_search *search, const otx_texel_map *picture, int32_t count,
    otx_texel_window *out)
{
    candidate best[SHORTLIST];
    const int32_t found = find(
        search, picture, true, count < SHORTLIST ? count : SHORTLIST, best);

    for (int32_t i = 0; i < found; ++i)
        out[i] = best[i].window;
    return found;
}

double
otx_patch_search_distance(
    const otx_patch_search *search, const otx_texel_map *picture)
{
    const double area = (double)search->size * search->size;
    candidate best;

    return find(search, picture, false, 1, &best) == 1 ? sqrt(best.error / area)
                                                       : INFINITY;
}
