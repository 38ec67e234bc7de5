/* scene.h -- exemplars and masks for the tests of the match room. */
#ifndef OTX_TESTS_MATCH_SCENE_H
#define OTX_TESTS_MATCH_SCENE_H

#include "support.h"

#include "base/random.h"
#include "match/matcher.h"

#include <math.h>

/* Random blobs about three texels wide that tile; 3 channels. */
static inline otx_image
scene_exemplar(otx_run *run, int32_t width, int32_t height)
{
    otx_image image = {
        width, height, 3,
        OTX_NEW(run->arena, float, (size_t)width *(size_t)height * 3)};

    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
            for (int32_t c = 0; c < 3; ++c)
            {
                double sum = 0.0;

                for (int32_t n = 0; n < 9; ++n)
                {
                    const int32_t i = (x + n % 3) % width;
                    const int32_t j = (y + n / 3) % height;

                    sum += otx_random_unit(
                        7, (uint32_t)c, (uint64_t)(j * width + i));
                }
                otx_image_at(&image, x, y)[c] = (float)(sum / 9.0);
            }
    return image;
}

/* RMS distance of two random texels: sqrt(2 variance). */
static inline double
scene_sigma(const otx_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    double sum[3] = {0}, square = 0.0;

    for (size_t i = 0; i < 3 * count; ++i)
    {
        sum[i % 3] += (double)image->pixels[i];
        square += (double)image->pixels[i] * (double)image->pixels[i];
    }
    for (int c = 0; c < 3; ++c)
        square -= sum[c] * sum[c] / (double)count;
    return sqrt(fmax(0.0, 2.0 * square / (double)count));
}

/* An L of quads of `cell` texels, 6 long and 2 wide, from `corner` on; the
 * source is R(angle) flat + shift. */
typedef struct scene_mask
{
    otx_mask_triangle triangles[64];
    otx_mask mask;
} scene_mask;

static inline void
scene_mask_make(
    scene_mask *out, otx_vec2 corner, double cell, double angle, otx_vec2 shift)
{
    int32_t count = 0;

    for (int32_t j = 0; j < 6; ++j)
        for (int32_t i = 0; i < 6; ++i)
        {
            if (i > 1 && j > 1)
                continue;
            for (int32_t half = 0; half < 2; ++half)
            {
                static const int corners[2][3][2] = {
                    {{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
                otx_mask_triangle *t = &out->triangles[count++];

                *t = (otx_mask_triangle){.from = NULL};
                for (int c = 0; c < 3; ++c)
                {
                    t->flat[c] = (otx_vec2){
                        corner.x + cell * (i + corners[half][c][0]),
                        corner.y + cell * (j + corners[half][c][1])};
                    t->source[c] = otx_vec2_add(
                        otx_vec2_mul(otx_vec2_polar(angle), t->flat[c]), shift);
                    t->weight[c] = 1.0f;
                }
            }
        }
    out->mask = (otx_mask){out->triangles, count};
}

static inline otx_matcher *
scene_matcher(otx_run *run, const otx_image *image, bool wrap)
{
    otx_matcher *matcher;

    assert_int_equal(
        otx_matcher_create(
            run, image, wrap, wrap, scene_sigma(image), 0, &matcher),
        OSDTEX_OK);
    return matcher;
}

#endif
