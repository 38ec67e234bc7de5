/* fuzz_profile.c -- the bytes are an ICC profile in a TIFF of colours, or of
 * greys where the first of them is odd: a profile is applied or passed over,
 * and pixels are finite or refused. */
#include "fuzz.h"

#include <math.h>
#include <string.h>

enum
{
    SIDE = 8,
    TAG_COUNT = 10,
    HEADER_BYTES = 8,
    DIRECTORY_BYTES = 2 + TAG_COUNT * 12 + 4,
    PIXELS_AT = HEADER_BYTES + DIRECTORY_BYTES
};

static void
put(uint8_t **at, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i)
        *(*at)++ = (uint8_t)(value >> (8 * i));
}

static void
put_tag(uint8_t **at, uint32_t tag, uint32_t type, uint32_t n, uint32_t value)
{
    put(at, tag, 2);
    put(at, type, 2);
    put(at, n, 4);
    put(at, value, 4);
}

/* A little-endian TIFF of one strip; the profile lies behind the pixels. */
static size_t
make_tiff(uint8_t *file, const uint8_t *profile, size_t size, bool grey)
{
    const uint32_t channels = grey ? 1 : 3;
    const uint32_t bytes = SIDE * SIDE * channels;
    uint8_t *at = file;

    put(&at, 0x002A4949, 4);
    put(&at, HEADER_BYTES, 4);
    put(&at, TAG_COUNT, 2);
    put_tag(&at, 256, 3, 1, SIDE);
    put_tag(&at, 257, 3, 1, SIDE);
    put_tag(&at, 258, 3, 1, 8);
    put_tag(&at, 259, 3, 1, 1);
    put_tag(&at, 262, 3, 1, grey ? 1 : 2);
    put_tag(&at, 273, 4, 1, PIXELS_AT);
    put_tag(&at, 277, 3, 1, channels);
    put_tag(&at, 278, 3, 1, SIDE);
    put_tag(&at, 279, 4, 1, bytes);
    put_tag(&at, 34675, 7, (uint32_t)size, PIXELS_AT + bytes);
    put(&at, 0, 4);
    for (uint32_t i = 0; i < bytes; ++i)
        *at++ = (uint8_t)(i * 83);
    memcpy(at, profile, size);
    return (size_t)(at - file) + size;
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static osdtex_context *context;
    uint8_t *file;
    const char *path;
    osdtex_exemplar *exemplar;
    osdtex_status status;

    /* Four bytes or less would stand in the tag itself. */
    if (size < 6)
        return 0;
    if (!context)
        context = fuzz_context();
    file = malloc(PIXELS_AT + SIDE * SIDE * 3 + size);
    if (!file)
        return 0;
    path = fuzz_file(
        "picture", file, make_tiff(file, data + 1, size - 1, data[0] & 1));
    free(file);
    osdtex_diagnostic_clear(context);
    status = osdtex_exemplar_read(context, path, NULL, &exemplar);
    fuzz_judge(context, status, exemplar);
    if (status == OSDTEX_OK)
    {
        const osdtex_exemplar_info *info = osdtex_exemplar_describe(exemplar);

        for (int i = 0; i < SIDE * SIDE * info->channels; ++i)
            fuzz_check(isfinite(info->pixels[i]));
    }
    osdtex_exemplar_destroy(exemplar);
    return 0;
}
