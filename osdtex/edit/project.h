/* project.h -- a mapping carried to a surface of other faces.
 *
 * Each leaf face shows what the old surface does where it is nearest: the patch
 * of its middle, each corner the place that this patch has there. Corners that
 * lie beyond the patch continue it. */
#ifndef OTX_EDIT_PROJECT_H
#define OTX_EDIT_PROJECT_H

#include "exemplar/exemplar.h"
#include "mapping/mapping.h"
#include "surface/closest.h"

typedef struct otx_project
{
    const otx_mapping *from;
    const otx_surface *made_for;   /* its surface as it was mapped */
    const otx_exemplar *exemplars; /* of the mapping */
    const otx_surface *to;         /* without a density */
} otx_project;

typedef struct otx_projected
{
    /* On `to`, or on a copy of it with a density. Faces of which the old
     * surface says nothing are of no patch. */
    otx_mapping mapping;
    const float *points;  /* [leaf vert_count * 3] where vertices of `to` lie on
                           * the old surface; themselves where it is far */
    const uint8_t *loose; /* [leaf face_count] how many corners of a face lie
                           * beyond its patch */
    /* On the old surface: the vertices and the middles of faces. */
    const otx_closest_place *verts; /* [leaf vert_count] */
    const otx_closest_place *faces; /* [leaf face_count] */
} otx_projected;

/* Carries UVs, patches, directions, densities and places along a stack over, in
 * run->arena. MEMORY, CANCELLED. */
otx_status
otx_project_run(otx_run *run, const otx_project *project, otx_projected *out);

#endif
