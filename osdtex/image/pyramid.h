/* pyramid.h -- mip levels whose sizes are rounded down, as textures have them.
 *
 * Level l of a w x h picture is max(1, w >> l) by max(1, h >> l). A texel is
 * the mean of the level above over its true area, so that odd sizes do not
 * shift the picture: the texels on the rim of the area count by the share
 * that is covered. For even sizes this is the mean of 2 x 2. */
#ifndef OTX_IMAGE_PYRAMID_H
#define OTX_IMAGE_PYRAMID_H

#include "image/image.h"

enum
{
    OTX_PYRAMID_MAX_LEVELS = 16 /* of OTX_IMAGE_MAX_SIDE, 2^15 */
};

typedef struct otx_pyramid
{
    int32_t count;
    otx_image levels[OTX_PYRAMID_MAX_LEVELS]; /* levels[0] borrows its pixels */
} otx_pyramid;

/* Levels down to 1 x 1, both ends included. */
int32_t otx_pyramid_count(int32_t width, int32_t height);

/* Size of a side at a level. */
static inline int32_t
otx_pyramid_side(int32_t side, int32_t level)
{
    return side >> level > 1 ? side >> level : 1;
}

/* The next level below `image`. 1 x 1 stays 1 x 1. */
otx_status otx_pyramid_reduce(
    otx_run *run, otx_arena *arena, const otx_image *image, otx_image *out);

/* All levels, from `image` itself down to 1 x 1. */
otx_status otx_pyramid_build(
    otx_run *run, otx_arena *arena, const otx_image *image, otx_pyramid *out);

#endif
