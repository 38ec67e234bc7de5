/* material_axis.h -- where on a surface which slice of a stack is. */
#ifndef OTX_API_MATERIAL_AXIS_H
#define OTX_API_MATERIAL_AXIS_H

#include "api/handle.h"

/* Sets mapping.along of a handle that is mapped, where one of its exemplars is
 * a stack: by the material of its constraints, else by what the surface is like
 * at a vertex.
 *
 *   text  as osdtex_map_options.along
 *
 * Says where a material is asked for that nothing can show. ARGUMENT for an
 * axis that is none and for creases or boundaries where there are none,
 * CANCELLED, MEMORY. */
otx_status
otx_material_axis_take(otx_run *run, const char *text, osdtex_mapping *handle);

#endif
