/* phase.h -- periodic coordinates that follow a direction field.
 *
 * Periodic global parameterization [Ray06; Ray09, sec. 2.3]: each of the two
 * lattice coordinates s is kept at vertices as the complex number e^(2 pi i s),
 * which does not see whole cells, and
 *
 *     sum over edges of w |z_j - e^(2 pi i step) z_i|^2
 *
 * is minimised, where `step` is what the gradient asks for along the edge.
 * The coordinates then are single valued up to whole cells but for defects:
 * faces around which the steps do not sum to zero.
 *
 * With a field of lines (symmetry 2) a face may take either sense. Across an
 * edge where the senses differ s turns into -s, and z into its conjugate.
 *
 * [Ray06] Ray, Li, Levy, Sheffer, Alliez: Periodic global parameterization.
 * [Ray09] Ray, Levy, Wang, Turk, Vallet: Material space texturing. */
#ifndef OTX_PERIODIC_PHASE_H
#define OTX_PERIODIC_PHASE_H

#include "field/direction.h"

typedef struct otx_phase_request
{
    const otx_direction *field; /* of symmetry 1 or 2 */
    const double *log_scale;    /* [vert_count], see otx_scale_solve */
    /* Cells per scene unit of the two coordinates, along the field's direction
     * and to the left of it. A zero one is not solved for and stays 0. */
    otx_vec2 gradient[2];
    /* Dislocations closer to their opposite are made to meet, scene units. */
    double cancel;
} otx_phase_request;

typedef struct otx_phase
{
    const otx_connection *connection;
    int8_t *match; /* [edge_count] 1, or -1 where senses differ */
    /* [corner_count] cells; whole in a face that is no defect, and up to
     * whole cells and sense the same in its neighbour. */
    otx_vec2 *cells;
    /* [face_count] once cells are equal across edges: 1, or -1 where a face has
     * changed its sense for that. */
    int8_t *sense;
    /* [edge_count] cells along the half-edge of the edge's first face that the
     * field asks for, in the sense that it had before. */
    double *wish[2];
    uint8_t *turned; /* [vert_count] 1: senses do not close around it, so that
                      * only whole and half cells are the same in all faces */
    /* [corner_count] what the vertex has of cells, without whole ones, in the
     * sense that the face had before: around a defect, cells may differ. */
    otx_vec2 *parts;
    uint8_t *defect; /* [face_count] 1: steps do not sum to zero */
    int32_t defect_count;
    int32_t cancelled; /* dislocations that were made to vanish */
    double error; /* RMS of steps less what the field asks for, over the RMS
                   * of that */
} otx_phase;

/* The level to solve on for cells of length `cell`, scene units: the coarsest
 * with four edges to a cell, or, where that would be a large one, with two and
 * a half. Finer faces share out what their ancestors have. */
int32_t otx_phase_level(const otx_surface *surface, double cell);

/* In run->arena. NUMERIC, MEMORY, CANCELLED. */
otx_status
otx_phase_solve(otx_run *run, const otx_phase_request *request, otx_phase *out);

#endif
