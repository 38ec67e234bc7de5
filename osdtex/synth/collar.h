/* collar.h -- matches that charts read from each other.
 *
 * Only matches travel: the place as it is, the angle turned by the rotation
 * between the two charts' frames. Nothing is resampled, and no collar is read
 * by another one, so it does not matter in which order charts are worked on. */
#ifndef OTX_SYNTH_COLLAR_H
#define OTX_SYNTH_COLLAR_H

#include "synth/canvas.h"

/* A collar texel, and the one of another chart nearest to it. */
typedef struct otx_collar_link
{
    int32_t at;    /* index in the canvas */
    int32_t chart; /* that owns it */
    int32_t from;  /* index there */
    float dx, dy;  /* on from there, texels of that canvas */
    float c, s;    /* (1, 0) here is (c, s) there */
} otx_collar_link;

typedef struct otx_collar
{
    otx_collar_link *links;
    int32_t count;
} otx_collar;

/* The links of all charts at the level of `canvases`, in run->scratch.
 *
 *   finest  [count] canvases of level 0
 *   out     [count]
 *
 * MEMORY. */
otx_status otx_collar_link_up(
    otx_run *run, const otx_synth_chart *charts, otx_canvas *const *finest,
    otx_canvas *const *canvases, int32_t count, otx_collar *out);

/* Reads all collars. */
otx_status otx_collar_exchange(
    otx_run *run, otx_canvas *const *canvases, otx_collar *collars,
    int32_t count);

#endif
