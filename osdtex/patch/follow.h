/* follow.h -- patches that follow a guide. */
#ifndef OTX_PATCH_FOLLOW_H
#define OTX_PATCH_FOLLOW_H

#include "patch/mosaic.h"

/* Patches that follow the request's guide. Angles are radians. */
enum
{
    OTX_FOLLOW_ANGLES = 13
};
/* Orientations at which a node follows it, into angles[OTX_FOLLOW_ANGLES]; how
 * many there are.
 *
 *   continuing  that which continues the neighbours; NAN none */
int32_t otx_follow_angles(
    const otx_mosaic *m, const otx_node *node, double continuing,
    double *angles);
/* Whether a node laid so follows closely enough; true without a guide. */
bool otx_follow_allows(const otx_mosaic *m, const otx_node *node, double angle);
/* Between the guide and what a placed node shows on face `i` of its chart. */
double
otx_follow_deviation(const otx_mosaic *m, const otx_node *node, int32_t i);

#endif
