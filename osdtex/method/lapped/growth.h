/* growth.h -- a chart while faces are added to it [Praun00, sec. 3.3].
 *
 * Faces are laid down one after the other, nearest to the seed first, each
 * turned as its heading says and moved to where its known corners are. The
 * paper lets charts fold over themselves in texture space, where a patch then
 * appears several times; here three tests refuse what would. */
#ifndef OTX_METHOD_LAPPED_GROWTH_H
#define OTX_METHOD_LAPPED_GROWTH_H

#include "base/pqueue.h"
#include "method/lapped/lapped.h"

typedef struct otx_growth
{
    const otx_lapped *l;
    const otx_lapped_seed *seed;
    const otx_lapped_space *space;
    const otx_worker *worker; /* asked whether to stop; NULL */
    otx_arena *arena;
    otx_lapped_chart *chart;
    int32_t face_capacity, vert_capacity, corner_capacity;
    otx_vec2 *headings; /* [face_capacity] S in the frames of the faces */
    double hull;        /* how far the chart is to reach, texels */
    otx_vec3 origin;    /* the seed's point, scene units */
    otx_pqueue queue;   /* half-edges of the chart by their distance */
    double *budget;     /* [cells * cells] surface laid over each cell, texels
                         * squared */
    int32_t cells;
} otx_growth;

/* Grows from the seed's face. MEMORY. */
otx_status otx_growth_run(otx_growth *g);

/* Adds faces around the chart all of whose vertices are in it and whose areas
 * in the plane are within `ratio` of those on the surface. Sets *added. MEMORY.
 */
otx_status otx_growth_sew(otx_growth *g, double ratio, int32_t *added);

#endif
