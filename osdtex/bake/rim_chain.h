/* rim_chain.h -- leaf edges along an edge of the cage that the texture is cut
 * at, and the knots that both sides of it can be linear between.
 *
 * A bilinear lookup along the rim of a block is linear between the middles of
 * its n texels. Sides of n and m texels, both odd multiples of g, have the
 * middles of g parts in common: what is linear between these, both can show. */
#ifndef OTX_BAKE_RIM_CHAIN_H
#define OTX_BAKE_RIM_CHAIN_H

#include "bake/mip_level.h"

/* Leaf edges of an edge of the cage: how many, and which one is `edge`, counted
 * as its face sees them; 1 and 0 where it cannot be told. */
typedef struct otx_rim_chain
{
    int32_t count, index;
} otx_rim_chain;

otx_rim_chain
otx_rim_chain_of(const otx_layout *layout, const otx_mip_rim *edge);

/* The leaf edge `steps` behind `edge`, which is in the chain. */
otx_mip_rim otx_rim_chain_step(
    const otx_layout *layout, const otx_mip_rim *edge, int32_t steps);

/* How a rim lies on the texels. */
typedef enum otx_rim_way
{
    OTX_RIM_ANY,
    OTX_RIM_STRAIGHT, /* along them, between two rows or columns */
    OTX_RIM_DIAGONAL  /* through the middles of texels, corner to corner */
} otx_rim_way;

otx_rim_way otx_rim_way_of(const otx_vec2 ends[2]);

/* The parts of an edge of the cage that both sides have texels in common with,
 * of n and m texels; 0 where there are none. */
int32_t otx_rim_knots(double n, double m);

#endif
