/* demand.h -- which of several exemplars each leaf face is asked to show.
 *
 * The artist says it by the cage's materials, by a picture on the cage's UVs,
 * or face by face; each function writes over what was asked before where it
 * has something to say. Exemplars count from 0, the first; in sentences they
 * count from 1. See docs/notes/mask.md. */
#ifndef OTX_METHOD_DEMAND_H
#define OTX_METHOD_DEMAND_H

#include "field/constraint.h"
#include "image/image.h"

/* Faces of a material of the cage show exemplar `index`. ARGUMENT when no face
 * has it, with those that there are. */
otx_status otx_demand_material(
    otx_run *run, const otx_surface *surface, const char *material,
    int32_t index, uint8_t *demand);

/* Every face of the cage by a table.
 *
 *   faces  [cage face_count] indices below `count`
 *
 * ARGUMENT with the face. */
otx_status otx_demand_faces(
    otx_run *run, const otx_surface *surface, const uint8_t *faces,
    int32_t count, uint8_t *demand);

/* A picture on the cage's UVs, of the unit square or of one UDIM tile. */
typedef struct otx_demand_mask
{
    const otx_image *image; /* 3 or 4 channels, of which the first three count
                             */
    const char *path;       /* of the picture, for findings */
    /* [leaf face_count] as otx_demand_tiles; NULL: all are in the picture. */
    const uint16_t *tiles;
    int32_t tile; /* that the picture is of: faces in others are left alone */
} otx_demand_mask;

/* The UDIM tile of each leaf face, in which its middle lies; 0 for holes.
 *
 *   path   of the mask, for findings
 *   tiles  [leaf face_count]
 *
 * ARGUMENT for a cage without UVs, and for UVs beyond all tiles. */
otx_status otx_demand_tiles(
    otx_run *run, const otx_surface *surface, const char *path,
    uint16_t *tiles);

/* By a picture: where black (what red, green and blue leave of 1) weighs most
 * the first exemplar, where red does the second, green the third, blue the
 * fourth; of equal weights the first of these. A leaf face takes the sum of its
 * corners and its middle.
 *
 * ARGUMENT for a cage without UVs, UVs outside of the picture, and colours
 * that ask for an exemplar that is not there. */
otx_status otx_demand_picture(
    otx_run *run, const otx_surface *surface, const otx_demand_mask *mask,
    int32_t count, uint8_t *demand);

/* By a picture of numbers from 0 to 1, the mean of its colours: adds what it
 * says at the corners of faces to their vertices, so that what lies on two
 * sides of a cut in the UVs is one.
 *
 *   sums, counts  [leaf vert_count]
 *
 * ARGUMENT as otx_demand_picture, FORMAT for other numbers. */
otx_status otx_demand_values(
    otx_run *run, const otx_surface *surface, const otx_demand_mask *mask,
    double *sums, int32_t *counts);

/* Whether a set asks for materials or exemplars. */
bool otx_demand_in(const otx_constraint_set *constraints);

/* By constraints that name an exemplar or, as a material from 0 to 1, one on
 * the way from the first to the last: at faces of the cage as they say; for
 * the others each exemplar gets a weight that is harmonic between what is
 * asked, and the largest wins. So what is asked at two places meets half way,
 * and no third comes between.
 *
 *   constraints  exemplars of which are numbers up to `count`
 *
 * As otx_constraint_interpolate. */
otx_status otx_demand_constraints(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, int32_t count, uint8_t *demand);

#endif
