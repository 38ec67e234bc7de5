/* exemplar_analysis.h -- what structure an exemplar has, in the space that its
 * colours are compared in.
 *
 * Lightness tells most pictures' structure, and is looked at first. A weave of
 * red and green as light as each other has none: where lightness finds no
 * lattice, channels of the space that was asked for are looked at which hold
 * what lightness does not. See docs/notes/analysis.md. */
#ifndef OTX_ANALYSIS_EXEMPLAR_ANALYSIS_H
#define OTX_ANALYSIS_EXEMPLAR_ANALYSIS_H

#include "analysis/analysis.h"
#include "exemplar/exemplar.h"

/* MEMORY. */
otx_status otx_exemplar_analysis(
    otx_run *run, const otx_exemplar *exemplar, otx_analysis *out);

/* The channel of `match` that tells more than lightness, as a picture that
 * analyses look at: the one of the largest variance among those with at least a
 * quarter of all, and little of it that lightness explains. False where there
 * is none. */
bool
otx_exemplar_analysis_channel(const otx_exemplar *exemplar, otx_image *out);

#endif
