/* material_layers.h -- a material whose maps are layers of one EXR. */
#ifndef OTX_FILE_MATERIAL_LAYERS_H
#define OTX_FILE_MATERIAL_LAYERS_H

#include "file/material_files.h"

/* Finds the maps among the layers of the EXR at `path`, by the same words as
 * files are found by. Where none is called as colours are, the colour is what
 * would be read as the picture. IO, FORMAT (no layer is a map, or two are one),
 * MEMORY.
 *
 *   out     the path, for each role that there is
 *   layers  the name of its layer; NULL for such a colour */
otx_status otx_material_layers_find(
    otx_run *run, const char *path, otx_material_files *out,
    otx_material_files *layers);

#endif
