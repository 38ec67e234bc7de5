/* texel_pool.h -- what tiles are made of: texels, each with a number.
 *
 * Everything that is composed here is a picture of texel numbers. So colours
 * are only ever copied, all that is known of a texel follows it, and turning by
 * 90 degrees loses nothing. The first texels are those of the exemplar; windows
 * that the user lays at an angle are resampled and added behind them. */
#ifndef OTX_QUILT_TEXEL_POOL_H
#define OTX_QUILT_TEXEL_POOL_H

#include "exemplar/exemplar.h"

#include <math.h>

enum
{
    OTX_TEXEL_NONE = -1
};

/* Where a texel that was resampled was taken. */
typedef struct otx_texel_place
{
    otx_vec2 at;   /* its middle, texels of the exemplar */
    otx_vec2 step; /* to the texel on its right */
} otx_texel_place;

typedef struct otx_texel_pool
{
    const otx_exemplar *exemplar;
    int32_t width, height; /* of the exemplar */
    int32_t channels;      /* of `linear` */
    int32_t count, capacity;
    float *linear;             /* [capacity * channels] */
    const otx_image *compared; /* of the exemplar: what distances are taken
                                * in */
    double unit; /* of what is compared, so that its contrast is that of Lab */
    float *colors;           /* [capacity * 3] of `compared`, times `unit` */
    otx_texel_place *places; /* [capacity less the exemplar's own] of the texels
                              * behind those */
    /* Mean distance of two random texels: what a cut would cost that goes
     * anywhere. */
    double random_pair;
} otx_texel_pool;

/* A picture of texel numbers. Row 0 is at the bottom. */
typedef struct otx_texel_map
{
    int32_t width, height;
    int32_t *texels; /* [height * width], OTX_TEXEL_NONE where there is none */
} otx_texel_map;

static inline int32_t
otx_texel_map_at(const otx_texel_map *map, int32_t x, int32_t y)
{
    return map->texels[(size_t)y * (size_t)map->width + (size_t)x];
}

/* An upright window of the exemplar, turned by `turns` * 90 degrees counter-
 * clockwise when it is laid down. (x, y) is the lower left texel of what it
 * covers in the exemplar: width x height, or height x width for odd turns. */
typedef struct otx_texel_window
{
    int32_t x, y;
    int32_t turns;
} otx_texel_window;

/* A pool of the exemplar's texels with room for `extra` more, in `arena`.
 *
 *   compared  `match` or `lab` of the exemplar: where distances are taken.
 * Those of match space are scaled to the contrast of Lab, for which all that
 * weighs distances against something else was measured */
otx_status otx_texel_pool_create(
    otx_run *run, otx_arena *arena, const otx_exemplar *exemplar,
    const otx_image *compared, int32_t extra, otx_texel_pool *out);

otx_status otx_texel_map_create(
    otx_run *run, otx_arena *arena, int32_t width, int32_t height,
    otx_texel_map *out);

/* How many places a window of width x height has along x and y, before it is
 * turned; 0 or less: the exemplar is too small. */
static inline int32_t
otx_texel_pool_places_x(const otx_texel_pool *pool, int32_t width)
{
    return pool->exemplar->wrap_x && width <= pool->width
               ? pool->width
               : pool->width - width + 1;
}

static inline int32_t
otx_texel_pool_places_y(const otx_texel_pool *pool, int32_t height)
{
    return pool->exemplar->wrap_y && height <= pool->height
               ? pool->height
               : pool->height - height + 1;
}

/* Texel of the window at (x, y) of width x height laid down. */
int32_t otx_texel_pool_window(
    const otx_texel_pool *pool, otx_texel_window window, int32_t width,
    int32_t height, int32_t x, int32_t y);

/* Fills `map` with the window. */
void otx_texel_pool_lay(
    const otx_texel_pool *pool, otx_texel_window window, otx_texel_map *map);

/* Fills `map` with new texels: the picture around `centre` (texels), its rows
 * along `angle`, `step` texels of the exemplar to a texel, sampled bilinearly.
 * There must be room. */
void otx_texel_pool_resample(
    otx_texel_pool *pool, otx_vec2 centre, double angle, double step,
    otx_texel_map *map);

/* Squared distance of two texels. */
static inline double
otx_texel_pool_square(const otx_texel_pool *pool, int32_t a, int32_t b)
{
    const float *p = pool->colors + 3 * (size_t)a;
    const float *q = pool->colors + 3 * (size_t)b;
    const double l = p[0] - q[0], m = p[1] - q[1], n = p[2] - q[2];

    return l * l + m * m + n * n;
}

static inline double
otx_texel_pool_distance(const otx_texel_pool *pool, int32_t a, int32_t b)
{
    return sqrt(otx_texel_pool_square(pool, a, b));
}

#endif
