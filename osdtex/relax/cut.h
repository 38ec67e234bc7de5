/* cut.h -- gives every leaf face to the patch that makes the seams vanish.
 *
 * Every patch was mapped on a collar wider than what it owns, so most faces
 * have UVs from several patches. alpha-expansion [Boykov01] moves the borders
 * to where two patches show the same colours, which is the graph cut seam of
 * [Kwatra03] with many sources on a surface. UVs are chosen, never changed:
 * each patch stays one continuous chart, though its region may end up in
 * pieces, with holes, or empty. See docs/notes/cut.md.
 *
 * [Boykov01] Boykov, Veksler, Zabih: Fast approximate energy minimization via
 * graph cuts. PAMI 23(11).
 * [Kwatra03] Kwatra, Schoedl, Essa, Turk, Bobick: Graphcut textures. */
#ifndef OTX_RELAX_CUT_H
#define OTX_RELAX_CUT_H

#include "exemplar/exemplar.h"
#include "math/vec.h"
#include "surface/surface.h"

/* What one patch can show: its own faces and a collar around them. */
typedef struct otx_offer
{
    int32_t face_count;
    const int32_t *faces; /* [face_count], ascending leaf faces, no holes */
    const otx_vec2 *uvs;  /* corner UVs in texels, CSR by `first` */
    const int32_t *first; /* [face_count + 1] */
    const float *cost;    /* [face_count], >= 0, units of colour difference:
                           * distortion and the like; NULL none */
    int32_t exemplar;     /* of the exemplars, that it shows */
} otx_offer;

typedef struct otx_cut_options
{
    double texels_per_unit; /* texels per scene unit, > 0: required */
    int32_t sweeps;         /* over all patches, at most; stops when settled */
    bool lab;               /* compare in Lab instead of match space */
    double band;            /* texels beside the edge that are compared too,
                             * so that structure counts; 0: the edge alone */
    double distortion;      /* weight of `cost`, per texel: a face of area A
                             * costs distortion * A * cost */
    double length;          /* cost of any seam per texel, in units of the
                             * exemplar's sigma: breaks ties */
    /* Between two exemplars: cost of cutting through features per texel, in
     * units of each one's sigma, and where these are (outline.h), [exemplars];
     * NULL nowhere. */
    double through;
    const otx_image *outlines;
} otx_cut_options;

static inline otx_cut_options
otx_cut_options_default(void)
{
    return (otx_cut_options){
        .texels_per_unit = 0.0,
        .sweeps = 3,
        .lab = false,
        .band = 1.0,
        .distortion = 0.01,
        .length = 1e-3,
        .through = 1.5,
        .outlines = NULL,
    };
}

typedef struct otx_cut_stats
{
    double energy_before; /* colour difference x texels */
    double energy_after;  /* never more than before */
    int32_t sweeps;       /* made */
    int32_t moves;        /* expansions that changed a label */
    int32_t rejected;     /* expansions undone since they gained nothing */
    int32_t changed;      /* faces whose label differs from the input */
    int32_t patches;      /* labels still in use */
} otx_cut_stats;

/* Re-assigns leaf faces between the offers.
 *
 *   exemplars   those that the offers name; the first gives the unit
 *   offers      [offer_count], label p is offers[p]
 *   face_patch  [leaf face_count], in and out: labels; each labelled face must
 *               be among the faces that its patch offers. -1 on holes, and on
 *               faces without a patch, which the first offer takes.
 *   out         NULL allowed
 *
 * On failure `face_patch` is untouched. ARGUMENT when an offer or a label
 * breaks the rules above; CANCELLED, MEMORY. The result does not depend on the
 * number of threads. */
otx_status otx_cut_run(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_offer *offers, int32_t offer_count,
    const otx_cut_options *options, int32_t *face_patch, otx_cut_stats *out);

#endif
