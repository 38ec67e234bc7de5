/* quick.h -- pixels that look alike all over, by a few samples.
 *
 * Most pixels show one smooth piece of surface of about one colour: a quarter
 * of the samples says the same of them, and the light is that of the pixels
 * around (light_map.h). Others are left to all the samples. */
#ifndef OTX_RENDER_QUICK_H
#define OTX_RENDER_QUICK_H

#include "render/light_map.h"
#include "render/render.h"

enum
{
    OTX_QUICK_SIDE_MAX = 8
};

/* Not to be moved: `shade` borrows the options beside it. */
typedef struct otx_quick
{
    otx_render_options options; /* of half the samples to a side */
    otx_shade shade;
    const otx_light_map *map;
} otx_quick;

/* Whether any pixel can be quick: not where lines are drawn, which lie between
 * samples, or where there are few samples. */
bool otx_quick_suits(const otx_render_options *options);

/* Borrows all. */
void otx_quick_prepare(
    const otx_shade *full, const otx_light_map *map, otx_quick *out);

/* A place in square `number` of a pixel's n x n, jittered by number. */
otx_vec2 otx_quick_place(int32_t n, int32_t number, uint64_t pixel);

typedef enum otx_quick_result
{
    OTX_QUICK_MIXED, /* take all samples */
    OTX_QUICK_FINE,  /* the same, with the light that is known */
    OTX_QUICK_EMPTY, /* no sample meets the model */
    OTX_QUICK_DONE
} otx_quick_result;

/* The mean colour of pixel (x, y), whose hash key is `pixel`, and the light on
 * it, which is set where the result is FINE or DONE. */
otx_quick_result otx_quick_pixel(
    const otx_quick *quick, int32_t x, int32_t y, uint64_t pixel, float rgb[3],
    otx_light_known *known);

#endif
