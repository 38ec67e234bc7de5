/* spare.h -- what placed patches could show of faces that are others'.
 *
 * Patches are laid on collars wider than themselves. Where a neighbour could
 * show a face of a patch, the patch need not: there it may reach over the rim
 * of a picture that does not tile. So rims and corners of the picture are shown
 * as much as its middle, and no texel outside of it ever. */
#ifndef OTX_PATCH_SPARE_H
#define OTX_PATCH_SPARE_H

#include "patch/forest.h"

typedef struct otx_spares
{
    /* [leaf face_count] which patch could show a face that is not covered, and
     * which face of its chart that is; -1 none. NULL both: patches lie inside
     * as a whole. */
    int32_t *patch;
    int32_t *index;
} otx_spares;

/* Nothing is spare yet. MEMORY. */
otx_status otx_spares_create(otx_mosaic *m);

/* What face `i` of a placed chart costs in the cut: its squared strain and
 * turn; negative when it cannot be shown. */
float otx_spare_cost(const otx_mosaic *m, const otx_node *node, int32_t i);

/* Where a placed node shows a point of its plane; never outside the picture. */
otx_vec2
otx_spare_place(const otx_mosaic *m, const otx_node *node, otx_vec2 flat);

/* Whether a placed node shows face `i` of its chart inside the picture, nearly
 * whole. */
bool otx_spare_is_inside(const otx_mosaic *m, const otx_node *node, int32_t i);

/* Notes what a node that was just placed could show. */
void otx_spare_note(otx_mosaic *m, const otx_node *node);

/* The node that could show a face of `node`, and which face of its chart it
 * is; NULL when none could, or only from another exemplar. */
const otx_node *otx_spare_find(
    const otx_mosaic *m, const otx_node *node, int32_t face, int32_t *index);

#endif
