/* mask_pictures.c -- reading masks, tile by tile. */
#include "api/mask_pictures.h"

#include "file/picture_read.h"
#include "file/udim_name.h"
#include "image/udim.h"
#include "method/demand.h"

#include <unistd.h>

static const char STAGE[] = "mask";

/* What is to become of a picture when it is read. */
typedef struct purpose
{
    int32_t count;   /* of exemplars */
    uint8_t *demand; /* which are asked for; NULL: it is numbers */
    double *sums;    /* at vertices */
    int32_t *counts;
} purpose;

/* The picture lives in an arena of its own: it is large, and what readers
 * make must not lie over what the scratch arena holds. */
static otx_status
take_picture(
    otx_run *run, const otx_surface *surface, otx_demand_mask mask,
    const purpose *p)
{
    otx_run aside = *run;
    otx_picture picture;
    otx_status status;

    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, STAGE);
    status = otx_picture_read(&aside, mask.path, &picture);
    mask.image = &picture.image;
    if (status == OSDTEX_OK)
        status =
            p->demand
                ? otx_demand_picture(run, surface, &mask, p->count, p->demand)
                : otx_demand_values(run, surface, &mask, p->sums, p->counts);
    otx_arena_destroy(aside.arena);
    return status;
}

/* A face that lies in a tile, -1 none. */
static int32_t
find_face(const uint16_t *tiles, int32_t face_count, int32_t tile)
{
    for (int32_t f = 0; f < face_count; ++f)
        if (tiles[f] == tile)
            return f;
    return -1;
}

static otx_status
take_tile(
    otx_run *run, const otx_surface *surface, otx_demand_mask mask,
    int32_t face, const purpose *p)
{
    const int32_t parent = otx_surface_leaf(surface)->face_cage[face];

    if (!mask.path)
        return otx_fail_memory(run, STAGE);
    if (access(mask.path, F_OK) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_IO, STAGE, (otx_where){mask.path, 0, parent, -1},
            "the mask has no picture of UDIM tile %d, where face %d lies; "
            "write one, black where the first exemplar is to be",
            (int)mask.tile, (int)parent);
    return take_picture(run, surface, mask, p);
}

static otx_status
take_tiles(
    otx_run *run, const otx_surface *surface, const char *pattern,
    const purpose *p)
{
    const int32_t face_count = otx_surface_leaf(surface)->face_count;
    uint16_t *tiles = OTX_NEW(run->scratch, uint16_t, face_count);
    uint8_t *found =
        OTX_ZNEW(run->scratch, uint8_t, OTX_UDIM_LAST - OTX_UDIM_FIRST + 1);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_demand_tiles(run, surface, pattern, tiles));
    for (int32_t f = 0; f < face_count; ++f)
        if (tiles[f] != 0)
            found[tiles[f] - OTX_UDIM_FIRST] = 1;
    for (int32_t t = OTX_UDIM_FIRST; t <= OTX_UDIM_LAST; ++t)
        if (found[t - OTX_UDIM_FIRST])
            OTX_TRY(take_tile(
                run, surface,
                (otx_demand_mask){
                    .path = otx_udim_name_of(run->scratch, pattern, t),
                    .tiles = tiles,
                    .tile = t},
                find_face(tiles, face_count, t), p));
    return OSDTEX_OK;
}

static otx_status
take(
    otx_run *run, const otx_surface *surface, const char *path,
    const purpose *p)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);

    if (!otx_udim_name_is_pattern(path))
        return take_picture(run, surface, (otx_demand_mask){.path = path}, p);
    OTX_TRY(take_tiles(run, surface, path, p));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_mask_pictures_take(
    otx_run *run, const otx_surface *surface, const char *path, int32_t count,
    uint8_t *demand)
{
    const purpose p = {.count = count, .demand = demand};

    return take(run, surface, path, &p);
}

otx_status
otx_mask_pictures_values(
    otx_run *run, const otx_surface *surface, const char *path, double *values)
{
    const int32_t verts = otx_surface_leaf(surface)->vert_count;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const purpose p = {
        .sums = values, .counts = OTX_ZNEW(run->scratch, int32_t, verts)};

    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < verts; ++v)
        values[v] = 0.0;
    OTX_TRY(take(run, surface, path, &p));
    for (int32_t v = 0; v < verts; ++v)
        values[v] /= p.counts[v] > 0 ? p.counts[v] : 1;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_mask_pictures_take_image(
    otx_run *run, const otx_surface *surface, const otx_image *image,
    int32_t count, uint8_t *demand)
{
    const otx_demand_mask mask = {.image = image, .path = "a mask in memory"};

    if (image->channels < 3)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a mask in memory has red, green and blue, not %d channels",
            (int)image->channels);
    return otx_demand_picture(run, surface, &mask, count, demand);
}
