/* nudge.h -- bends a placed patch towards its neighbours [Soler02, sec. 4.4].
 *
 * Vertices of the patch's hierarchy that lie on a textured border are tried at
 * random places near by, coarse levels first; a move carries the patch along
 * by the hat function of the level, which is what moving a control vertex does
 * to everything below it. The neighbours never move. What is left along the
 * whole border is the fitting error of the patch.
 * See docs/notes/elastic.md. */
#ifndef OTX_RELAX_NUDGE_H
#define OTX_RELAX_NUDGE_H

#include "exemplar/exemplar.h"
#include "flatten/chart.h"

typedef struct otx_nudge_request
{
    const otx_surface *surface;
    const otx_exemplar *exemplar; /* of the patch */
    double texels;                /* per scene unit */
    const int32_t *face_patch;    /* [leaf face_count]; textured where >= 0 */
    const otx_vec2 *uvs; /* [leaf corner_count] texels, where textured */
    /* Exemplars of the neighbours, and which by patch; NULL: the patch's. */
    const otx_exemplar *exemplars;
    const uint8_t *patch_exemplar;
    uint64_t seed; /* what is drawn depends on it alone */
} otx_nudge_request;

/* Moves the vertices of the chart's core in the exemplar.
 *
 *   cluster  that the core is; none of its faces is textured yet
 *   slots    [leaf vert_count], -1 everywhere, and again on return
 *   uv       [chart->vert_count] places of the chart's vertices, texels; those
 *            of the collar alone stay
 *   error    RMS colour difference over the textured border, in units of two
 *            random texels' difference; 0 without such a border
 *
 * No face is flipped or changed in area by more than 1.6 that was not before;
 * along an axis in which the exemplar does not tile nothing leaves it.
 * MEMORY, without a finding. */
otx_status otx_nudge_run(
    const otx_nudge_request *request, const otx_cluster *cluster,
    const otx_chart *chart, int32_t *slots, otx_arena *scratch, otx_vec2 *uv,
    double *error);

#endif
