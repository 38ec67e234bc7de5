/* cage_check.h -- the checks that otx_cage_build makes, in order.
 *
 * Each looks at the whole mesh and reports every finding (like ones fold into
 * one with a count), then returns the status of the first. Each relies on the
 * ones before it. */
#ifndef OTX_SURFACE_CAGE_CHECK_H
#define OTX_SURFACE_CAGE_CHECK_H

#include "surface/cage.h"
#include "surface/topology.h"

/* There are faces; each has 3 corners or more, on different vertices that
 * exist. With Loop each is a triangle. */
otx_status otx_cage_check_faces(
    otx_run *run, const otx_cage_input *input, otx_scheme scheme);

/* Positions are finite and of a size that squares without overflow. */
otx_status otx_cage_check_points(otx_run *run, const otx_cage_input *input);

/* Every corner has a UV that exists and is finite. A warning when some have
 * none: *usable says whether the UVs can be kept. */
otx_status
otx_cage_check_uvs(otx_run *run, const otx_cage_input *input, bool *usable);

/* One or two faces at every edge, wound alike, and at most
 * OTX_CAGE_VALENCE_MAX edges at every vertex. Of a plain mesh what is not so is
 * a warning, since it can be cut there. Warns of vertices without faces, and of
 * vertices at which parts only touch.
 *
 *   split_count  fans of faces beyond the first of a vertex; 0 of a plain
 *                mesh */
otx_status otx_cage_check_manifold(
    otx_run *run, const otx_cage_input *input, const otx_topology *topology,
    otx_scheme scheme, int32_t *split_count);

/* Warns of faces without area. */
void otx_cage_check_areas(otx_run *run, const otx_cage_input *input);

#endif
