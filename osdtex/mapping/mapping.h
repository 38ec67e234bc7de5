/* mapping.h -- what every method returns: UVs for every leaf face.
 *
 * A face carries one fragment: its corners' UVs and the patch that they come
 * from; the patch says of which exemplar (mapping/source.h). UVs are in units
 * of the exemplar's size, v up, and may leave [0, 1]
 * only along an axis in which the exemplar tiles. */
#ifndef OTX_MAPPING_MAPPING_H
#define OTX_MAPPING_MAPPING_H

#include "mapping/decals.h"
#include "mapping/lookups.h"
#include "mapping/source_field.h"
#include "math/vec.h"
#include "surface/surface.h"

/* A direction for every leaf face, and how the exemplar is to lie along it. */
typedef struct otx_guide
{
    const otx_vec3 *directions; /* [leaf face_count] unit, along the surface */
    int32_t symmetry;           /* turns by 360 / symmetry degrees are equal */
    double angle;               /* of the exemplar's direction, radians */
} otx_guide;

/* Where a lattice lies on the surface, for pictures of it. */
typedef struct otx_cell_map
{
    const otx_vec2 *cells;   /* [leaf corner_count] lattice coordinates; whole
                              * numbers are the lines between cells */
    const uint8_t *open;     /* [leaf face_count] 1: patches cover it instead */
    const otx_vec3 *defects; /* [defect_count] dislocations, scene units */
    int32_t defect_count;
} otx_cell_map;

typedef struct otx_mapping
{
    const otx_surface *surface;
    double scale; /* width of the first exemplar in scene units */
    float *uvs;   /* [leaf corner_count * 2] */
    /* [leaf face_count], -1 only on holes. Numbered from 0 in the order in
     * which the patches were fitted. */
    int32_t *face_patch;
    int32_t patch_count;
    int32_t exemplar_count;        /* 0 is 1 */
    const uint8_t *patch_exemplar; /* [patch_count] which one each patch comes
                                    * from; NULL: all from the first */
    const otx_guide *guide;        /* that the first's patches follow; NULL */
    const otx_cell_map *lattice;   /* that it shows; NULL none */
    const otx_lookups *lookups;    /* where there are several; NULL nowhere */
    const otx_source_field *field; /* where it was made by texels; NULL */
    /* [leaf vert_count] the place along the axis of a stack, 0 to 1 [Ray09,
     * sec. 1]; NULL: there is no such axis. */
    const float *along;
    const otx_decals *decals; /* over all of it; NULL none */
} otx_mapping;

#endif
