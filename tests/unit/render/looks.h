/* looks.h -- rendering in tests. */
#ifndef OTX_TESTS_LOOKS_H
#define OTX_TESTS_LOOKS_H

#include "scenes.h"

static inline otx_image
render(otx_run *run, const otx_scene *scene, const otx_render_options *options)
{
    otx_image out;

    assert_int_equal(otx_render(run, scene, options, &out), OSDTEX_OK);
    assert_int_equal(out.width, options->width);
    assert_int_equal(out.height, options->height);
    assert_int_equal(out.channels, 4);
    return out;
}

static inline double
sum_of_alpha(const otx_image *image)
{
    double sum = 0.0;

    for (int32_t y = 0; y < image->height; ++y)
        for (int32_t x = 0; x < image->width; ++x)
            sum += otx_image_at(image, x, y)[3];
    return sum;
}

#endif
