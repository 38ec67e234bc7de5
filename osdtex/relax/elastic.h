/* elastic.h -- moves all UVs a little, so that seams close.
 *
 * Every patch is an elastic sheet: its vertices slide in the exemplar, each
 * patch with its own copy, so that both sides of a seam come to show the same
 * colours, while stretch is resisted. Both sides move. Gauss-Newton on
 *
 *     sum over seams of |T(u_a) - T(u_b)|^2 / sigma^2
 *         + stiffness * as-rigid-as-possible energy,
 *
 * coarse to fine in the exemplar. A step that would flip a face or stretch it
 * past the limit is taken back there, never merely penalised.
 * See docs/notes/elastic.md. */
#ifndef OTX_RELAX_ELASTIC_H
#define OTX_RELAX_ELASTIC_H

#include "exemplar/exemplar.h"
#include "math/vec.h"
#include "surface/surface.h"

typedef struct otx_elastic_options
{
    double texels;    /* per scene unit */
    int32_t rounds;   /* Gauss-Newton steps over all pyramid levels */
    int32_t levels;   /* of the exemplar's pyramid, 1 .. */
    double stiffness; /* weight of rigidity */
    double stretch;   /* limit of a singular value and of its inverse */
    double reach;     /* texels from a seam beyond which nothing is moved;
                       * 0: everything may */
    const uint8_t *patch_exemplar; /* of the exemplars, by patch; NULL: the
                                    * first throughout */
    int32_t exemplar_count;        /* that it names; 0 is 1 */
    /* [leaf face_count] 1: faces to take instead of those within reach, and of
     * these the ones that are not moved; NULL both. */
    const uint8_t *inside, *still;
    bool keep_shape; /* rigidity holds the shapes that the UVs have now, not
                      * the surface's: where a texture's size varies on
                      * purpose */
} otx_elastic_options;

typedef struct otx_elastic_stats
{
    double seam_before, seam_after; /* squared colour difference x texels, in
                                     * units of sigma squared */
    int32_t rounds;                 /* that lowered the energy */
    int64_t refused;                /* moves taken back */
} otx_elastic_stats;

/* Moves `uvs` ([leaf corner_count] texels) in place. Corners of one vertex in
 * faces of one patch must have equal UVs, and keep them. Along an axis in
 * which the exemplar does not tile they stay half a texel inside.
 *
 *   face_patch  [leaf face_count], -1 on holes
 *
 * CANCELLED, MEMORY. */
otx_status otx_elastic_run(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_elastic_options *options, const int32_t *face_patch,
    otx_vec2 *uvs, otx_elastic_stats *out);

#endif
