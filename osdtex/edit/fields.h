/* fields.h -- directions, sizes and places along an axis, edited in an area.
 *
 * Each is solved again inside of the area with what is around it locked, as
 * [Ray09, sec. 2.1] edits fields, on a surface of the area and a ring of faces
 * around it: everything outside keeps what it has, to the bit. */
#ifndef OTX_EDIT_FIELDS_H
#define OTX_EDIT_FIELDS_H

#include "field/constraint.h"
#include "mapping/mapping.h"
#include "surface/subset.h"

typedef struct otx_edit_place
{
    const otx_surface *surface;
    const otx_constraint_set *set; /* all that has been asked, in its order */
    int32_t edit;                  /* the one at hand, and the last */
    const otx_subset *subset;      /* the area and a ring around it */
    otx_connection connection;     /* of the subset */
    uint8_t *faces;                /* [subset face_count] 1: of the area */
    uint8_t *verts; /* [subset vert_count] 1: of faces of the area alone */
} otx_edit_place;

/*   area  [leaf face_count] 1: may change; at least one face
 *
 * In run->arena. MEMORY. */
otx_status otx_edit_place_make(
    otx_run *run, const otx_surface *surface, const otx_constraint_set *set,
    int32_t edit, const uint8_t *area, otx_edit_place *out);

/* What an edit asks for. */
typedef struct otx_edit_asks
{
    bool direction, scale, material, exemplar, redo;
    int32_t take; /* of redo, the largest */
} otx_edit_asks;

otx_edit_asks otx_edit_asks_of(const otx_constraint_set *set, int32_t edit);

/* The guide with its directions solved again. ARGUMENT (a direction upright on
 * the surface), NUMERIC, MEMORY. */
otx_status otx_edit_guide(
    otx_run *run, const otx_edit_place *place, const otx_guide *from,
    const otx_guide **out);

/* The density of the surface likewise. [leaf vert_count] */
otx_status
otx_edit_density(otx_run *run, const otx_edit_place *place, const float **out);

/* Places along the axis of a stack likewise, [leaf vert_count]. */
otx_status otx_edit_along(
    otx_run *run, const otx_edit_place *place, const float *from,
    const float **out);

#endif
