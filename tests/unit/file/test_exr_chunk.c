/* test_exr_chunk.c -- chunks as OpenEXR's own decoder must find them. That
 * whole files come back is tested in test_exr_write.c. */
#include "support.h"

#include "base/random.h"
#include "file/exr_chunk.h"

#include <libdeflate.h>
#include <math.h>
#include <string.h>

enum
{
    SIDE = 16,
    CHANNELS = 3,
    TEXELS = SIDE * SIDE,
    BYTES = TEXELS * CHANNELS * 4 /* at most */
};

typedef struct desk
{
    uint8_t rows[BYTES], split[BYTES], bytes[BYTES];
    float pixels[TEXELS * CHANNELS];
    otx_exr_packer packer;
    otx_exr_chunk chunk;
} desk;

static void
pack(desk *d, bool full_float, bool is_quick)
{
    const otx_exr_texels texels = {
        d->pixels, SIDE * CHANNELS, SIDE, SIDE, CHANNELS};

    d->packer = (otx_exr_packer){NULL, d->rows, d->split, is_quick};
    d->chunk = (otx_exr_chunk){.bytes = d->bytes};
    otx_exr_chunk_pack(&d->packer, &texels, full_float, &d->chunk);
    otx_exr_packer_close(&d->packer);
}

/* Undoes the split and the differences, as the format has them. */
static void
unpack(const desk *d, size_t count, uint8_t *out)
{
    struct libdeflate_decompressor *tool = libdeflate_alloc_decompressor();
    uint8_t split[BYTES];
    size_t got = 0;

    assert_int_equal(
        libdeflate_zlib_decompress(
            tool, d->bytes, d->chunk.size, split, sizeof split, &got),
        LIBDEFLATE_SUCCESS);
    libdeflate_free_decompressor(tool);
    assert_int_equal(got, count);
    for (size_t i = 1; i < count; ++i)
        split[i] = (uint8_t)(split[i - 1] + split[i] - 128);
    for (size_t i = 0; i < count; ++i)
        out[i] = split[i / 2 + (i % 2) * (count / 2)];
}

/* Planes B, G, R in every row, rows from the top. */
static void
rows_are_in_the_files_order(void **state)
{
    desk d;
    uint8_t bytes[BYTES];

    (void)state;
    for (int32_t i = 0; i < TEXELS * CHANNELS; ++i)
        d.pixels[i] = (float)(i / CHANNELS / SIDE) + 0.25f * (float)(i % 3);
    pack(&d, true, false);
    assert_int_equal(d.chunk.status, OSDTEX_OK);
    assert_true(d.chunk.size < BYTES / 4);
    unpack(&d, BYTES, bytes);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t c = 0; c < CHANNELS; ++c)
            for (int32_t x = 0; x < SIDE; ++x)
            {
                float value;

                memcpy(
                    &value, bytes + 4 * ((y * CHANNELS + c) * SIDE + x),
                    sizeof value);
                assert_true(
                    value == (float)(SIDE - 1 - y) + 0.25f * (float)(2 - c));
            }
}

static void
halves_take_two_bytes(void **state)
{
    desk d;
    uint8_t bytes[BYTES];

    (void)state;
    for (int32_t i = 0; i < TEXELS * CHANNELS; ++i)
        d.pixels[i] = 1.0f;
    d.pixels[0] = 1e6f;
    pack(&d, false, true);
    assert_int_equal(d.chunk.status, OSDTEX_OK);
    assert_int_equal(d.chunk.clamped_count, 1);
    unpack(&d, BYTES / 2, bytes);
    assert_true(bytes[0] == 0x00 && bytes[1] == 0x3C);
    /* The red of the lower left: the last row's third plane. */
    const uint8_t *last = bytes + 2 * (SIDE * CHANNELS - 1) * SIDE;

    assert_true(last[0] == 0xFF && last[1] == 0x7B);
}

/* Noise does not get smaller, and is stored as it is. */
static void
what_grows_is_stored(void **state)
{
    desk d;

    (void)state;
    for (int32_t i = 0; i < TEXELS * CHANNELS; ++i)
    {
        const uint32_t bits =
            (uint32_t)otx_random_bits(3, 0, (uint64_t)i) & 0xBFFFFFFFu;

        memcpy(&d.pixels[i], &bits, sizeof bits);
    }
    pack(&d, true, false);
    assert_int_equal(d.chunk.status, OSDTEX_OK);
    assert_int_equal(d.chunk.size, BYTES);
    assert_memory_equal(d.bytes, d.rows, BYTES);
}

static void
what_is_not_finite_is_refused(void **state)
{
    const float bad[] = {NAN, INFINITY, -INFINITY};
    desk d;

    (void)state;
    for (int i = 0; i < 6; ++i)
    {
        memset(d.pixels, 0, sizeof d.pixels);
        d.pixels[100 * i + 7] = bad[i % 3];
        pack(&d, i < 3, false);
        assert_int_equal(d.chunk.status, OSDTEX_ERROR_NUMERIC);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_in_the_files_order),
        cmocka_unit_test(halves_take_two_bytes),
        cmocka_unit_test(what_grows_is_stored),
        cmocka_unit_test(what_is_not_finite_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
