/* texture_stream.h -- a baked texture on its way into its file.
 *
 * An EXR is packed block by block and never held as a whole; any other file is
 * kept as an image of level 0 and written at the end. */
#ifndef OTX_EXPORT_TEXTURE_STREAM_H
#define OTX_EXPORT_TEXTURE_STREAM_H

#include "bake/bake.h"
#include "file/atomic_file.h"
#include "file/exr.h"

typedef struct otx_texture_stream
{
    const char *path; /* NULL: nothing goes there */
    int32_t map;      /* whose blocks it takes; -1 the colour's */
    otx_exr_writer *exr;
    otx_exr_chunk chunks[OTX_BAKE_SLOTS];
    otx_image image; /* where `exr` is NULL */
} otx_texture_stream;

/* Begins the file `path` of a bake, an EXR by `options` where that is not NULL.
 * In run->scratch. IO, MEMORY. */
otx_status otx_texture_stream_begin(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_bake *bake, int32_t channels, int32_t map,
    const otx_exr_options *options, otx_texture_stream *out);

/* For `take` and `put` of a sink, see bake.h. */
void otx_texture_stream_take(
    otx_texture_stream *stream, int32_t slot, int32_t lane,
    const otx_bake_block *block);
otx_status otx_texture_stream_put(
    otx_texture_stream *stream, int32_t slot, int32_t level, int32_t x,
    int32_t y);

/* Once all is baked: closes an EXR, or writes the image as the colour of
 * `exemplar` or the map of it that the stream takes. IO, NUMERIC, MEMORY. */
otx_status otx_texture_stream_end(
    otx_run *run, otx_atomic_file_set *set, const otx_exemplar *exemplar,
    otx_texture_stream *stream);

#endif
