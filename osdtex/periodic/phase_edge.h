/* phase_edge.h -- steps of periodic coordinates along edges and round faces.
 *
 * A step is how many cells a coordinate goes on along a half-edge, in the sense
 * of the face that the half-edge is of. The steps around a face sum to its
 * charge: 0, or whole cells at a dislocation. */
#ifndef OTX_PERIODIC_PHASE_EDGE_H
#define OTX_PERIODIC_PHASE_EDGE_H

#include "periodic/phase.h"

/* What is known while the coordinates of a field are solved for. */
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

/* Whole cells that the steps around a face sum to. */
int otx_phase_charge(const otx_phase_solver *s, int32_t face, int axis);

/* How a step along an edge counts in a face: 1 or -1. */
int
otx_phase_orientation(const otx_phase_solver *s, int32_t face, int32_t edge);

/* Whether senses do not close around a corner of the face. */
bool otx_phase_touches_singular(const otx_phase_solver *s, int32_t face);

#endif
