/* coursing.h -- exemplars that are laid course by course.
 *
 * Of masonry only the coordinate across the courses has whole cells; each
 * course is then measured along itself (strips.h, unroll.c), and shown one of
 * the exemplar's (bond.c). Curvature shifts courses along each other, and where
 * it must ends one, but changes no sizes. */
#ifndef OTX_METHOD_MATERIAL_COURSING_H
#define OTX_METHOD_MATERIAL_COURSING_H

#include "method/material/material.h"

/* Decides by the exemplar and the settings; m->courses.count stays 0 where the
 * lattice is laid as a whole. Else the cell becomes a course of the picture's
 * length. SUPPORT when courses are asked for and there are none. MEMORY. */
otx_status otx_coursing_choose(otx_material *m);

/* Lines between courses stay equally far apart where the field does not turn
 * on the way across them: a field and its turn by a right angle are equally
 * smooth, so that the better of the two is taken. */
void otx_coursing_turn(otx_material *m);

/* bond.c: lays all UVs, from the coordinates across in m->cells. Opens faces
 * that have none. NUMERIC, MEMORY. */
otx_status otx_coursing_lay(otx_material *m);

#endif
