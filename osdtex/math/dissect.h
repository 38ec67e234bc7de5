/* dissect.h -- in which order to eliminate the unknowns of a surface.
 *
 * Nested dissection [George73]: a set of points is halved across its longest
 * extent, the points on one side that have neighbours on the other are put
 * last, and both halves go on likewise. On meshes of hundreds of thousands of
 * vertices the factor is a third to a half of what minimum degree alone
 * leaves. Cuts come from positions, so that no partitioner with a random
 * number generator of its own is needed.
 *
 * [Hoare61] Hoare: Algorithm 65: Find. Comm. ACM 4.
 * [George73] George: Nested dissection of a regular finite element mesh. SIAM
 * J. Numer. Anal. 10. */
#ifndef OTX_MATH_DISSECT_H
#define OTX_MATH_DISSECT_H

#include "base/arena.h"
#include "math/vec.h"

/* Numbers groups of unknowns in the order in which they are to be eliminated;
 * the order within a group is free. False when memory is out.
 *
 *   points     [count]
 *   first      [count + 1]
 *   neighbour  of unknown i: [first[i] .. first[i + 1]), both ways
 *   group      [count] */
bool otx_dissect(
    otx_arena *scratch, int32_t count, const otx_vec3 *points,
    const int32_t *first, const int32_t *neighbour, int32_t *group);

#endif
