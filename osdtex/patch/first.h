/* first.h -- the patch that the user begins with. */
#ifndef OTX_PATCH_FIRST_H
#define OTX_PATCH_FIRST_H

#include "patch/mosaic.h"

/* The user's first patch, which is said of a face of the cage. */
/* The node that has that face; -1 none. */
int32_t otx_first_node(const otx_mosaic *m);
/* Whether a node is to become it: it has of the face, and nothing is textured.
 */
bool otx_first_is(const otx_mosaic *m, const otx_node *node);
/* Whether a leaf is of that face and of that patch, which keeps it. */
bool otx_first_holds(const otx_mosaic *m, int32_t leaf);
/* Of what the chart of that patch has of the face. */
otx_vec2 otx_first_middle(const otx_mosaic *m, const otx_chart *chart);
/* Direction in the chart of the face's first edge, from its corner 0 to its
 * corner 1; 0 when the chart does not reach both. */
double otx_first_heading(const otx_mosaic *m, const otx_chart *chart);

#endif
