/* cage_tags.h -- creases, corners and holes of a cage. */
#ifndef OTX_SURFACE_CAGE_TAGS_H
#define OTX_SURFACE_CAGE_TAGS_H

#include "surface/cage.h"
#include "surface/topology.h"

/* Checks the tags of `input` and copies them into `cage`, which has its
 * counts of faces and vertices. A crease on what is no edge is warned of and
 * left out: it has no effect on any surface, and files carry such remains of
 * edited meshes. Everything else that is wrong is an error. */
otx_status otx_cage_tags_read(
    otx_run *run, const otx_cage_input *input, const otx_topology *topology,
    otx_cage *cage);

#endif
