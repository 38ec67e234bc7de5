/* chart.h -- a cluster and its collar, laid out in the plane.
 *
 * The collar is the ring of leaf faces around the cluster that the patch is
 * matched against and may later take over. Cluster and collar are flattened
 * together, so that one continuous chart covers both. Coordinates are in
 * texels of the exemplar, isometric to the surface as nearly as its curvature
 * allows; faces run counter-clockwise. */
#ifndef OTX_FLATTEN_CHART_H
#define OTX_FLATTEN_CHART_H

#include "cluster/cluster.h"

typedef struct otx_chart
{
    int32_t face_count;
    int32_t core_count; /* faces [0, core_count) are the cluster's own */
    int32_t *faces;     /* [face_count] leaf faces */
    int32_t *first;     /* [face_count + 1] offsets into corners */
    int32_t *corners;   /* local vertices */
    int32_t vert_count;
    int32_t *verts; /* [vert_count] leaf vertices */
    otx_vec2 *flat; /* [vert_count] texels */
    float *reach;   /* [face_count] distance from the core, texels; 0 in it */
    /* [vert_count] the same of the vertices; NULL where charts are joint and
     * only faces have it. */
    float *vert_reach;

    /* How flat the core came out: area-weighted RMS of the larger of stretch
     * and its inverse over the core's faces; INFINITY when one is flipped. */
    double distortion;
    double worst; /* largest single singular value ratio in the core */
} otx_chart;

/* Marks that charts are built with: one per thread, cleared between uses. */
typedef struct otx_chart_space
{
    int32_t *face_slot; /* [leaf face_count] chart face or -1 */
    int32_t *vert_slot; /* [leaf vert_count] chart vertex or -1 */
} otx_chart_space;

/* In `arena`, all slots -1. */
otx_status otx_chart_space_create(
    otx_run *run, otx_arena *arena, const otx_surface *surface,
    otx_chart_space *out);

typedef struct otx_chart_request
{
    const otx_surface *surface;
    const otx_dual *leaves; /* dual of the leaf level */
    double texels;          /* per scene unit */
    double collar;          /* width, texels */
    double bend;            /* how fast a bend uses the collar up */
    int32_t rounds;         /* of local/global relaxation */
    /* Who builds: asked now and then whether to stop. NULL: nobody. */
    const otx_worker *worker;
} otx_chart_request;

/* Builds the chart of `core` (ascending leaf faces that form a disc) in
 * `arena`. The collar grows face by face, nearest first, and only while the
 * whole stays a disc. Runs in any thread: `space` and the arenas are its own.
 *
 * MEMORY, without a finding; CANCELLED. */
otx_status otx_chart_build(
    const otx_chart_request *request, const int32_t *core, int32_t core_count,
    otx_chart_space *space, otx_arena *scratch, otx_arena *arena,
    otx_chart *out);

/* Signed area of a chart face in the plane, texels squared. */
double otx_chart_face_area(const otx_chart *chart, int32_t face);

/* The singular values, larger first, of the map from surface to plane on a
 * chart face, both in texels; 0 or less when it is flipped. Of the worse of
 * the face's fan triangles. */
void otx_chart_face_stretch(
    const otx_chart *chart, const otx_surface *surface, double texels,
    int32_t face, double sigma[2]);

#endif
