/* oddness.h -- does a rearranged picture show what its source does not?
 *
 * Cuts can fuse what was apart and end what went on, and the best of all cuts
 * may still do. Little windows across cuts are compared with the source: each
 * has a nearest one there. So do windows of the source itself, among those that
 * do not overlap them. The distance that one in ten of the former passes, over
 * the one that one in ten of the latter passes, is near 1 where cuts show
 * nothing new. */
#ifndef OTX_QUILT_ODDNESS_H
#define OTX_QUILT_ODDNESS_H

#include "quilt/texel_pool.h"

/* The largest of the ratios at three sizes; 0 when `map`, of the picture's
 * size, has no cuts. MEMORY. */
otx_status otx_oddness_measure(
    otx_run *run, const otx_texel_pool *pool, const otx_texel_map *map,
    double *out);

#endif
