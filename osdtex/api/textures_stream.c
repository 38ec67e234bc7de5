/* textures_stream.c -- a bake in memory, block by block to the host. */
#include "api/call.h"
#include "api/textures_handle.h"

#include <string.h>

static const char STAGE[] = "bake";

/* Blocks on their way to the host. */
typedef struct stream
{
    otx_run *run;
    const osdtex_bake_sink *sink;
    osdtex_bake_block blocks[OTX_BAKE_SLOTS];
    float *pixels[OTX_BAKE_SLOTS];
    osdtex_bake_block common; /* what all of a tile share */
    int32_t map;              /* of the bake, that they are of; -1 none */
} stream;

/* Kept until its turn comes. */
static void
take_block(void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    stream *s = user;
    osdtex_bake_block *kept = &s->blocks[slot];
    const otx_bake_block taken = otx_bake_block_of(block, s->map);
    const size_t row = (size_t)block->width * (size_t)s->common.channels;

    (void)lane;
    *kept = s->common;
    kept->pixels = s->pixels[slot];
    kept->level = block->level;
    kept->side = otx_pyramid_side(s->common.side, block->level);
    kept->x = block->x * OTX_MIP_BLOCK;
    kept->y = kept->side - block->y * OTX_MIP_BLOCK - block->height;
    kept->width = block->width;
    kept->height = block->height;
    for (int32_t y = 0; y < block->height; ++y)
        memcpy(
            s->pixels[slot] + (size_t)y * row, taken.pixels + y * taken.stride,
            row * sizeof(float));
}

static otx_status
put_block(void *user, int32_t slot, int32_t level, int32_t x, int32_t y)
{
    const stream *s = user;

    (void)level;
    (void)x;
    (void)y;
    return s->sink->put(s->sink->user, &s->blocks[slot])
               ? OSDTEX_OK
               : otx_fail(
                     s->run, OSDTEX_ERROR_CANCELLED, STAGE, OTX_NOWHERE,
                     "the bake was stopped by the one who asked for it");
}

/* Numbers from `first` up to `end` of `count`: one that is asked for, or all.
 */
static bool
find_range(int32_t asked, int32_t count, int32_t *first, int32_t *end)
{
    *first = asked < 0 ? 0 : asked;
    *end = asked < 0 ? count : asked + 1;
    return asked >= -1 && asked < count;
}

static otx_status
make_stream(
    otx_run *run, const osdtex_textures *textures, const osdtex_bake_sink *sink,
    stream **out)
{
    const size_t values = (size_t)OTX_MIP_BLOCK * OTX_MIP_BLOCK;
    stream *s = OTX_ZNEW(run->scratch, stream, 1);
    int32_t channels = 0;

    *out = s;
    if (!s)
        return otx_fail_memory(run, STAGE);
    for (int32_t i = 0; i < textures->info.texture_count; ++i)
        if (textures->textures[i].channels > channels)
            channels = textures->textures[i].channels;
    s->run = run;
    s->sink = sink;
    s->common.side = textures->info.side;
    for (int32_t i = 0; i < OTX_BAKE_SLOTS; ++i)
        s->pixels[i] = OTX_NEW(run->scratch, float, values *(size_t)channels);
    return otx_run_ok(run);
}

static otx_status
stream_tile(
    const osdtex_textures *textures, int32_t texture, int32_t tile,
    otx_bake_sink *how)
{
    stream *s = how->user;
    otx_status status;

    s->map = textures->sources[texture].map;
    s->common.texture = texture;
    s->common.name = textures->textures[texture].name;
    s->common.channels = textures->textures[texture].channels;
    s->common.tile = tile;
    s->common.udim = textures->info.tiles[tile];
    status = otx_bake_tile(
        s->run, textures->sources[texture].bake, textures->first_tile + tile,
        how);
    how->begin += how->share;
    return status;
}

static otx_status
bake_into(
    otx_run *run, const osdtex_textures *textures,
    const osdtex_bake_sink *theirs)
{
    osdtex_bake_sink ours = osdtex_bake_sink_none();
    otx_bake_sink how = {
        .take = take_block, .put = put_block, .put_by_caller = true};
    int32_t texture, texture_end, first_tile, tile_end;
    stream *s;

    OTX_TRY(otx_call_options(run, &ours, sizeof ours, theirs));
    if (!textures || !ours.put ||
        !find_range(
            ours.texture, textures->info.texture_count, &texture,
            &texture_end) ||
        !find_range(
            ours.tile, textures->info.tile_count, &first_tile, &tile_end) ||
        ours.first_level < 0 ||
        ours.first_level >= textures->info.level_count || ours.level_count < 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no textures or no function is given, or they have no such "
            "texture, tile or level");
    OTX_TRY(make_stream(run, textures, &ours, &s));
    how.user = s;
    how.first_level = ours.first_level;
    how.level_count = ours.level_count;
    how.share =
        1.0 / ((double)(texture_end - texture) * (tile_end - first_tile));
    for (; texture < texture_end; ++texture)
        for (int32_t tile = first_tile; tile < tile_end; ++tile)
            OTX_TRY(stream_tile(textures, texture, tile, &how));
    return OSDTEX_OK;
}

osdtex_status
osdtex_textures_bake(
    osdtex_context *context, const osdtex_textures *textures,
    const osdtex_bake_sink *sink)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, bake_into(&call.run, textures, sink));
}
