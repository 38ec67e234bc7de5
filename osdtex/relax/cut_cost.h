/* cut_cost.h -- the energy that the seam cut lowers, in whole numbers.
 *
 * E = sum over interior leaf edges of V(edge, label, label)
 *   + sum over faces of distortion * area * cost
 *
 * V is 0 for equal labels and where two charts of one exemplar are continuous;
 * otherwise
 * length * (mean colour difference + a constant), and between exemplars also
 * what each side cuts through. Length and samples depend on
 * the edge alone, so that V is a metric over labels, which is what expansion
 * moves ask for. Rounding to whole numbers makes cuts exact and sums
 * independent of their order. */
#ifndef OTX_RELAX_CUT_COST_H
#define OTX_RELAX_CUT_COST_H

#include "relax/cut.h"

/* Labels that the energy belongs to, and what it is made of. */
typedef struct otx_cut_cost
{
    const otx_surface *surface;
    const otx_level *leaf;
    const otx_exemplar *exemplars;
    const otx_offer *offers;
    const otx_cut_options *options;
    double unit;        /* colour difference x texels in one whole number */
    double edge_length; /* cost per texel of any seam */
} otx_cut_cost;

/* A face as one offer shows it. */
typedef struct otx_cut_view
{
    int32_t label; /* -1: the face has no patch */
    int32_t slot;  /* place of the face in the offer's lists */
} otx_cut_view;

otx_cut_cost otx_cut_cost_create(
    const otx_surface *surface, const otx_exemplar *exemplars,
    const otx_offer *offers, const otx_cut_options *options);

/* V between the faces of an interior edge, first and second of edge_faces, if
 * they showed `a` and `b`. 0 when one of them has no patch. */
int64_t otx_cut_cost_edge(
    const otx_cut_cost *cost, int32_t edge, otx_cut_view a, otx_cut_view b);

/* The same for an edge with one chart on both faces: whether `a` and `b` give
 * its ends the same UVs to the bit. */
bool otx_cut_cost_joined(
    const otx_cut_cost *cost, int32_t edge, otx_cut_view a, otx_cut_view b);

/* What the face itself costs. A face without a patch costs more than any seam
 * around it. */
int64_t
otx_cut_cost_face(const otx_cut_cost *cost, int32_t face, otx_cut_view view);

#endif
