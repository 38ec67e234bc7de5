/* noise.h -- pictures in which every texel shows. */
#ifndef OTX_TESTS_NOISE_H
#define OTX_TESTS_NOISE_H

#include "unit/bake/flat.h"

/* Smooth noise of three channels, between .2 and .8. */
static inline otx_exemplar *
flat_noise(otx_run *run, int32_t side)
{
    otx_exemplar *exemplar = flat_exemplar(run, side, 3);

    for (int32_t y = 0; y < side; ++y)
        for (int32_t x = 0; x < side; ++x)
            for (int32_t c = 0; c < 3; ++c)
                otx_image_at(&exemplar->linear, x, y)[c] =
                    (float)(0.5 + 0.2 * sin(0.3 * x + c) * cos(0.23 * y) + 0.1 * otx_random_unit(7, (uint64_t)c, (uint64_t)(y / 2 * side + x / 2)));
    return exemplar;
}

#endif
