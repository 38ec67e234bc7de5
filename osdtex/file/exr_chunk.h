/* exr_chunk.h -- texels as a chunk of an EXR file.
 *
 * A chunk is rows from the top; a row is the planes A, B, G, R of it one after
 * the other. Its bytes are split into even and odd ones, each made the
 * difference to the one before, and deflated: ZIP as OpenEXR has it. OpenEXR
 * 3.1 does that with zlib and, for one file, on one thread; libdeflate takes
 * less than half of the time for less bytes (and is what OpenEXR 3.2 on uses),
 * and here every thread can pack chunks of the same file. */
#ifndef OTX_FILE_EXR_CHUNK_H
#define OTX_FILE_EXR_CHUNK_H

#include "base/run.h"

/* Texels of a chunk: rows from the BOTTOM, as pictures here have them. */
typedef struct otx_exr_texels
{
    const float *pixels; /* the lower left one */
    ptrdiff_t stride;    /* floats from a row to the one above */
    int32_t width, height;
    int32_t channels; /* 3 or 4 */
} otx_exr_texels;

/* What packing came to. */
typedef struct otx_exr_chunk
{
    uint8_t *bytes; /* of the caller, room for otx_exr_chunk_bytes of them */
    size_t size;
    int64_t clamped_count; /* values beyond the half range, now at its end */
    otx_status status;     /* OK, NUMERIC (not finite), MEMORY */
} otx_exr_chunk;

/* One thread's tools; zero-initialise. */
typedef struct otx_exr_packer
{
    void *deflate;
    uint8_t *rows, *split; /* [otx_exr_chunk_bytes] each */
    bool is_quick;         /* rather than small */
} otx_exr_packer;

/* Bytes of so many texels before compression, the most that packed ones take.
 */
static inline size_t
otx_exr_chunk_bytes(size_t texels, int32_t channels, bool full_float)
{
    return texels * (size_t)channels * (full_float ? 4u : 2u);
}

/* Packs into chunk->bytes; all else in *chunk is set. The packer's rows and
 * split must be there, the rest is made when first needed. */
void otx_exr_chunk_pack(
    otx_exr_packer *packer, const otx_exr_texels *texels, bool full_float,
    otx_exr_chunk *chunk);

/* Frees what packing made. */
void otx_exr_packer_close(otx_exr_packer *packer);

#endif
