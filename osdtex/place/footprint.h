/* footprint.h -- the part of a surface that a picture covers, laid out flat.
 *
 * One chart without a cut: faces are unfolded around a spot, nearest first, as
 * far as the picture reaches, and brought as near to an isometry as the surface
 * lets them be [Liu08]. It is then moved so that the spot and the direction
 * that is up there lie where they were asked for. See docs/notes/place.md. */
#ifndef OTX_PLACE_FOOTPRINT_H
#define OTX_PLACE_FOOTPRINT_H

#include "place/spot.h"

/* A rectangle of the plane, in units of its width. */
typedef struct otx_footprint_box
{
    otx_vec2 low, high;
} otx_footprint_box;

typedef struct otx_footprint_ask
{
    const otx_surface *surface;
    otx_spot spot; /* at the origin of the plane */
    otx_vec3 up;   /* scene axes; its part along the surface at the spot is
                    * to be +y */
    double width;  /* scene units to a unit of the plane */
    otx_footprint_box box;    /* the picture; the origin is within it */
    const otx_worker *worker; /* asked whether to stop; NULL */
} otx_footprint_ask;

/* Slots of faces and vertices that are in the chart, to be used again: all -1
 * between calls. */
typedef struct otx_footprint_space
{
    int32_t *face_slot; /* [leaf face_count] */
    int32_t *vert_slot; /* [leaf vert_count] */
} otx_footprint_space;

typedef struct otx_footprint
{
    int32_t face_count, vert_count;
    int32_t *faces;   /* [face_count] of the leaf level */
    int32_t *first;   /* [face_count + 1] */
    int32_t *corners; /* local vertices, in the order of face_verts */
    int32_t *verts;   /* [vert_count] of the leaf level */
    otx_vec2 *flat;   /* [vert_count] */
    /* Over the area of the box: the greater of a triangle's larger singular
     * value and what its smaller one is 1 by. Infinite where it folds. */
    double stretch_mean, stretch_p95;
    double covered; /* area of faces in the box by that of the box: below 1
                     * where the surface ends, above where it comes twice */
    bool is_cut;    /* the chart ends inside of the box where the surface goes
                     * on */
} otx_footprint;

/* Fills *out, in `arena`. MEMORY, without a finding; CANCELLED. */
otx_status otx_footprint_lay(
    otx_arena *arena, const otx_footprint_ask *ask,
    const otx_footprint_space *space, otx_footprint *out);

#endif
