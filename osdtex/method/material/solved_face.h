/* solved_face.h -- what was solved for above a leaf face. */
#ifndef OTX_METHOD_MATERIAL_SOLVED_FACE_H
#define OTX_METHOD_MATERIAL_SOLVED_FACE_H

#include "method/material/material.h"

/* Texels per scene unit that are asked for on a leaf face. */
double otx_material_density(const otx_material *m, int32_t leaf_face);

/* The face of the solved level above a leaf face. */
int32_t otx_material_solved_face(const otx_material *m, int32_t leaf_face);

#endif
