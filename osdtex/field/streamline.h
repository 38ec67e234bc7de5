/* streamline.h -- evenly spaced lines along a direction field, to be drawn.
 *
 * Lines are grown from seeds both ways, straight across each face, and end
 * where they come close to another line of about their direction
 * [Jobard97]. A cross field gets both of its families.
 *
 * [Jobard97] Jobard, Lefer: Creating evenly-spaced streamlines of arbitrary
 * density. Visualization in Scientific Computing. */
#ifndef OTX_FIELD_STREAMLINE_H
#define OTX_FIELD_STREAMLINE_H

#include "field/direction.h"

/* A straight piece on one face. */
typedef struct otx_streamline_piece
{
    int32_t face;
    otx_vec3 ends[2];
    double along[2]; /* length of the line up to the ends, from any origin;
                      * it grows as arrows of symmetry 1 point */
} otx_streamline_piece;

typedef struct otx_streamline_set
{
    int32_t count;
    otx_streamline_piece *pieces;
} otx_streamline_set;

/* Lines about `spacing` scene units apart, in run->arena. Pieces that come
 * within `width` of an edge are repeated for the face across it. ARGUMENT for
 * lengths that are not positive; LIMIT, MEMORY, CANCELLED. */
otx_status otx_streamline_trace(
    otx_run *run, const otx_direction *field, double spacing, double width,
    otx_streamline_set *out);

#endif
