/* texel_pool.c -- texels by number, and windows of them. */
#include "quilt/texel_pool.h"
#include "base/random.h"
#include "image/view.h"

#include <string.h>

enum
{
    PAIRS = 4096,
    PAIR_STAGE = 0x7469c001
};

static const char STAGE[] = "tiles";

/* Mean distance of random pairs; the seed is fixed, so that it is a figure of
 * the exemplar alone. */
static double
random_pair(const otx_texel_pool *pool)
{
    double sum = 0.0;

    for (uint64_t i = 0; i < PAIRS; ++i)
    {
        const double n = pool->count;

        sum += otx_texel_pool_distance(
            pool, (int32_t)(n * otx_random_unit(0, PAIR_STAGE, 2 * i)),
            (int32_t)(n * otx_random_unit(0, PAIR_STAGE, 2 * i + 1)));
    }
    return sum / PAIRS;
}

/* Match space lies in [-1, 1]: times this, colours are as far apart as in Lab
 * at most, which is what costs of cuts have room for. */
static const double UNIT_MAX = 100.0;

/* 1 in Lab, to the bit. */
static double
unit_of(const otx_exemplar *e, const otx_image *compared)
{
    const bool in_lab =
        compared == &e->lab || e->embedding == OTX_EMBEDDING_LAB;

    return !in_lab && e->match_sigma > 0.0 && e->lab_sigma > 0.0
               ? fmin(e->lab_sigma / e->match_sigma, UNIT_MAX)
               : 1.0;
}

static void
scale_color(const otx_texel_pool *pool, const float *from, float *to)
{
    for (int c = 0; c < 3; ++c)
        to[c] = (float)(pool->unit * from[c]);
}

otx_status
otx_texel_pool_create(
    otx_run *run, otx_arena *arena, const otx_exemplar *exemplar,
    const otx_image *compared, int32_t extra, otx_texel_pool *out)
{
    const size_t own =
        (size_t)exemplar->linear.width * (size_t)exemplar->linear.height;
    const size_t room = own + (size_t)extra;
    const size_t channels = (size_t)exemplar->linear.channels;

    if (room > INT32_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "the picture has too many texels to make tiles of; scale it down");
    *out = (otx_texel_pool){
        .exemplar = exemplar,
        .width = exemplar->linear.width,
        .height = exemplar->linear.height,
        .channels = exemplar->linear.channels,
        .count = (int32_t)own,
        .capacity = (int32_t)room,
        .linear = OTX_NEW(arena, float, room *channels),
        .compared = compared,
        .unit = unit_of(exemplar, compared),
        .colors = OTX_NEW(arena, float, room * 3),
        .places = OTX_NEW(arena, otx_texel_place, extra + 1),
    };
    if (!out->linear || !out->colors || !out->places)
        return otx_fail_memory(run, STAGE);
    memcpy(
        out->linear, exemplar->linear.pixels, own * channels * sizeof(float));
    for (size_t i = 0; i < own; ++i)
        scale_color(out, compared->pixels + 3 * i, out->colors + 3 * i);
    out->random_pair = random_pair(out);
    return OSDTEX_OK;
}

otx_status
otx_texel_map_create(
    otx_run *run, otx_arena *arena, int32_t width, int32_t height,
    otx_texel_map *out)
{
    *out = (otx_texel_map){
        width, height, OTX_NEW(arena, int32_t, (size_t)width * (size_t)height)};
    return out->texels ? OSDTEX_OK : otx_fail_memory(run, STAGE);
}

int32_t
otx_texel_pool_window(
    const otx_texel_pool *pool, otx_texel_window window, int32_t width,
    int32_t height, int32_t x, int32_t y)
{
    int32_t i = x, j = y;

    switch (window.turns & 3)
    {
    case 1:
        i = y;
        j = width - 1 - x;
        break;
    case 2:
        i = width - 1 - x;
        j = height - 1 - y;
        break;
    case 3:
        i = height - 1 - y;
        j = x;
        break;
    default:
        break;
    }
    i += window.x;
    j += window.y;
    i = i >= pool->width ? i - pool->width : i;
    j = j >= pool->height ? j - pool->height : j;
    return j * pool->width + i;
}

void
otx_texel_pool_lay(
    const otx_texel_pool *pool, otx_texel_window window, otx_texel_map *map)
{
    int32_t *texel = map->texels;

    for (int32_t y = 0; y < map->height; ++y)
        for (int32_t x = 0; x < map->width; ++x)
            *texel++ = otx_texel_pool_window(
                pool, window, map->width, map->height, x, y);
}

void
otx_texel_pool_resample(
    otx_texel_pool *pool, otx_vec2 centre, double angle, double step,
    otx_texel_map *map)
{
    const otx_exemplar *e = pool->exemplar;
    const otx_vec2 turn = otx_vec2_scale(step, otx_vec2_polar(angle));
    int32_t *texel = map->texels;

    for (int32_t y = 0; y < map->height; ++y)
        for (int32_t x = 0; x < map->width; ++x)
        {
            const otx_vec2 p = {
                x + 0.5 - 0.5 * map->width, y + 0.5 - 0.5 * map->height};
            const otx_vec2 at = otx_vec2_add(centre, otx_vec2_mul(turn, p));
            const size_t n = (size_t)pool->count++;
            float color[3];

            pool->places[n - (size_t)pool->width * (size_t)pool->height] =
                (otx_texel_place){at, turn};
            otx_view_value(
                otx_view_of(&e->linear, e->wrap_x, e->wrap_y), at,
                pool->linear + n * (size_t)pool->channels);
            otx_view_value(
                otx_view_of(pool->compared, e->wrap_x, e->wrap_y), at, color);
            scale_color(pool, color, pool->colors + n * 3);
            *texel++ = (int32_t)n;
        }
}
