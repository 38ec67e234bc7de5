/* shapes.h -- cages made by rule, so that figures can be had anywhere. */
#ifndef OTX_BENCH_SHAPES_H
#define OTX_BENCH_SHAPES_H

#include "surface/surface.h"

/* A unit sphere of 12 n^2 quads: the faces of a rhombic dodecahedron as n x n
 * grids. With UVs each of the twelve is a chart of its own. */
otx_status
bench_shapes_sphere(otx_run *run, int32_t n, bool with_uvs, otx_cage *out);

/* A bumpy cube of 3 x 3 x 3 quads with eight bent, tapering arms of 15 rings:
 * 534 quads, 34 176 at level 3, as many as the octopus of [Soler02, fig. 8]. */
otx_status bench_shapes_octopus(otx_run *run, otx_cage *out);

/* Reads an OBJ. */
otx_status bench_shapes_read(otx_run *run, const char *path, otx_cage *out);

#endif
