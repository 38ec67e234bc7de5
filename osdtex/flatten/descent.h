/* descent.h -- the vertices that are born below a face, parents first.
 *
 * Refinement puts a vertex on every edge and, but for Loop, in every face.
 * Whatever is defined at the corners of a face and has a rule for those two is
 * thereby defined at all leaf vertices below it: positions in the plane
 * [Soler02, eq. 1], topological coordinates [Soler02, sec. 4.1], the reach of
 * a control vertex. Vertices keep their index from level to level, so a value
 * per leaf vertex serves all levels. */
#ifndef OTX_FLATTEN_DESCENT_H
#define OTX_FLATTEN_DESCENT_H

#include "surface/surface.h"

/* Called with leaf vertices. An edge inside the patch comes twice, with its
 * ends in the same order. */
typedef struct otx_descent
{
    void (*edge)(void *context, int32_t born, int32_t a, int32_t b);
    void (*face)(
        void *context, int32_t born, const int32_t *corners, int32_t count);
    void *context;
} otx_descent;

/* Visits what is born below `face` of `level`, down to the leaf level. */
void otx_descent_walk(
    const otx_surface *surface, int32_t level, int32_t face,
    const otx_descent *visitor);

/* Topological descent: an edge vertex takes the mean of the edge's ends, a
 * face vertex that of the corners, as if all faces were flat and regular.
 *
 *   slot   [leaf vert_count] index into value of the vertices below the face
 *   value  given at the corners of the face, filled in below */
void otx_descent_average(
    const otx_surface *surface, int32_t level, int32_t face,
    const int32_t *slot, double *value);

#endif
