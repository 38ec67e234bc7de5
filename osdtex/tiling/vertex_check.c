/* vertex_check.c -- windows where four tiles meet, and elsewhere. */
#include "tiling/vertex_check.h"

#include "base/random.h"
#include "base/sort.h"

#include <math.h>

enum
{
    WINDOWS = 48, /* of each kind */
    TYPE_STAGE = 0x7469c011,
    CORNER_STAGE = 0x7469c012,
    PLACE_STAGE = 0x7469c013
};

/* A number from 0 to count - 1. */
static int32_t
draw(const otx_run *run, uint32_t stage, uint64_t element, int32_t count)
{
    return (
        int32_t)(otx_random_bits(run->seed, stage, element) % (uint64_t)count);
}

/* Names of the tiles around a vertex of the usual kind, counter-clockwise from
 * the upper right one: tile q has its corner q there. Its side q begins at the
 * vertex, and is seen from the other side by the tile before it as side q + 2,
 * clockwise. */
static void
draw_tiles(
    const otx_run *run, const otx_tile_layout *l, uint64_t vertex,
    otx_tile_name names[4])
{
    const int32_t at =
        l->corners > 1 ? 1 + draw(run, CORNER_STAGE, 2 * vertex, l->corners - 1)
                       : 0;
    const int32_t beyond = draw(run, CORNER_STAGE, 2 * vertex + 1, l->corners);
    const int32_t kinds = l->oriented ? l->boundaries / 2 : l->boundaries;

    for (int32_t q = 0; q < 4; ++q)
        for (int32_t s = 0; s < 4; ++s)
        {
            names[q].sides[s] =
                draw(
                    run, TYPE_STAGE, 16 * vertex + (uint64_t)(4 * q + s),
                    2 * kinds) +
                (l->oriented && (s & 1) ? l->boundaries : 0);
            names[q].corners[s] = s == q ? at : beyond;
        }
    for (int32_t q = 0; q < 4; ++q)
        names[(q + 3) & 3].sides[(q + 2) & 3] = names[q].sides[q] ^ 1;
}

/* The window around the vertex; false where a tile is not in the set. */
static bool
lay_vertex(
    const otx_tile_layout *l, const otx_tile_name names[4],
    const otx_texel_map *picture, otx_texel_map *window)
{
    const int32_t half = window->width / 2, side = otx_tile_layout_side(l);
    int32_t x0[4], y0[4], *texel = window->texels;

    for (int32_t q = 0; q < 4; ++q)
    {
        const int32_t cell =
            otx_tile_layout_cell(l, otx_tile_layout_number(l, &names[q]));

        if (cell < 0)
            return false;
        otx_tile_layout_origin(l, cell, &x0[q], &y0[q]);
        x0[q] += l->gutter + (q == 1 || q == 2 ? side : 0);
        y0[q] += l->gutter + (q >= 2 ? side : 0);
    }
    for (int32_t y = -half; y < half; ++y)
        for (int32_t x = -half; x < half; ++x)
        {
            const int32_t q = y >= 0 ? (x >= 0 ? 0 : 1) : (x >= 0 ? 3 : 2);

            *texel++ = otx_texel_map_at(picture, x0[q] + x, y0[q] + y);
        }
    return true;
}

static void
lay_inside(
    const otx_run *run, const otx_tile_layout *l, uint64_t element,
    const otx_texel_map *picture, otx_texel_map *window)
{
    const int32_t room = otx_tile_layout_side(l) - window->width + 1;
    const int32_t cell = draw(
        run, PLACE_STAGE, 3 * element,
        l->names ? l->name_count : l->columns * l->rows);
    int32_t x0, y0, *texel = window->texels;

    otx_tile_layout_origin(l, cell, &x0, &y0);
    x0 += l->gutter + draw(run, PLACE_STAGE, 3 * element + 1, room);
    y0 += l->gutter + draw(run, PLACE_STAGE, 3 * element + 2, room);
    for (int32_t y = 0; y < window->height; ++y)
        for (int32_t x = 0; x < window->width; ++x)
            *texel++ = otx_texel_map_at(picture, x0 + x, y0 + y);
}

typedef struct job
{
    const otx_run *run;
    const otx_patch_search *search;
    const otx_tile_layout *layout;
    const otx_texel_map *picture;
    double distances[2 * WINDOWS]; /* at vertices, then inside */
} job;

static otx_status
look_up(void *context, int64_t index, otx_worker *worker)
{
    job *j = context;
    otx_run run = *j->run;
    otx_texel_map window;

    run.arena = run.scratch = worker->scratch;
    OTX_TRY(otx_texel_map_create(
        &run, run.scratch, j->search->size, j->search->size, &window));
    j->distances[index] = INFINITY;
    if (index < WINDOWS)
    {
        otx_tile_name names[4];

        draw_tiles(&run, j->layout, (uint64_t)index, names);
        if (!lay_vertex(j->layout, names, j->picture, &window))
            return OSDTEX_OK;
    }
    else
        lay_inside(
            &run, j->layout, (uint64_t)(index - WINDOWS), j->picture, &window);
    j->distances[index] = otx_patch_search_distance(j->search, &window);
    return OSDTEX_OK;
}

/* Of those that are known. */
static double
median(double *values)
{
    int32_t count = 0;

    otx_sort_doubles(values, WINDOWS);
    while (count < WINDOWS && values[count] < INFINITY)
        ++count;
    return count > 0 ? values[count / 2] : -1.0;
}

otx_status
otx_vertex_check(
    otx_run *run, const otx_patch_search *search, const otx_tile_layout *layout,
    const otx_texel_map *picture, otx_vertex_figures *out)
{
    job *j = OTX_ZNEW(run->scratch, job, 1);

    *out = (otx_vertex_figures){-1.0, -1.0};
    if (search->size > otx_tile_layout_side(layout))
        return OSDTEX_OK;
    OTX_TRY(otx_run_ok(run));
    *j = (job){
        .run = run, .search = search, .layout = layout, .picture = picture};
    OTX_TRY(otx_pool_for(run->pool, 2 * WINDOWS, look_up, j));
    out->vertex = median(j->distances);
    out->inside = median(j->distances + WINDOWS);
    return OSDTEX_OK;
}
