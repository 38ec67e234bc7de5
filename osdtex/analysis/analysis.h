/* analysis.h -- does a picture have a direction, or a lattice?
 *
 * Where it does, patches must respect it. Four classes:
 *
 *   isotropic     gravel, water: any orientation will do
 *   directional   wood, bark: orientation is to follow a field
 *   weak lattice  rows that repeat roughly: treated as directional
 *   lattice       weave, brick: shifting the picture by a generator leaves it
 *                 nearly as it is
 *
 * See docs/notes/material.md. */
#ifndef OTX_ANALYSIS_ANALYSIS_H
#define OTX_ANALYSIS_ANALYSIS_H

#include "image/image.h"

typedef enum otx_analysis_class
{
    OTX_ANALYSIS_ISOTROPIC,
    OTX_ANALYSIS_DIRECTIONAL,
    OTX_ANALYSIS_WEAK_LATTICE,
    OTX_ANALYSIS_LATTICE,
    OTX_ANALYSIS_CLASS_COUNT
} otx_analysis_class;

typedef struct otx_analysis
{
    otx_analysis_class kind;
    /* Turns by 360 / symmetry degrees leave the texture's look as it is: 1, 2
     * or 4; 0 for isotropic ones, where any turn does. */
    int32_t symmetry;
    double angle; /* radians in the picture, in [0, pi): grain or course, what
                   * a direction field stands for; 0 for isotropic ones */
    otx_vec2 generators[2]; /* texels, the first the more horizontal, the pair
                             * counter-clockwise; of lattices, else zero */
    bool upright;           /* it has a top, along y: masonry, text, shingles */
    otx_vec2 centre; /* texel about which half a turn fits best; of lattices */

    /* What was measured; see analysis.c for the thresholds. */
    double coherence;  /* of the structure tensor, 0 .. 1 */
    double regularity; /* mean autocorrelation at lattice points */
    double contrast;   /* least excess over the half-way points */
    double half_turn;  /* correlation with the picture turned by 180 degrees */
    double quarter_turn; /* the same by 90 */
    double skew;         /* of gradients along the direction; 0: none */
} otx_analysis;

/* "isotropic", "directional", "weak-lattice", "lattice". */
const char *otx_analysis_name(otx_analysis_class kind);

/* Analyses a picture (its Lab version, 3 channels; the first is looked at).
 *
 *   wrap_x, wrap_y  it tiles along these axes: generators are then rounded so
 *                   that whole pictures are whole cells
 *
 * MEMORY. */
otx_status otx_analysis_run(
    otx_run *run, const otx_image *lab, bool wrap_x, bool wrap_y,
    otx_analysis *out);

/* Makes a lattice of what the user says about it: fills kind, symmetry (0:
 * measured), angle, centre. ARGUMENT when the generators do not span a cell of
 * at least 4 texels or are longer than the picture. */
otx_status otx_analysis_force_lattice(
    otx_run *run, const otx_image *lab, const otx_vec2 generators[2],
    otx_analysis *out);

#endif
