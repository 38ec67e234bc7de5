/* mixture.h -- two pictures mixed with their contrast kept. */
#ifndef OTX_STACK_MIXTURE_H
#define OTX_STACK_MIXTURE_H

#include "image/image.h"

typedef struct otx_mixture
{
    const otx_image *from, *to; /* of one size, the same channels */
    /* [height * width] the texels that are shown, NULL: the picture has no
     * weight. */
    const int32_t *from_texels, *to_texels;
    double weight;  /* of the second */
    uint32_t plain; /* bit c: channel c is a mean as it comes out */
    bool bounded;   /* no value lies beyond those that are mixed */
    bool as_seen;   /* what is not plain is light, and is mixed as it is seen */
} otx_mixture;

/* A weighted mean of both, in run->arena, whose channels are stretched about
 * their means to the standard deviation between those of the two: what is mixed
 * of things that differ is flat. Light is mixed and stretched by its cube root,
 * as lightness is made of it. Values that were not negative are kept so.
 * MEMORY.
 */
otx_status
otx_mixture_make(otx_run *run, const otx_mixture *mixture, otx_image *out);

#endif
