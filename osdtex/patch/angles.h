/* angles.h -- how a patch may be turned. */
#ifndef OTX_PATCH_ANGLES_H
#define OTX_PATCH_ANGLES_H

#include "match/mask.h"
#include "patch/mosaic.h"

enum
{
    OTX_ANGLES_MAX = 360,
    OTX_ANGLES_DRAW = 0x616e676c /* random numbers that angles are drawn by */
};

/* Orientations to search for a node, radians, into angles[OTX_ANGLES_MAX]; how
 * many there are.
 *
 *   index  of the node
 *   mask   what its neighbours show */
int32_t otx_angles_list(
    const otx_mosaic *m, int32_t index, const otx_mask *mask, double *angles);

#endif
