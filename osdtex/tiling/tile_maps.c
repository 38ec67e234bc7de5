/* tile_maps.c -- turns from neighbours, and maps looked up at the places. */
#include "tiling/tile_maps.h"

#include "image/view.h"

#include <string.h>

enum
{
    TURNS = 4,
    REACH = 2 /* texels around that are asked where a texel stands alone */
};

/* Steps to the right, and upward after a quarter turn each. */
static const int32_t STEPS[TURNS][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

static int32_t
number_at(const otx_texel_map *m, int32_t x, int32_t y)
{
    return x < 0 || y < 0 || x >= m->width || y >= m->height
               ? OTX_TEXEL_NONE
               : otx_texel_map_at(m, x, y);
}

/* Where a texel of the pool lies, as it is laid upright. */
static otx_tile_place
place_of(const otx_texel_pool *pool, int32_t number)
{
    const int32_t own = pool->width * pool->height;

    if (number >= own)
    {
        const otx_texel_place *p = &pool->places[number - own];

        return (otx_tile_place){p->at, p->step};
    }
    return (otx_tile_place){
        {number % pool->width + 0.5, number / pool->width + 0.5}, {1.0, 0.0}};
}

/* From a to b; the short way where the exemplar tiles. */
static double
way(double a, double b, int32_t size, bool wraps)
{
    const double d = b - a;

    return !wraps            ? d
           : d > 0.5 * size  ? d - size
           : d < -0.5 * size ? d + size
                             : d;
}

/* How many neighbours of a texel say that it is turned by each quarter. */
static void
ask_around(
    const otx_texel_pool *pool, const otx_texel_map *texels, int32_t x,
    int32_t y, int32_t votes[TURNS])
{
    const otx_exemplar *e = pool->exemplar;
    const otx_tile_place here = place_of(pool, otx_texel_map_at(texels, x, y));

    for (int side = 0; side < TURNS; ++side)
    {
        const int32_t number =
            number_at(texels, x + STEPS[side][0], y + STEPS[side][1]);
        otx_vec2 d;

        if (number == OTX_TEXEL_NONE)
            continue;
        d = place_of(pool, number).at;
        d = (otx_vec2){
            way(here.at.x, d.x, pool->width, e->wrap_x),
            way(here.at.y, d.y, pool->height, e->wrap_y)};
        for (int turn = 0; turn < TURNS; ++turn)
        {
            const int32_t *step = STEPS[(side + turn) % TURNS];
            const otx_vec2 wanted =
                otx_vec2_mul(here.turn, (otx_vec2){step[0], step[1]});

            votes[turn] += otx_vec2_length(otx_vec2_sub(d, wanted)) < 0.01;
        }
    }
}

/* The most votes; of as many, the fewest quarters. -1: none. */
static int
winner(const int32_t votes[TURNS])
{
    int best = 0;

    for (int turn = 1; turn < TURNS; ++turn)
        if (votes[turn] > votes[best])
            best = turn;
    return votes[best] > 0 ? best : -1;
}

bool
otx_tile_maps_place(
    const otx_texel_pool *pool, const otx_texel_map *texels, int32_t x,
    int32_t y, otx_tile_place *out)
{
    const int32_t number = number_at(texels, x, y);
    int32_t votes[TURNS] = {0};

    if (number == OTX_TEXEL_NONE)
        return false;
    ask_around(pool, texels, x, y, votes);
    for (int32_t reach = 1; winner(votes) < 0 && reach <= REACH; ++reach)
        for (int32_t j = -reach; j <= reach; ++j)
            for (int32_t i = -reach; i <= reach; ++i)
                if (number_at(texels, x + i, y + j) != OTX_TEXEL_NONE)
                    ask_around(pool, texels, x + i, y + j, votes);
    *out = place_of(pool, number);
    if (winner(votes) > 0)
    {
        const int32_t *step = STEPS[winner(votes)];

        out->turn = otx_vec2_mul(out->turn, (otx_vec2){step[0], step[1]});
    }
    return true;
}

/* ---- the maps ------------------------------------------------------------ */

typedef struct laying
{
    const otx_texel_pool *pool;
    const otx_texel_map *texels;
    otx_companions *out;
    int32_t factor; /* texels of a map to one of the colour */
} laying;

static void
lay_nothing(const otx_companions *set, float *out)
{
    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        if (set->maps[k].is_there)
            otx_companion_neutral(
                (otx_companion_kind)k, out + set->maps[k].first);
}

/* From the exemplar's frame to that of the tile. */
static void
turn_normal(otx_vec2 turn, float *n)
{
    const double length = otx_vec2_length(turn);
    const double c = turn.x / length, s = turn.y / length;
    const double x = (double)n[0], y = (double)n[1];

    n[0] = (float)(c * x + s * y);
    n[1] = (float)(c * y - s * x);
}

static otx_status
lay_row(void *context, int64_t row, otx_worker *worker)
{
    const laying *l = context;
    const otx_exemplar *e = l->pool->exemplar;
    const otx_companions *from = &e->companions;
    const otx_companion *normal = &from->maps[OTX_COMPANION_NORMAL];
    const int32_t n = l->factor, y = (int32_t)row / n;
    const otx_image_view view = otx_view_of(&from->image, e->wrap_x, e->wrap_y);

    (void)worker;
    for (int32_t column = 0; column < l->out->image.width; ++column)
    {
        float *out = otx_image_at(&l->out->image, column, (int32_t)row);
        const otx_vec2 within = {
            (column % n + 0.5) / n - 0.5, ((int32_t)row % n + 0.5) / n - 0.5};
        otx_tile_place place;

        if (!otx_tile_maps_place(l->pool, l->texels, column / n, y, &place))
        {
            lay_nothing(from, out);
            continue;
        }
        otx_view_value(
            view,
            otx_vec2_scale(
                n, otx_vec2_add(place.at, otx_vec2_mul(place.turn, within))),
            out);
        if (normal->is_there)
            turn_normal(place.turn, out + normal->first);
    }
    return OSDTEX_OK;
}

otx_status
otx_tile_maps_make(
    otx_run *run, const otx_texel_pool *pool, const otx_texel_map *texels,
    otx_companions *out)
{
    const otx_companions *from = &pool->exemplar->companions;
    laying l = {pool, texels, out, 1};

    *out = *from;
    if (!otx_companions_are_there(from))
        return OSDTEX_OK;
    l.factor = from->image.width / pool->width;
    OTX_TRY(otx_image_create(
        run, run->arena, l.factor * texels->width, l.factor * texels->height,
        from->image.channels, &out->image));
    return otx_pool_for(run->pool, out->image.height, lay_row, &l);
}
