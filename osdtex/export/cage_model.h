/* cage_model.h -- the artist's cage as files take it: nothing moved, nothing
 * renumbered, only the texture coordinates are those of the bake. */
#ifndef OTX_EXPORT_CAGE_MODEL_H
#define OTX_EXPORT_CAGE_MODEL_H

#include "bake/layout.h"
#include "file/obj.h"
#include "file/usda.h"

/* The face-varying rule by which the coordinates of `layout` are to be
 * interpolated: that of the cage for its own, all-linear for an atlas. */
otx_fvar otx_cage_model_fvar(const otx_layout *layout);

/* Metres to a scene unit where nobody says: of programs that work in metres
 * one, else what USD takes a stage to be that does not say, which is Maya's. */
double otx_cage_model_meters(otx_receiver receiver);

/* USD's word for it. */
const char *otx_cage_model_fvar_name(otx_fvar fvar);

/* What is written as an OBJ; what must be made is made in run->scratch.
 *
 *   path      of the OBJ
 *   library   file name of its materials
 *   fallback  the material of faces that have none
 */
otx_status otx_cage_model_obj(
    otx_run *run, const otx_layout *layout, const char *path,
    const char *library, const char *fallback, otx_obj *out);

/* The cage's own materials, and which one each face has; faces without one get
 * `fallback`, since they would show no texture. Made in run->scratch.
 *
 *   parents  [faces] face of the cage that each is of; NULL: the cage's own */
otx_status otx_cage_model_materials(
    otx_run *run, const otx_cage *cage, const int32_t *parents, int32_t faces,
    const char *fallback, otx_obj *out);

/* Creases, corners, holes and rules of a cage whose texture coordinates are
 * interpolated by `fvar`; what must be made is made in run->scratch. */
otx_status otx_cage_model_tags(
    otx_run *run, const otx_cage *cage, otx_fvar fvar, otx_obj *out);

/* The same for a USD file, without the texture and the comments. */
void
otx_cage_model_usda(const otx_layout *layout, const char *name, otx_usda *out);

#endif
