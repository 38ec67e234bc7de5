/* image.c -- creating and halving pictures. */
#include "image/image.h"

otx_status
otx_image_create(
    otx_run *run, otx_arena *arena, int32_t width, int32_t height,
    int32_t channels, otx_image *out)
{
    const bool sides_ok = width >= 1 && width <= OTX_IMAGE_MAX_SIDE &&
                          height >= 1 && height <= OTX_IMAGE_MAX_SIDE;

    *out = (otx_image){0};
    if (!sides_ok || channels < 1 || channels > OTX_IMAGE_MAX_CHANNELS)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, "image", OTX_NOWHERE,
            "a picture of %d x %d with %d channels is outside the limits of 1 "
            "to %d a side and 1 to %d channels; resize it",
            width, height, channels, OTX_IMAGE_MAX_SIDE,
            OTX_IMAGE_MAX_CHANNELS);

    const size_t texel_count = (size_t)width * (size_t)height;
    float *pixels = OTX_NEW(arena, float, texel_count *(size_t)channels);

    if (!pixels)
        return otx_fail_memory(run, "image");
    *out = (otx_image){width, height, channels, pixels};
    return OSDTEX_OK;
}

/* Mean of the texels of `image` under texel (x, y) of its half. */
static void
halve_texel(const otx_image *image, int32_t x, int32_t y, float *color)
{
    const int32_t x1 = 2 * x + 1 < image->width ? 2 * x + 1 : 2 * x;
    const int32_t y1 = 2 * y + 1 < image->height ? 2 * y + 1 : 2 * y;
    const float *c00 = otx_image_at(image, 2 * x, 2 * y);
    const float *c10 = otx_image_at(image, x1, 2 * y);
    const float *c01 = otx_image_at(image, 2 * x, y1);
    const float *c11 = otx_image_at(image, x1, y1);

    for (int32_t c = 0; c < image->channels; ++c)
        color[c] =
            (float)(0.25 * ((double)c00[c] + c10[c] + ((double)c01[c] + c11[c])));
}

otx_status
otx_image_halve(
    otx_run *run, otx_arena *arena, const otx_image *image, otx_image *out)
{
    OTX_TRY(otx_image_create(
        run, arena, (image->width + 1) / 2, (image->height + 1) / 2,
        image->channels, out));
    for (int32_t y = 0; y < out->height; ++y)
        for (int32_t x = 0; x < out->width; ++x)
            halve_texel(image, x, y, otx_image_at(out, x, y));
    return OSDTEX_OK;
}
