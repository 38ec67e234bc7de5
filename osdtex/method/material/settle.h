/* settle.h -- periodic coordinates once their whole cells are known.
 *
 * The smallest eigenvector says how many whole cells every step along an edge
 * takes; with these frozen, what is left is an ordinary least squares problem
 * that has no reason to leave any strain near a defect [Ray06, sec. 5]. Before
 * that, defects that lie close together are joined: a step across each edge
 * between a dislocation and its opposite takes a cell more, and both are gone.
 */
#ifndef OTX_METHOD_MATERIAL_SETTLE_H
#define OTX_METHOD_MATERIAL_SETTLE_H

#include "method/material/phase.h"

/* What phase.c and settle.c share. */
typedef struct otx_phase_solver
{
    otx_run *run;
    const otx_phase_request *request;
    const otx_connection *c;
    otx_phase *phase;
    double *angles; /* [face_count] of the sense that the face takes */
    int8_t *sense;  /* [corner_count] of the face against the vertex' */
    double *mass;   /* [vert_count] area */
    double tau;
    double *wish[2]; /* [edge_count] steps asked for, in the first face's sense
                      * along its half-edge */
    double *step[2]; /* [edge_count] steps that the phases make */
    double *z[2];    /* [2 vert_count] */
    double *turn[2]; /* [vert_count] cells, whole ones do not count */
    uint8_t *singular; /* [vert_count] 1: senses do not close around it */
    bool one_sense;    /* all faces agree: complex systems do */
} otx_phase_solver;

/* Cells along half-edge `corner` of `face`, in the face's sense. */
double otx_phase_face_step(
    const otx_phase_solver *s, int32_t face, int32_t corner, int axis);

/* Corners of the first face at the two ends of an edge. */
void otx_phase_edge_corners(
    const otx_connection *c, int32_t edge, int32_t corners[2]);

/* Weight of an edge among vertices. */
double otx_phase_edge_weight(const otx_connection *c, int32_t edge);

/* Changes whole cells so that dislocations closer than request->cancel to
 * their opposite, to a singularity or to a border vanish. Counts them. MEMORY.
 */
otx_status otx_settle_cancel(otx_phase_solver *s);

/* Solves for `turn` with the whole cells of `step` frozen, and renews `step`.
 * NUMERIC, MEMORY. */
otx_status otx_settle_solve(otx_phase_solver *s);

#endif
