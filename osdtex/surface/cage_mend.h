/* cage_mend.h -- what is changed of a mesh on its way into a cage. */
#ifndef OTX_SURFACE_CAGE_MEND_H
#define OTX_SURFACE_CAGE_MEND_H

#include "surface/cage.h"
#include "surface/topology.h"

/* Lets the faces and tags of `input` use one vertex where several lie within
 * `distance` (scene units; 0: OTX_WELD_SHARE of the box); the others stay
 * behind without faces. Indices must be in range. Arrays that change are made
 * in run->scratch. Notes how many were welded; MEMORY. */
otx_status otx_cage_weld(otx_run *run, double distance, otx_cage_input *input);

/* Warns of open edges that lie in the same place. MEMORY. */
otx_status otx_cage_note_gaps(
    otx_run *run, const otx_cage_input *input, const otx_topology *topology);

/* Cuts the UVs of `input`, all of which can be used, where they fold back
 * (surface/uv_fold.h). MEMORY. */
otx_status otx_cage_split_folds(
    otx_run *run, const otx_topology *topology, otx_cage_input *input);

#endif
