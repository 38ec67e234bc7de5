/* dither.c -- a hash of the pixel for each of its channels. */
#include "image/dither.h"

#include "base/random.h"

void
otx_dither_8bit(otx_image *image)
{
    const double step = 0.999 / 255.0;
    const int32_t colors = image->channels < 3 ? 1 : 3;

    for (int32_t y = 0; y < image->height; ++y)
        for (int32_t x = 0; x < image->width; ++x)
        {
            const uint64_t pixel = (uint64_t)y << 32 | (uint32_t)x;
            float *p = otx_image_at(image, x, y);

            for (int32_t k = 0; k < colors; ++k)
                p[k] +=
                    (float)(step * (otx_random_unit(0, (uint32_t)k, pixel) - 0.5));
        }
}
