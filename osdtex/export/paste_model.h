/* paste_model.h -- a mapping of pastes as a run-time list: OBJ, MTL, USD, EXR.
 *
 *     NAME.obj         faces in the groups layer_0, layer_1 ..., each of which
 *                      lies over those before it
 *     NAME.mtl         NAME: the exemplar, opaque; NAME_pastes: cut out, map_d
 *     NAME.exr         the exemplar
 *     NAME_pastes.exr  its pieces, R G B multiplied by A
 *     NAME.usda        the same faces with a GeomSubset for each layer
 *
 * and the other maps of a material beside either texture. See
 * docs/formats-pastes.md. */
#ifndef OTX_EXPORT_PASTE_MODEL_H
#define OTX_EXPORT_PASTE_MODEL_H

#include "export/model.h"
#include "export/names.h"

/* Writes all of them into options->set, which there is. SUPPORT of a mapping
 * that has no such list, and as otx_model_write. */
otx_status otx_paste_model_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const otx_model_options *options, const otx_names *names,
    int32_t *uv_count);

#endif
