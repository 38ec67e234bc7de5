/* exr_chunk.c -- rows of planes, split, differenced, deflated. */
#include "file/exr_chunk.h"

/* The table of the C++ library is not linked. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <libdeflate.h>
#include <math.h>
#include <string.h>

enum
{
    LEVEL = 4, /* of libdeflate: OpenEXR's own choice */
    QUICK_LEVEL = 1
};

static uint16_t
to_half(float value, int64_t *clamped_count)
{
    if (fabsf(value) > (float)HALF_MAX)
    {
        ++*clamped_count;
        value = copysignf((float)HALF_MAX, value);
    }
    return imath_float_to_half(value);
}

/* One channel of one row as little-endian values; false when one of them is
 * not finite. */
static bool
lay_half(
    const float *in, int32_t channels, int32_t width, uint8_t *out,
    int64_t *clamped_count)
{
    for (int32_t x = 0; x < width; ++x, in += channels)
    {
        if (!isfinite(*in))
            return false;

        const uint16_t value = to_half(*in, clamped_count);

        *out++ = (uint8_t)value;
        *out++ = (uint8_t)(value >> 8);
    }
    return true;
}

static bool
lay_float(const float *in, int32_t channels, int32_t width, uint8_t *out)
{
    for (int32_t x = 0; x < width; ++x, in += channels)
    {
        uint32_t value;

        if (!isfinite(*in))
            return false;
        memcpy(&value, in, sizeof value);
        for (int k = 0; k < 4; ++k)
            *out++ = (uint8_t)(value >> 8 * k);
    }
    return true;
}

/* Turns rows over and channels into planes. */
static bool
lay_rows(
    const otx_exr_texels *t, bool full_float, uint8_t *out,
    int64_t *clamped_count)
{
    const size_t bytes = otx_exr_chunk_bytes((size_t)t->width, 1, full_float);

    for (int32_t y = t->height - 1; y >= 0; --y)
        for (int32_t c = t->channels - 1; c >= 0; --c, out += bytes)
        {
            const float *in = t->pixels + y * t->stride + c;

            if (!(full_float
                      ? lay_float(in, t->channels, t->width, out)
                      : lay_half(
                            in, t->channels, t->width, out, clamped_count)))
                return false;
        }
    return true;
}

/* Every other byte of `in`, as the difference to the one before plus 128.
 *
 *   before  what the first one is compared with
 */
static void
take_differences(const uint8_t *in, size_t count, int before, uint8_t *out)
{
    out[0] = (uint8_t)(in[0] - before + 128);
    for (size_t i = 1; i < count; ++i)
        out[i] = (uint8_t)(in[2 * i] - in[2 * i - 2] + 128);
}

/* The even bytes, then the odd ones, which are as many: values have two or
 * four. The very first byte stands as it is. */
static void
split(const uint8_t *rows, size_t count, uint8_t *out)
{
    take_differences(rows, count / 2, 128, out);
    take_differences(rows + 1, count / 2, rows[count - 2], out + count / 2);
}

void
otx_exr_chunk_pack(
    otx_exr_packer *packer, const otx_exr_texels *texels, bool full_float,
    otx_exr_chunk *chunk)
{
    const size_t count = otx_exr_chunk_bytes(
        (size_t)texels->width * (size_t)texels->height, texels->channels,
        full_float);

    chunk->size = 0;
    chunk->clamped_count = 0;
    chunk->status = OSDTEX_ERROR_NUMERIC;
    if (!lay_rows(texels, full_float, packer->rows, &chunk->clamped_count))
        return;
    chunk->status = OSDTEX_ERROR_MEMORY;
    if (!packer->deflate)
        packer->deflate =
            libdeflate_alloc_compressor(packer->is_quick ? QUICK_LEVEL : LEVEL);
    if (!packer->deflate)
        return;
    chunk->status = OSDTEX_OK;
    split(packer->rows, count, packer->split);
    /* What does not get smaller stands as it is; readers tell by the size. */
    chunk->size = libdeflate_zlib_compress(
        packer->deflate, packer->split, count, chunk->bytes, count - 1);
    if (chunk->size > 0)
        return;
    memcpy(chunk->bytes, packer->rows, count);
    chunk->size = count;
}

void
otx_exr_packer_close(otx_exr_packer *packer)
{
    libdeflate_free_compressor(packer->deflate);
    packer->deflate = NULL;
}
