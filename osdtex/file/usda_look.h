/* usda_look.h -- the material of a USD text file: UsdPreviewSurface, its maps,
 * and the same look in MaterialX. */
#ifndef OTX_FILE_USDA_LOOK_H
#define OTX_FILE_USDA_LOOK_H

#include "file/text_out.h"
#include "file/usda.h"

/* Writes the prim Look, and of several materials one for each that has all of
 * it.
 *
 *   name  of the model, an identifier. False when memory is out. */
bool otx_usda_look_write(
    otx_run *run, otx_text_out *out, const otx_usda *usda, const char *name);

/* "material_0_cap": the prim of a material; NULL when memory is out. */
const char *otx_usda_look_material(
    otx_arena *arena, const otx_usda_subsets *materials, int32_t index);

#endif
