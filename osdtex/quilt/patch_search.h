/* patch_search.h -- where the exemplar looks like a small piece of a picture.
 *
 * Small patches mend the worst of a seam, so many are looked for, in pictures
 * that change with every one that is found: correlations with the whole
 * exemplar would be made anew each time. Instead every second place has a short
 * description, the lowest frequencies of its patch; the nearest descriptions
 * are compared texel by texel, and the best are moved to the exact place. */
#ifndef OTX_QUILT_PATCH_SEARCH_H
#define OTX_QUILT_PATCH_SEARCH_H

#include "quilt/texel_pool.h"

/* Places of a window's lower left texel: x0 <= x < x1, y0 <= y < y1. */
typedef struct otx_patch_bounds
{
    int32_t x0, y0, x1, y1;
} otx_patch_bounds;

typedef struct otx_patch_search
{
    const otx_texel_pool *pool;
    int32_t size; /* texels of a patch's side */
    otx_patch_bounds bounds;
    int32_t columns, rows; /* places that have a description */
    int32_t blocks;        /* of places in a row */
    int32_t turns_step;    /* 1: all turns; 2: none by 90 degrees */
    float *index;          /* [rows * blocks] descriptions */
} otx_patch_search;

/* Describes the patches of `size` texels, a multiple of 8, in run->arena. A
 * place is within `bounds`, which are those of windows of that size. */
otx_status otx_patch_search_create(
    otx_run *run, const otx_texel_pool *pool, int32_t size,
    const otx_patch_bounds *bounds, int32_t turns_step, otx_patch_search *out);

/* The windows that look most like `picture`, which is `size` texels on a side;
 * best first, at most `count`. Those that show a good part of it already are
 * left out. Returns how many there are.
 *
 *   out  [count] */
int32_t otx_patch_search_find(
    const otx_patch_search *search, const otx_texel_map *picture, int32_t count,
    otx_texel_window *out);

/* How far `picture` is from what looks most like it, wherever that is: root of
 * the mean squared distance. 0 for a piece of the exemplar. */
double otx_patch_search_distance(
    const otx_patch_search *search, const otx_texel_map *picture);

#endif
