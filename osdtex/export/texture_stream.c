/* texture_stream.c -- chunks of an EXR, or texels of an image. */
#include "export/texture_stream.h"

#include "export/companion_files.h"
#include "export/texture_file.h"

otx_status
otx_texture_stream_begin(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_bake *bake, int32_t channels, int32_t map,
    const otx_exr_options *options, otx_texture_stream *out)
{
    const int32_t side = bake->source.layout->side;
    const otx_exr_size size = {side, side, channels};

    OTX_TRY(otx_run_ok(run));
    *out = (otx_texture_stream){.path = path, .map = map};
    if (!options)
        return otx_image_create(
            run, run->scratch, side, side, channels, &out->image);
    OTX_TRY(otx_exr_begin(run, set, path, size, options, &out->exr));
    for (int32_t i = 0; i < otx_bake_slots(bake); ++i)
        out->chunks[i].bytes =
            OTX_NEW(run->scratch, uint8_t, otx_exr_packed_bytes(out->exr));
    return otx_run_ok(run);
}

void
otx_texture_stream_take(
    otx_texture_stream *stream, int32_t slot, int32_t lane,
    const otx_bake_block *block)
{
    otx_bake_block taken;

    if (!stream->path)
        return;
    taken = otx_bake_block_of(block, stream->map);
    if (stream->exr)
        otx_exr_pack(
            stream->exr, lane, block->level, block->x, block->y, taken.pixels,
            taken.stride, &stream->chunks[slot]);
    else if (block->level == 0)
        otx_bake_copy(&taken, &stream->image);
}

otx_status
otx_texture_stream_put(
    otx_texture_stream *stream, int32_t slot, int32_t level, int32_t x,
    int32_t y)
{
    return stream->path && stream->exr
               ? otx_exr_put(stream->exr, level, x, y, &stream->chunks[slot])
               : OSDTEX_OK;
}

otx_status
otx_texture_stream_end(
    otx_run *run, otx_atomic_file_set *set, const otx_exemplar *exemplar,
    otx_texture_stream *stream)
{
    if (!stream->path)
        return OSDTEX_OK;
    if (stream->exr)
        return otx_exr_end(stream->exr);
    return stream->map < 0
               ? otx_texture_file_write_integers(
                     run, set, stream->path, exemplar, &stream->image)
               : otx_companion_files_write_integers(
                     run, set, stream->path, exemplar->type,
                     stream->map == OTX_COMPANION_HEIGHT, &stream->image);
}
