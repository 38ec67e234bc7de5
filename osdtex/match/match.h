/* match.h -- where in the exemplar a patch fits its textured surroundings.
 *
 * The mask is the collar of triangles around a patch that already have a
 * texture. A search compares it with the exemplar at every translation and at
 * the K asked orientations, and returns the placements with the smallest
 * masked sum of squared differences [Soler02, sec. 4.2, eq. 2]. The mask is
 * rotated, never the exemplar, so that a tiling exemplar stays exactly
 * toroidal. See docs/notes/match.md. */
#ifndef OTX_MATCH_MATCH_H
#define OTX_MATCH_MATCH_H

#include "image/image.h"

/* Spectra and pyramid of one exemplar; immutable, shared by threads. */
typedef struct otx_matcher otx_matcher;

/* One textured triangle of the collar. */
typedef struct otx_mask_triangle
{
    otx_vec2 flat[3];   /* in the plane of the patch, texels of the exemplar */
    otx_vec2 source[3]; /* where the corners take their colour now, texels;
                         * may leave the exemplar where it tiles */
    float weight[3];    /* >= 0; all 1 is the plain J of eq. 2 */
    const otx_matcher *from; /* whose exemplar `source` lies in; NULL: the one
                              * that is searched */
} otx_mask_triangle;

/* Where triangles overlap, each counts. Edges shared with bit-equal corners
 * leave no gap. */
typedef struct otx_mask
{
    const otx_mask_triangle *triangles;
    int32_t triangle_count;
} otx_mask;

/* A placement: texel position = R(angle) flat + shift. */
typedef struct otx_match
{
    double angle;
    otx_vec2 shift; /* texels of the exemplar */
    double error;   /* RMS difference over the mask / sigma of the matcher */
} otx_match;

typedef struct otx_match_query
{
    const double *angles; /* [angle_count], radians */
    int32_t angle_count;

    /* Resolution of the exhaustive search, in halvings; 0 is full resolution.
     * Held to what the matcher was made for, and made finer for masks that
     * would have too few pixels. */
    int32_t coarse_levels;
    int32_t coarse_keep;  /* local minima refined, at most
                           * OTX_MATCH_MAX_KEEP */
    int32_t sample_limit; /* texels of the mask used in refinement */
    bool gauss_newton;    /* also refine (x, y, angle) below the texel */

    /* Points of the plane, beyond the mask, that must land half a texel inside
     * the exemplar along the axes that do not tile, [cover_count]: the hull
     * of the patch and of what is used around it. */
    const otx_vec2 *cover;
    int32_t cover_count;
    bool overhang; /* the mask need not lie inside: what reaches over the rim,
                    * up to .3 of the picture, costs about as much as good
                    * matches do elsewhere */

    /* Squared errors are multiplied by 1 + usage_weight * the mean usage of
     * what `cover` lands on (where it is empty, `centre`), before they are
     * compared; NULL none. [usage_height * usage_width] cells over the whole
     * exemplar. The error that is returned is without it. */
    const float *usage;
    int32_t usage_width;
    int32_t usage_height;
    double usage_weight;

    /* Point of the plane; along axes that tile the shift is chosen so that it
     * lands in [0, N). */
    otx_vec2 centre;
} otx_match_query;

enum
{
    OTX_MATCH_MAX_KEEP = 64
};

/* Half resolution, 16 candidates, 3000 samples. Angles are the caller's. */
static inline otx_match_query
otx_match_query_defaults(const double *angles, int32_t angle_count)
{
    return (otx_match_query){
        .angles = angles,
        .angle_count = angle_count,
        .coarse_levels = 1,
        .coarse_keep = 16,
        .sample_limit = 3000,
    };
}

/* Prepares a search in `match` (1 to 4 channels, kept by the caller no longer
 * than this call).
 *
 *   sigma         RMS distance of two random texels; 0 leaves errors in RMS
 *   finest_level  spectra are made for this many halvings and more; 0 allows
 *                 the search at full resolution, at 4 times the memory of 1
 *
 * ARGUMENT, MEMORY. */
otx_status otx_matcher_create(
    otx_run *run, const otx_image *match, bool wrap_x, bool wrap_y,
    double sigma, int32_t finest_level, otx_matcher **out);

/* The same for one exemplar of several: masks that are looked up in it may
 * hold colours of `like`, and the other way round. Both are of one number of
 * channels. */
otx_status otx_matcher_create_like(
    otx_run *run, const otx_image *match, bool wrap_x, bool wrap_y,
    double sigma, int32_t finest_level, const otx_matcher *like,
    otx_matcher **out);

/* The longest diagonal of a mask that is searched for, in texels: four
 * exemplars. What is around a patch for longer than that says nothing about
 * where in the picture it should lie. */
double otx_matcher_reach(const otx_matcher *matcher);

/* The best placements, ascending by error (times usage), ties by angle, row,
 * column; the orientations are spread over the pool of the run.
 *
 *   best   [capacity]
 *   count  how many were found: 0 when nothing fits inside an exemplar that
 *          does not tile, or when the mask holds no texel
 *
 * A mask larger than a tiling exemplar is compared with the repeated exemplar.
 * ARGUMENT for an empty mask, one beyond the reach, numbers that are not
 * finite, a query without angles; MEMORY. */
otx_status otx_matcher_search(
    otx_run *run, const otx_matcher *matcher, const otx_mask *mask,
    const otx_match_query *query, otx_match *best, int32_t capacity,
    int32_t *count);

/* The same, to the bit, within a loop of the pool: for callers that fit several
 * patches at once. Reports nothing.
 *
 *   worker  of the loop, with memory for what is released again; without a
 *           pool all is done in this thread */
otx_status otx_matcher_search_within(
    otx_worker *worker, const otx_matcher *matcher, const otx_mask *mask,
    const otx_match_query *query, otx_match *best, int32_t capacity,
    int32_t *count);

/* Error of one placement: eq. 2 over all texels that the placed mask covers,
 * at full resolution, in double. `placement->error` is not read. INFINITY
 * when the mask covers no texel. */
double otx_matcher_score(
    const otx_matcher *matcher, const otx_mask *mask,
    const otx_match *placement);

#endif
