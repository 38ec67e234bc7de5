/* image.h -- float pixels.
 *
 *     const float grey[4] = {0.0f, 0.5f, 0.5f, 1.0f};  // bottom row first
 *     osdtex_image *image;
 *
 *     osdtex_image_create(context, 2, 2, 1, grey, &image);
 *     osdtex_image_write(context, image, "grey.png");
 *     osdtex_image_destroy(image);
 *
 * What is rendered and baked into memory comes as an image, exemplars and masks
 * may go in as one. Pixels are lent as long as the handle, rows without gaps,
 * so that a host can lay an array of its own over them. A handle is immutable.
 */
#ifndef OSDTEX_IMAGE_H
#define OSDTEX_IMAGE_H

#include <osdtex/context.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_image osdtex_image;

typedef struct osdtex_image_info
{
    int32_t width;
    int32_t height;
    int32_t channels; /* interleaved: grey, grey + A, RGB, RGBA */
    int32_t reserved;
    const float *pixels; /* [height * width * channels], bottom row first,
                          * colour multiplied by A */
} osdtex_image_info;

/* Copies `pixels`, laid out as in osdtex_image_info. ARGUMENT (no pixels, no
 * size, not 1 to 4 channels), LIMIT (a side beyond 32768), MEMORY. */
OSDTEX_API osdtex_status osdtex_image_create(
    osdtex_context *context, int32_t width, int32_t height, int32_t channels,
    const float *pixels, osdtex_image **out);
OSDTEX_API const osdtex_image_info *
osdtex_image_describe(const osdtex_image *image);
/* Reads EXR, PNG, TIFF or JPEG, told by content: values as they are in the file
 * (integers over their maximum), no colour converted. FORMAT, SUPPORT, LIMIT,
 * NUMERIC (a pixel that is not finite), IO, MEMORY. */
OSDTEX_API osdtex_status osdtex_image_read(
    osdtex_context *context, const char *path, osdtex_image **out);
/* Writes scene-linear pixels: NAME.exr as they are, NAME.png for the eye,
 * through the sRGB space of the colour configuration. ARGUMENT (another
 * extension), IO, COLOUR, MEMORY. */
OSDTEX_API osdtex_status osdtex_image_write(
    osdtex_context *context, const osdtex_image *image, const char *path);
OSDTEX_API void osdtex_image_destroy(osdtex_image *image);

OSDTEX_END_DECLS

#endif
