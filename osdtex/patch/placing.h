/* placing.h -- placements that are not searched: by chance, or as asked for.
 *
 * All of a patch must land inside an exemplar that does not tile. */
#ifndef OTX_PATCH_PLACING_H
#define OTX_PATCH_PLACING_H

#include "patch/mosaic.h"

/* The middle of a chart's core, in its plane. */
otx_vec2 otx_placing_middle(const otx_chart *chart);

/* What of a patch must land inside the picture, in its plane: the corners of
 * the core but of faces that neighbours could show (spare.h), and the middle.
 * NULL when memory is out. */
otx_vec2 *otx_placing_points(
    const otx_mosaic *m, const otx_node *node, otx_arena *scratch,
    int32_t *count);

/* By chance, or along the guide, for a patch that has nothing to match. False
 * when it lies inside at none of the orientations that are tried.
 *
 *   index   of the node
 *   points  [count] that must land inside */
bool otx_placing_freely(
    const otx_mosaic *m, int32_t index, const otx_vec2 *points, int32_t count,
    otx_match *out);

/* As the user wants his first patch, or as near to there as it lies inside.
 * False when it does not fit so turned. */
bool otx_placing_first(
    const otx_mosaic *m, const otx_node *node, const otx_vec2 *points,
    int32_t count, otx_match *out);

#endif
